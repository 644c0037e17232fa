# SPDX-License-Identifier: MIT
"""Rows of the tables of the supplement. A function without an underscore before its name is called by {table NAME} of a
template, which has the head of the table. Brackets are 95 % intervals over the samples."""
import math

import claims as ten
import compaction
import excursion
from figures import first_second, rate_of_law
from interval import Estimate, interval, number, ratio, student
from runs import (ANY, COMPLIANT, JAMMED_MOTION, SHAPES, TITLE, constant, exponent, exponent_of_samples, judged, line, of_one_length, over_samples, power,
                  scaled_load, select, series, strain)

JAMMED = COMPLIANT | {"jammed": True}
CONTACTS = (("rigid", {}), ("compliant", COMPLIANT))


def percent(value):
    return f"{100 * value:.0f} %".replace("-", "−") if math.isfinite(value) else "–"


def _mean_scatter(ratios):
    mean, spread = excursion.mean_and_scatter(ratios)
    return f"{mean:.2f}, {percent(spread)}" if math.isfinite(mean) else "–"


def volumes(runs):
    """The change of the solid fraction in contraction, by control volume and shape."""
    rows = []
    for shape in SHAPES:
        found = ten.base(runs, shape, **COMPLIANT)
        cells = [over_samples(found, lambda r, v=v, e=e: ten.in_contraction(r, v, e)) for e in ("t_finish", "t_v_max_passive")
                 for v in ten.VOLUMES]
        if all(e.n for e in cells):
            rows.append([TITLE[shape], max(e.n for e in cells), *(e.text() for e in cells)])
    return rows


def open_parameters(runs):
    """What brings C, the initial solid fraction, the rate and jamming near the paper's values."""
    cases = [("H/L = 1, the paper's case", {})]
    cases += [(f"H/L = {r:g}", {"box_ratio": r}) for r in (0.3, 0.42, 0.5, 0.7, 1.5)]
    cases += [(f"H/L = {r:g}, sizes × {s:g}", {"box_ratio": r, "size_scale": s})
              for s in (1.3, 1.5) for r in (0.3, 0.42, 0.5, 0.7, 1.0, 1.5)]
    cases += [("size = largest distance from the centre", {"size_reading": "circumradius"}),
              ("lid 3 mg", {"lid_force_weights": 3.0}), ("lid 30 mg", {"lid_force_weights": 30.0}),
              ("m_w = m/10", {"wall_mass_ratio": 0.1}), ("m_w = m", {"wall_mass_ratio": 1.0}),
              ("m_w = 4 m", {"wall_mass_ratio": 4.0}),
              ("H/L = 0.42, flatness 0.7", {"box_ratio": 0.42, "flatness": 0.7}),
              ("H/L = 0.42, at least 30 vertices", {"box_ratio": 0.42, "fewest_vertices": 30})]
    rows = []
    for contacts, method in CONTACTS:
        for name, changed in cases:
            found = of_one_length(select(runs, "polyhedron", frequency=5.0, jammed=False, **(method | changed)))
            if not found:
                continue
            mean = [over_samples(found, value).text() for value in (
                constant, lambda r: constant(r, "dx_max"), lambda r: r["rho_box_initial"], lambda r: r["rho_0"],
                lambda r: 1e3 * r["rate"], lambda r: 1e-3 * r["behaviour"]["passive_force"])]
            rows.append([f"{name}, {contacts}", f"{len(found)}; {sum(judged(r) for r in found)}",
                         max(len(r["periods"]["x_j"]) for r in found), *mean])
    return rows


def flat_boxes(runs):
    """Rate of compaction and C of the flat boxes, H/L = 0.42, of all grains that open_parameters() has."""
    found = []
    for _, method in CONTACTS:
        for changed in ({}, {"size_scale": 1.3}, {"size_scale": 1.5}, {"flatness": 0.7}, {"fewest_vertices": 30}):
            of_case = of_one_length(select(runs, "polyhedron", frequency=5.0, jammed=False, **(method | {"box_ratio": 0.42} | changed)))
            if of_case:
                found.append((over_samples(of_case, lambda r: r["rate"]), over_samples(of_case, constant)))
    return found


def flat_jamming(runs):
    """Whether the wall of the flat box is at rest while the packing is jammed, period by period and force by force."""
    rows = []
    for fmax in (2000.0, 4000.0, 6000.0, 10000.0):
        found = [r for r in select(runs, "polyhedron", frequency=5.0, box_ratio=0.42, fmax=fmax, jammed=False, **COMPLIANT)
                 if r["parameters"]["duration"] == 1]
        cells = []
        for n in range(4):
            e = over_samples(found, lambda r: 1e3 * r["periods"]["drift"][n])
            jammed = sum(abs(r["periods"]["drift"][n]) <= JAMMED_MOTION * r["periods"]["dx_max"][n] for r in found)
            cells.append(f"{e.text()} ({jammed} of {e.n})")
        rows.append([f"{1e-3 * fmax:g}", *cells, over_samples(
            found, lambda r: sum(r["periods"]["dx_active"][2:4]) / 2 / scaled_load(r)).text()])
    return rows


def closed_form(runs):
    """C by a constant thrust: how far the closed form is from what is measured, beside the null models."""
    rows = []
    for shape in SHAPES:
        found = excursion.Prediction(runs, shape)
        rows.append([TITLE[shape], f"{Estimate(r['steady_thrust'] for r in found.bases).text()}", Estimate(found.shares.values()).text(),
                     *(_mean_scatter(found.ratios(*names)) for names in (("fmax", "gravity"), ("wall_mass_ratio",), ("frequency",), ())),
                     _mean_scatter(found.null_ratios(False)), _mean_scatter(found.null_ratios(True))])
    return rows


SETS = (("rigid, 1e-4, with drift", {}, "dx_max"), ("rigid, 1e-4, without", {}, "dx_active"),
        ("rigid, 1e-5, with drift", {"tolerance": 1e-5}, "dx_max"), ("rigid, 1e-5, without", {"tolerance": 1e-5}, "dx_active"),
        ("compliant, jammed, with rebound", JAMMED, "dx_max"), ("compliant, jammed, without", JAMMED, "dx_active"))


def exponents(runs):
    rows = []
    for name, wanted, quantity in SETS:
        for shape in SHAPES:
            cells = []
            for parameter, fixed in (("frequency", {}), ("fmax", {"frequency": 5.0}), ("gravity", {"frequency": 5.0}),
                                     ("wall_mass_ratio", {"frequency": 5.0})):
                found = [r for r in series(runs, shape, parameter, **(wanted | fixed))
                         if r["parameters"]["fmax"] >= 1000 and r["parameters"]["frequency"] > 1.5 and judged(r)]
                if parameter == "wall_mass_ratio":
                    e = exponent_of_samples(found, lambda r: r["mass"] + r["wall_mass"], lambda r, q=quantity: r[q])
                else:
                    e = exponent(found, parameter, lambda r, q=quantity: r[q])
                values = [r["parameters"][parameter] for r in found]
                cells.append(f"{e.text()} ({e.n}: {min(values):g} to {max(values):g})" if e.n else "–")
            if any(cell != "–" for cell in cells):
                rows.append([name, TITLE[shape], *cells])
    return rows


SETTINGS = (("usual", {}), ("half the step", {"step": 1e-4}), ("a tenth of the tolerance", {"tolerance": 1e-6}))


def _same_states(runs, shape):
    """Settings from the first on for which three frequencies have runs that start from the same states, and these runs."""
    found = [{(r["parameters"]["seed"], r["parameters"]["frequency"]): r
              for r in series(runs, shape, "frequency", **(JAMMED | changed))} for _, changed in SETTINGS]
    for first in range(len(SETTINGS) - 1):
        common = sorted(key for key, r in found[first].items() if all(
            key in f and abs(ten.jammed_position(f[key]) - ten.jammed_position(r)) < 1e-4 for f in found[first:]))
        if len({nu for _, nu in common}) >= 3:
            return SETTINGS[first:], found[first:], common
    return (), (), ()


def converged_shifts(runs, shape):
    """Logarithm of the excursion at half the step, and at a tenth of the tolerance, over the usual one: of each sample its mean."""
    _, found, common = _same_states(runs, shape)
    shifts = []
    for at in found[1:]:
        seeds = {}
        for key in common:
            seeds.setdefault(key[0], []).append(math.log(at[key]["dx_active"] / found[0][key]["dx_active"]))
        shifts.append(Estimate([sum(v) / len(v) for v in seeds.values()]))
    return shifts


def converged(runs):
    """The excursion at half the step and at a tenth of the tolerance, from the same states."""
    rows = []
    for shape in SHAPES:
        settings, found, common = _same_states(runs, shape)
        for (name, _), at, shift in zip(settings, found, [None, *converged_shifts(runs, shape)]):
            same, first, strains_of = [at[key] for key in common], at is found[0], {}
            for key in common:
                ratio_of_strains = strain(at[key], 0, 4) / strain(found[0][key], 0, 4)
                if ratio_of_strains > 0:
                    strains_of.setdefault(key[0], []).append(math.log(ratio_of_strains))
            strains = Estimate([sum(v) / len(v) for v in strains_of.values()])
            highest = max(nu for _, nu in common)
            rows.append([TITLE[shape], name, ", ".join(f"{nu:g}" for nu in sorted({nu for _, nu in common})),
                         f"{sum(judged(r) for r in same)} of {len(common)}",
                         *(exponent(same, "frequency", lambda r, q=q: r[q]).text() for q in ("dx_active", "dx_max")),
                         "1" if first else interval(*(math.exp(v) for v in (shift.mean, shift.mean - shift.half, shift.mean + shift.half))),
                         "1" if first else interval(*(math.exp(v) for v in (strains.mean, strains.mean - strains.half, strains.mean + strains.half))),
                         over_samples([r for r in same if r["parameters"]["frequency"] == highest], lambda r: 1e6 * r["drift"]).text(),
                         f"{sum(r['facts']['capped_steps'] for r in same)} of {sum(r['facts']['steps'] for r in same):,}"])
    return rows


def measures_of(found, *sets):
    """Cells: the powers of the law of compaction by each set of measures, and its scatter."""
    cells = []
    for measures in sets:
        law = compaction.Law(found, measures)
        cells += [number(p, e) for p, e in zip(law.powers, law.power_halves)] + [percent(law.scatter)]
    return cells


def _second_of_law(runs, shape, law):
    """The exponent of the rate over one second, 10 to 60 Hz, that the law gives with the mean thrust."""
    thrust = over_samples(series(runs, shape, "frequency"), lambda r: r["thrust"] or math.nan).mean
    return number(power([(nu, rate_of_law(law, thrust, nu)) for nu in (10, 12, 15, 20, 35, 60)])[1]) if law.fitted else "–"


def rigid_laws(runs):
    rows = []
    for shape in SHAPES:
        found = compaction.loading_runs(runs, shape)
        law = compaction.Law(found)
        measured = exponent([r for r in ten.every_frequency(runs, shape) if 9 <= r["parameters"]["frequency"] <= 61], "frequency",
                            first_second)
        rows.append([TITLE[shape], f"{law.run_count}; {law.count}", number(1e3 * law.share, 1e3 * law.share_half),
                     number(law.p, law.p_half), number(law.b, law.b_half), percent(law.scatter),
                     compaction.Prediction(found).text(), _second_of_law(runs, shape, law), measured.text()])
    return rows


def rigid_measures(runs):
    return [[TITLE[shape], *measures_of(compaction.loading_runs(runs, shape), ("excursion",), ("load",), ("t_u", "load"))]
            for shape in SHAPES]


def jammed_laws(runs):
    """The law of compaction from jammed states."""
    rows = []
    for shape in SHAPES:
        found = compaction.jammed_runs(runs, shape)
        law = compaction.Law(found, ("load",))
        values = sorted({r["parameters"]["frequency"] for r in found})
        mean, spread = excursion.mean_and_scatter([compaction.strain_over_load(r) for r in found if strain(r, 0, 4) > 0])
        rows.append([TITLE[shape], len({r["parameters"]["seed"] for r in found}), f"{len(found)}; {law.count}",
                     f"{values[0]:g} to {values[-1]:g} Hz", number(1e3 * law.share, 1e3 * law.share_half), number(law.p, law.p_half),
                     number(law.b, law.b_half), percent(law.scatter), compaction.Prediction(found, ("load",)).text(),
                     f"{1e3 * mean:.2f}, {percent(spread)}"])
    return rows


def jammed_measures(runs):
    return [[TITLE[shape], *measures_of(compaction.jammed_runs(runs, shape), ("excursion",), ("t_u",), ("nu",), ("t_u", "load"))]
            for shape in SHAPES]


def aside(runs):
    """The runs that were set aside, and what the others predict of them."""
    rows = []
    for shape in SHAPES:
        found = compaction.jammed_runs(runs, shape)
        load = compaction.SetAside(found, ("load",))
        made = [r for r in select(runs, shape, frequency=ANY, fmax=ANY, **JAMMED) if r.get("set_aside")]
        cells = []
        for fmax in (2000.0, 6000.0, 27000.0):
            at = [r for r in made if r["parameters"]["fmax"] == fmax]
            cells.append(f"{sum(judged(r) for r in at)} of {len(at)}")
        cells.append(f"{load.run_count}; {load.count}")
        for measure in ("load", "excursion", "t_u", "nu"):
            one = compaction.SetAside(found, (measure,))
            cells.append(f"{percent(one.law.scatter)}; {percent(one.rms)}, {100 * one.mean:+.0f} %".replace("-", "−"))
        test = excursion.Prediction(runs, shape, excursion.thrust_curves(runs, shape), **JAMMED)
        n = len(test.set_aside_ratios)
        rows.append([TITLE[shape], *cells, f"{n}: {_mean_scatter(test.set_aside_ratios)}" if n > 1 else "–"])
    return rows


def beyond(runs):
    """Measured over predicted strain of the runs at loads above L, with the law of the others at lower loads."""
    rows = []
    for shape in SHAPES:
        high = [r for r in compaction.jammed_runs(runs, shape, every_load=True) if compaction.load_over_length(r) >= 1]
        law = compaction.Law(compaction.jammed_runs(runs, shape), ("load",))
        data = compaction.points(high, ("load",))
        if data:
            residuals = law.residuals(data)
            excursions = [r["dx_active"] / r["length"] for r in high]
            rows.append([TITLE[shape], len(high), f"{min(excursions):.2f} to {max(excursions):.2f}",
                         f"{math.exp(sum(residuals) / len(residuals)):.2f}"])
    return rows


def boxes(runs):
    """Compaction in boxes of other shapes and lengths and of other grains, from jammed states."""
    rows = []
    for shape in SHAPES:
        cases = {}
        for run in select(runs, shape, frequency=ANY, fmax=ANY, grains=ANY, box_ratio=ANY, size_scale=ANY, **JAMMED):
            p = run["parameters"]
            if p["frequency"] in (2.0, 5.0) and compaction.has_usual_force(run) and compaction.is_short(run):
                cases.setdefault((p["frequency"], p["grains"], p["size_scale"], p["box_ratio"]), []).append(run)
        for (nu, grains, size, box), found in sorted(cases.items(), key=lambda case: (-case[0][0], *(-v for v in case[0][1:]))):
            def mean(value, factor=1.0):
                return over_samples(found, lambda r: factor * value(r)).text()
            if len({c for c in cases if c[0] == nu}) > 1:
                rows.append([TITLE[shape], f"{nu:g}", grains, f"{box:g}" + (f", sizes × {size:g}" if size != 1 else ""),
                             f"{len(found)}; {sum(judged(r) for r in found)}", f"{over_samples(found, lambda r: r['length']).mean:.2f}",
                             mean(constant), mean(lambda r: strain(r, 0, 4), 1e4), mean(compaction.strain_over_load, 1e3)])
    return rows


def box_laws(runs):
    """The law over all boxes of 1200 grains."""
    rows = []
    for shape in ("polyhedron", "polygon"):
        found = compaction.jammed_runs(runs, shape, True)
        rows.append([TITLE[shape], compaction.Law(found, ("load",)).run_count,
                     *measures_of(found, ("load",), ("excursion",), ("t_u",), ("t_u", "load"))])
    return rows


def ageing(runs):
    """Twenty periods at 5 and 20 Hz: the strain over the number of the period and over time. One run for each sample."""
    rows = []
    for shape in SHAPES:
        cells, found = [], {}
        for nu in (5.0, 20.0):
            found[nu] = [r for r in select(runs, shape, frequency=nu, **JAMMED) if len(r["periods"]["x_j"]) == 20]
        if not all(found.values()):
            continue
        for first, last in ((4, 8), (8, 20)):
            cells += [over_samples(found[nu], lambda r: strain(r, first, last) / strain(r, 0, 4)).text() for nu in found]
        of_sample = Estimate([math.log(a / b) for a, b in ten.aged(runs, shape)])
        cells.append(interval(*(math.exp(v) for v in (of_sample.mean, of_sample.mean - of_sample.half, of_sample.mean + of_sample.half))))
        rows.append([TITLE[shape], len(found[5.0]), *cells])
    return rows


WINDOWS = ((3, 30), (30, 100), (100, 300), (300, 1000))


def thousand(runs):
    """A thousand periods: the slope of the solid fraction over the logarithm of the number of the period."""
    rows = []
    for run in (r for shape in SHAPES for r in select(runs, shape, frequency=20.0, **JAMMED) if "long" in r["tables"]):
        table_of = run["tables"]["long"]
        if max(table_of["periods"]) < 500:
            continue
        for name, title in (("rho_inner", "inner volume"), ("rho_box", "whole box")):
            data = [(math.log(n), rho) for n, rho in zip(table_of["periods"], table_of[name])]
            cells = []
            for low, high in WINDOWS:
                part = [p for p in data if math.log(low) <= p[0] <= math.log(high)]
                _, b, error, _ = line([p[0] for p in part], [p[1] for p in part])
                cells.append(number(1e4 * b, 1e4 * error * student(len(part) - 2)))
            rows.append([TITLE[run["parameters"]["shape"]], title, *cells])
    return rows


def predictions(runs):
    """Excursions from the thrust over the displacement, beside the null models and the constant thrust."""
    rows = []
    for shape in SHAPES:
        test = excursion.Prediction(runs, shape, excursion.thrust_curves(runs, shape), **JAMMED)
        own = excursion.Prediction(runs, shape, **JAMMED)
        for title, names in (("fmax, g", ("fmax", "gravity")), ("m_w", ("wall_mass_ratio",)), ("ν", ("frequency",)), ("all", ())):
            rows.append([TITLE[shape], title, len(test.ratios(*names)), _mean_scatter(test.ratios(*names)),
                         _mean_scatter(test.null_ratios(True, *names)), _mean_scatter(test.null_ratios(False, *names)),
                         _mean_scatter(own.ratios(*names))])
    return rows


def trends(runs):
    """The shares of the grains of the slow test, the trend of its prediction, its scatter with all runs, and the exponents that it predicts."""
    rows = []
    for shape in SHAPES:
        test = excursion.Prediction(runs, shape, excursion.thrust_curves(runs, shape), **JAMMED)
        rows.append([TITLE[shape], over_samples(excursion.static_runs(runs, shape), excursion.static_thrust).text(),
                     Estimate(test.shares.values()).text(), test.trend(),
                     f"{len(test.ratios())} of {len(test.every_ratio())}", percent(excursion.mean_and_scatter(test.every_ratio())[1]),
                     *(text for name in ("frequency", "fmax", "gravity") for text in test.exponents(name))])
    return rows


def box_predictions(runs):
    """C of polyhedra in boxes of other shapes from the slow test in each, and from a power of H/L fitted to C in them."""
    return [[f"{height:.2f}", predicted.n, thrust.text(), predicted.text(), f"{null:.4f}", measured.text(), shares.text()]
            for height, thrust, predicted, null, measured, shares in _of_boxes(runs)]


def box_pairs(runs):
    """C of polyhedra in each box, predicted and measured: by `F`, and by a `power` of H/L fitted to C."""
    found = _of_boxes(runs)
    return {"F": [(predicted.mean, measured.mean) for _, _, predicted, _, measured, _ in found],
            "power": [(null, measured.mean) for _, _, _, null, measured, _ in found]}


def _of_boxes(runs):
    """H/L at t = 0, thrust, C predicted, C by the power of H/L, C measured, and the shares with which the thrust gives it."""
    rows, heights, logs = [], [], []
    for box in (0.42, 0.7, 1.0, 1.5):
        found = excursion.static_runs(runs, "polyhedron", box)
        measured = over_samples(of_one_length(select(runs, "polyhedron", frequency=5.0, box_ratio=box, jammed=False,
                                                     **COMPLIANT)), constant)
        predicted, shares = excursion.constants_of_boxes(runs, "polyhedron", box, measured.mean)
        heights.append(over_samples(found, lambda r: r["height"] / r["length"]).mean)
        logs.append(math.log(measured.mean))
        rows.append((over_samples(found, excursion.static_thrust), Estimate(predicted), measured, Estimate(shares)))
    a, b, _, _ = line([math.log(h) for h in heights], logs)
    return [(h, thrust, predicted, math.exp(a + b * math.log(h)), measured, shares) for h, (thrust, predicted, measured, shares) in zip(heights, rows)]


def forms(runs):
    """Polyhedra of other shapes and friction, and concave grains, beside the paper's case."""
    cases = [("convex, 3D: the paper's case", "polyhedron", {}),
             ("at least 30 vertices", "polyhedron", {"fewest_vertices": 30}),
             ("at most 12 vertices", "polyhedron", {"most_vertices": 12})]
    cases += [(f"flatness {f:g}", "polyhedron", {"flatness": f}) for f in (0.7, 0.5, 0.4)]
    cases += [(f"friction {f:g}", "polyhedron", {"friction": f}) for f in (0.1, 0.2, 0.7, 1.0)]
    cases += [("concave, 3D", "compound", {}), ("spheres", "sphere", {}), ("convex, 2D", "polygon", {}),
              ("concave, 2D", "compound_polygon", {})]
    rows = []
    for name, shape, changed in cases:
        found = [r for r in select(runs, shape, frequency=5.0, jammed=False, **(COMPLIANT | changed))
                 if 0.9 < r["parameters"]["duration"] <= 1]
        steps = sum(r["facts"]["steps"] for r in found)
        unsolved = sum(r["facts"]["capped_steps"] for r in found)
        rows.append([name, len(found), *(over_samples(found, value).text() for value in (
            lambda r: r["rho_box_initial"], constant, lambda r: 1e4 * strain(r, 0, 4), lambda r: 1e3 * compaction.strain_over_load(r),
            ten.ratio("jammed"))), f"{100 * unsolved / steps:.2g} %" if unsolved else "0"])
    return rows


def method_of_2008(runs):
    """The paper's own numerics, beside those of this study."""
    rows = []
    sets = [("2008: QM/16 at 1e-3, at most 200 sweeps, overlaps kept",
             {"tolerance": 1e-3, "max_sweeps": 200, "overlap_correction": False}),
            ("rigid, QM/16 at 1e-4", {}), ("compliant, residual 1e-5", COMPLIANT)]
    for shape in ("polyhedron", "polygon"):
        for name, wanted in sets:
            found = [r for r in select(runs, shape, frequency=5.0, seed=1, jammed=False, **wanted)
                     if r["parameters"]["duration"] == 1]
            over_nu = [exponent([r for r in series(runs, shape, "frequency", seed=1, jammed=False, **wanted)
                                 if r["parameters"]["frequency"] > 1.5], "frequency",
                                lambda r, quantity=quantity: r[quantity]).text()
                       for quantity in ("dx_max", "dx_active")]
            for run in found[:1]:
                rows.append([TITLE[shape], name, f"{1e3 * run['dx_max']:.2f}", f"{1e3 * run['drift']:.3f}".replace("-", "−"),
                             f"{constant(run):.3f}", *over_nu, f"{1e4 * strain(run, 0, 4):.1f}",
                             f"{run['facts']['max_overlap_over_d']:.1e}",
                             f"{run['facts']['capped_steps']} of {run['facts']['steps']}"])
    return rows


def unsolved(runs):
    """The runs with compliant contacts that have steps that are not solved."""
    return [[r["name"], r["facts"]["capped_steps"], r["facts"]["steps"]] for r in runs
            if r["parameters"]["method"] == "compliant" and r["facts"]["capped_steps"] > 0]


def remaining(folder, name):
    """What the batch runner said of the runs that are not done: rows of the table."""
    lines = (folder / f"remaining-{name}.md").read_text(encoding="utf8").strip().splitlines()
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in lines if row.startswith("|") and " | 0 of " not in row][2:]
