# SPDX-License-Identifier: MIT
"""The figures of the report."""
import math

import compaction
import controls
import excursion
from interval import ratio, ratio_of_means
from plots import BLACK, COLOR, GREY, POINT, Panel, draw
from runs import (ANY, CASE, COMPLIANT, SHAPES, SMALLEST, TITLE, Estimate, constant, judged,
                  over_samples, scaled_load, select, series, shapes_of, strain, thrust_ratio,
                  unjammed_time)

SPREAD = {"polyhedron": 0.94, "polygon": 0.98, "sphere": 1.02, "disk": 1.06}


class Missing(Exception):
    """The runs that a figure shows are not in the table."""


def course(runs, shape):
    """The run of the first sample at 5 Hz with its tables: with compliant contacts if there is one."""
    for wanted in (COMPLIANT, {}):
        for run in select(runs, shape, frequency=5.0, seed=1, jammed=False, **wanted):
            if "wall" in run["tables"]:
                return run
    return None


def by_value(runs, parameter, value, factor=1.0):
    """Rows parameter, mean over the samples, half of its 95 % interval."""
    found = {}
    for run in runs:
        found.setdefault(run["parameters"][parameter], []).append(run)
    rows = []
    for x, group in sorted(found.items()):
        e = over_samples(group, value)
        rows.append((x, factor * e.mean, factor * e.half))
    return rows


def jamming(runs):
    """Runs whose largest force jams the packing: above 3.5 times the weight of polyhedra."""
    return [run for run in runs if run["parameters"]["fmax"] >= CASE["fmax"] / 6]


def columns(run, table, *names):
    return list(zip(*(run["tables"][table][name] for name in names)))


def every_course(runs):
    """The shapes that have a run with tables, and these runs."""
    found = [(shape, course(runs, shape)) for shape in SHAPES if course(runs, shape)]
    if not found:
        raise Missing
    return found


def every_shape(runs):
    """The shapes that have runs over the frequency."""
    found = shapes_of(runs)
    if not found:
        raise Missing
    return found


def panel_per_course(runs, x_label, y_label, commands, add):
    """A panel for each run of every_course(), into which add(panel, shape, run) draws. Returns the
    panels and the first of the runs."""
    panels, found = [], every_course(runs)
    for shape, run in found:
        panel = Panel(TITLE[shape], x_label, y_label if not panels else "", commands)
        add(panel, shape, run)
        panels.append(panel)
    return panels


def x_t(runs, path):
    panels, found = [], every_course(runs)
    for shape, run in found:
        panel = Panel(TITLE[shape], "", "x  [mm]" if not panels else "")
        panel.curve([(t, 1e3 * x) for t, x in columns(run, "wall", "t", "x")], COLOR[shape])
        panels.append(panel)
    for shape, run in found:
        panel = Panel("", "t  [s]", "f  [kN]" if len(panels) == len(found) else "")
        panel.curve([(t, 1e-3 * f) for t, f in columns(run, "wall", "t", "f")], GREY)
        panels.append(panel)
    draw(path, panels, 2, len(found), 1500, 620, "0.055, 0.99, 0.1, 0.93", "0.04, 0.06")


def period_of(run, number):
    """Rows (time since the maximum of f over the period, x - x_j, v, f_g, f) of a period."""
    start, nu = run["periods"]["t_start"][number], run["parameters"]["frequency"]
    x_j = run["periods"]["x_j"][number]
    return [((t - start) * nu, x - x_j, v, f_g, f)
            for t, x, v, f_g, f in columns(run, "wall", "t", "x", "v", "f_g", "f")
            if -1e-9 <= (t - start) * nu <= 1 + 1e-9]


def one_period(runs, path):
    number, found, panels = 1, every_course(runs), []
    for what in ("x", "f"):
        for shape, run in found:
            rows = period_of(run, number)
            start, nu = run["periods"]["t_start"][number], run["parameters"]["frequency"]
            label = "x − x_j  [mm]" if what == "x" else "f  [kN]"
            panel = Panel(TITLE[shape] if what == "x" else "", "" if what == "x" else "time since f = fmax / period",
                          label if run is found[0][1] else "",
                          ["set key off", "set xrange [0:1]",
                           'set arrow from 0.5, graph 0 to 0.5, graph 1 nohead dt 3 lc rgb "#7a7a7a"'])
            values = [(r[0], 1e3 * r[1] if what == "x" else 1e-3 * r[4]) for r in rows]
            panel.curve(values, COLOR[shape] if what == "x" else GREY)
            for key in ("t_onset", "t_peak"):
                at = (run["periods"][key][number] - start) * nu
                panel.points([min(values, key=lambda v: abs(v[0] - at))], BLACK, 6)
            panels.append(panel)
    draw(path, panels, 2, len(found), 1500, 640, "0.055, 0.99, 0.1, 0.93", "0.04, 0.06")


def field(runs, path, table, names, unit):
    panels, found = [], [(s, r) for s, r in every_course(runs) if table in r["tables"]]
    if not found:
        raise Missing
    for shape, run in found:
        rows = [r for r in columns(run, table, "x", "z", *names, "grains") if r[4] > 0]
        longest = max(math.hypot(r[2], r[3]) for r in rows)
        scale = 0.13 * run["length"] / longest
        # The displacements are net of their mean, so that a uniform shift does not hide the roll.
        length, height = run["length"], run["height"]
        step = 0.1 if length < 0.5 else 0.2
        panel = Panel(f"{TITLE[shape]}\\nlongest arrow {unit(longest)}", "x  [m]",
                      "z  [m]" if not panels else "",
                      ["set size ratio -1", f"set xrange [{-0.03 * length}:{1.03 * length}]",
                       f"set yrange [{-0.03 * height}:{1.08 * height}]", f"set xtics {step}",
                       f"set ytics {step}"])
        panel.add([(x - scale * u / 2, z - scale * w / 2, scale * u, scale * w)
                   for x, z, u, w, _ in rows], "1:2:3:4",
                  f'with vectors head filled size graph 0.018, 22 lc rgb "{COLOR[shape]}"')
        panels.append(panel)
    draw(path, panels, 1, len(found), 1500, 470, "0.06, 0.99, 0.14, 0.84", "0.05, 0.1")


def velocity_field(runs, path):
    field(runs, path, "velocity_field", ("v_x", "v_z"), lambda v: f"{1e3 * v:.0f} mm/s")


def displacement_field(runs, path):
    field(runs, path, "displacement_field", ("u_x", "u_z"), lambda v: f"{1e3 * v:.2f} mm")


def f_g_x(runs, path):
    def add(panel, shape, run):
        weight, colors = run["weight"], ("#9db9d9", "#5f8fc4", "#2f66a3", "#16335b")
        for number in range(min(4, len(run["periods"]["x_j"]))):
            rows = period_of(run, number)
            peak = max(r[1] for r in rows)
            panel.curve([(r[1] / peak, r[3] / weight) for r in rows], colors[number],
                        f"period {number + 1}", 1.2)
        panel.commands += ["set yrange [0:6]", "set xrange [-1.4:1.1]"]

    panels = panel_per_course(runs, "(x − x_j) / Δx_{max}", "f_g / mg",
                                   ["set key bottom left"], add)
    draw(path, panels, 1, len(panels), 1500, 460, "0.05, 0.99, 0.14, 0.89", "0.04, 0.1")


def force_chains(runs, path):
    panels, found = [], [(s, r) for s, r in every_course(runs) if "chains_active" in r["tables"]]
    for state in ("jammed", "active"):
        for shape, run in found:
            rows = columns(run, "chains_" + state, "x_from", "z_from", "x_to", "z_to",
                           "normal_force")
            unit = sum(r[4] for r in rows) / len(rows)
            b = run["behaviour"]
            ratio = b[state + "_xx"] / b[state + "_zz"]
            length, height = run["length"], run["height"]
            panel = Panel(f"{TITLE[shape]}, {state}: σ_{{xx}}/σ_{{zz}} = {ratio:.2f}", "", "",
                          ["set size ratio -1", f"set xrange [{-0.01 * length}:{1.01 * length}]",
                           f"set yrange [{-0.01 * height}:{1.01 * height}]", "unset tics",
                           "unset grid"])
            for k in range(1, 9):
                part = [(x, z, a - x, c - z) for x, z, a, c, f in rows
                        if 0.6 * k * unit < f and (f <= 0.6 * (k + 1) * unit or k == 8)]
                panel.add(part, "1:2:3:4",
                          f'with vectors nohead lw {0.7 * k} lc rgb "{COLOR[shape]}"')
            panels.append(panel)
    draw(path, panels, 2, len(found), 1500, 860, "0.01, 0.99, 0.01, 0.95", "0.01, 0.06")


def rho_t(runs, path):
    def add(panel, shape, run):
        for name, color, title in (("rho_inner", COLOR[shape], "inner volume"),
                                   ("rho_box", GREY, "whole box")):
            rows = columns(run, "packing", "t", name)
            panel.curve([(t, rho - rows[0][1]) for t, rho in rows], color,
                        f"{title}, ρ(0) = {rows[0][1]:.3f}")

    panels = panel_per_course(runs, "t  [s]", "ρ − ρ(0)", ["set key bottom right"], add)
    draw(path, panels, 1, len(panels), 1500, 430, "0.062, 0.99, 0.15, 0.89", "0.045, 0.1")


def rho_x(runs, path):
    def add(panel, shape, run):
        packing = columns(run, "packing", "t", "rho_inner", "rho_box")
        wall = columns(run, "wall", "t", "x")
        start, finish = run["periods"]["t_start"][1], run["periods"]["t_finish"][1]
        x_j, peak = run["periods"]["x_j"][1], run["periods"]["dx_max"][1]
        x_of = {round(t, 4): x for t, x in wall}
        rows = [(x_of[round(t, 4)] - x_j, inner, box) for t, inner, box in packing
                if start - 1e-9 <= t <= finish + 1e-9 and round(t, 4) in x_of]
        for k, color, title in ((1, COLOR[shape], "inner volume"), (2, GREY, "whole box")):
            panel.curve([(r[0] / peak, 1e4 * (r[k] - rows[0][k])) for r in rows], color, title)

    panels = panel_per_course(runs, "(x − x_j) / Δx_{max}", "ρ − ρ_j  [1e-4]",
                                   ["set key bottom left", "set xtics 0.5"], add)
    draw(path, panels, 1, len(panels), 1500, 430, "0.062, 0.99, 0.15, 0.89", "0.045, 0.1")


def mean_loop(runs, shape, nu):
    """Rows (x - x_j, v) of the mean loop over the samples; empty without one."""
    loops = [run["loop"] for run in select(runs, shape, frequency=nu) if run["loop"]]
    return [(sum(loop["x"][k] for loop in loops) / len(loops), sum(loop["v"][k] for loop in loops) / len(loops))
            for k in range(len(loops[0]["x"]))] if loops else []


def phase_portrait(runs, path):
    panels = []
    for scaled in (False, True):
        for shape in every_shape(runs):
            first = len(panels) % len(every_shape(runs)) == 0
            panel = Panel("" if scaled else TITLE[shape],
                          "(x − x_j) ν²  [mm/s²]" if scaled else "x − x_j  [mm]",
                          ("v ν  [mm/s²]" if scaled else "v  [mm/s]") if first else "",
                          ["set key bottom left", "set xtics 20" if scaled else "set xtics 1"])
            for nu, color, dash in ((5.0, COLOR[shape], 1), (10.0, BLACK, 2)):
                rows = mean_loop(runs, shape, nu)
                if not rows:
                    continue
                a, b = (1e3 * nu * nu, 1e3 * nu) if scaled else (1e3, 1e3)
                panel.curve([(a * x, b * v) for x, v in rows], color, f"{nu:g} Hz", 1.8, dash)
            panels.append(panel)
    draw(path, panels, 2, len(panels) // 2, 1500, 760, "0.065, 0.99, 0.1, 0.93", "0.05, 0.13")


def dx_v_frequency(runs, path):
    panels = [Panel("excursion without drift", "ν  [Hz]", "Δx  [mm]",
                    ["set logscale xy", "set key bottom left",
                     "set xrange [0.8:75]"]),
              Panel("largest inward speed", "ν  [Hz]", "v_{max}  [mm/s]",
                    ["set logscale xy", "set key bottom left", "set xrange [0.8:75]", "set yrange [8:*]"]),
              Panel("the same over ν^{−2}: the paper's C", "ν  [Hz]", "C",
                    ["set logscale x", "set yrange [0:0.09]", "set key top right maxrows 3",
                     "set xrange [0.8:75]"]),
              Panel("the same over ν^{−1}", "ν  [Hz]", "v_{max} ν  / value at 10 Hz",
                    ["set logscale x", "set yrange [0:1.6]", "set key bottom right",
                     "set xrange [0.8:75]"])]
    for shape in every_shape(runs):
        found = series(runs, shape, "frequency")
        shift = SPREAD[shape]
        all_judged = {nu: all(judged(r) for r in found if r["parameters"]["frequency"] == nu)
                  for nu in {r["parameters"]["frequency"] for r in found}}

        def draw_excursion(panel, value, unit=1.0):
            for is_open in (False, True):
                panel.bars([(x * shift, y, e) for x, y, e in by_value(found, "frequency", value, unit) if all_judged[x] != is_open],
                           COLOR[shape], POINT[shape] - is_open, None if is_open else TITLE[shape])
        draw_excursion(panels[0], lambda r: r["dx_active"], 1e3)
        rows = [(x * shift, y, e) for x, y, e in
                by_value(found, "frequency", lambda r: r["v_max"], 1e3)]
        panels[1].bars(rows, COLOR[shape], POINT[shape], TITLE[shape])
        draw_excursion(panels[2], constant)
        rows = by_value(found, "frequency", lambda r: r["v_max"] * r["parameters"]["frequency"])
        ten = next((y for x, y, _ in rows if x == 10), rows[0][1])
        panels[3].bars([(x * shift, y / ten, e / ten) for x, y, e in rows], COLOR[shape],
                       POINT[shape], TITLE[shape])
    panels[0].function("0.6 * (x / 5)**-2", GREY, "ν^{−2}")
    panels[1].function("130 * (x / 5)**-1", GREY, "ν^{−1}")
    panels[2].function("0.01", "#1f5fa8", "paper, 3D")
    panels[2].function("0.05", "#b3261e", "paper, 2D")
    panels[3].function("1", GREY)
    draw(path, panels, 2, 2, 1400, 1000)


def dx_loads(runs, path):
    panels = [Panel("", "fmax  [kN]", "Δx fmax / value at 6 kN", ["set xrange [0:11]",
                                                                   "set yrange [0.5:1.5]"]),
              Panel("", "g  [m/s²]", "Δx / g²  / value at 9.81 m/s²",
                    ["set xrange [0:22]", "set yrange [0.5:1.5]"]),
              Panel("", "m_w / m", "Δx (m + m_w) / value at m/2",
                    ["set logscale x", "set xrange [0.07:6]", "set yrange [0.5:1.5]", "set key bottom left"])]
    cases = (("fmax", lambda r: r["dx_active"] * r["parameters"]["fmax"], CASE["fmax"], 1e-3),
             ("gravity", lambda r: r["dx_active"] / r["parameters"]["gravity"] ** 2, 9.81, 1),
             ("wall_mass_ratio", lambda r: r["dx_active"] * (r["mass"] + r["wall_mass"]), 0.5, 1))
    for panel, (parameter, value, base, unit) in zip(panels, cases):
        for shape in every_shape(runs):
            rows = by_value(jamming(series(runs, shape, parameter, frequency=5.0)), parameter, value)
            middle = next((y for x, y, _ in rows if x == base), math.nan)
            shift = SPREAD[shape]
            panel.bars([(x * unit * shift, y / middle, e / middle) for x, y, e in rows],
                       COLOR[shape], POINT[shape], TITLE[shape])
        panel.function("1", GREY, "paper")
    draw(path, panels, 1, 3, 1500, 480, "0.055, 0.99, 0.14, 0.95", "0.06, 0.1")


def master(runs, path):
    panels = []
    series_of = (("frequency", {}, 9, "ν"), ("fmax", {"frequency": 5.0}, 7, "fmax"),
                 ("gravity", {"frequency": 5.0}, 5, "g"),
                 ("wall_mass_ratio", {"frequency": 5.0}, 13, "m_w"))
    colors = ("#1f5fa8", "#b3261e", "#2e7d4f", "#d07a00")
    for near in (False, True):
        for shape in every_shape(runs):
            panel = Panel(TITLE[shape] + (", near the origin" if near else ""),
                          "(mg)² / [(m + m_w) fmax ν²]  [mm]",
                          "Δx  [mm]" if len(panels) % 4 == 0 else "",
                          ["set key top left"])
            top, low = 0, math.inf
            for (parameter, wanted, symbol, title), color in zip(series_of, colors):
                found = {}
                for run in jamming(series(runs, shape, parameter, **wanted)):
                    found.setdefault(run["parameters"][parameter], []).append(run)
                rows = []
                for group in found.values():
                    load, e = Estimate([scaled_load(r) for r in group]), over_samples(
                        group, lambda r: r["dx_active"])
                    rows.append((1e3 * load.mean, 1e3 * e.mean, 1e3 * e.half, all(judged(r) for r in group)))
                if near:
                    rows = [r for r in rows if r[0] <= 4]
                for is_open in (False, True):
                    panel.bars([r[:3] for r in rows if r[3] != is_open], color, symbol - is_open, None if is_open else title, 0.9)
                top, low = max([top] + [r[0] for r in rows]), min([low] + [r[0] for r in rows])
            c = over_samples(series(runs, shape, "frequency"), constant).mean
            panel.function(f"{c:.4f} * x", BLACK, f"C = {c:.3f}", 1)
            panel.function(f"{0.01 if shape in ('polyhedron', 'sphere') else 0.05} * x", GREY,
                           "paper")
            if near and top == 0:
                panel.curves.clear()
            panel.commands += ([f"set xrange [0:{1.08 * top or 1:.4g}]"] if near else
                               ["set logscale xy", "set format '10^{%L}'", f"set xrange [{0.6 * low:.3g}:{1.7 * top:.3g}]"])
            panels.append(panel)
    draw(path, panels, 2, len(panels) // 2, 1600, 820, "0.045, 0.99, 0.09, 0.95", "0.035, 0.13")


def compaction_rate(runs, path):
    panels = []
    fitted = compaction.laws(runs)
    for shape in every_shape(runs):
        panel = Panel(TITLE[shape], "ν  [Hz]", "rate  [1e-3/s]" if not panels else "",
                      ["set logscale x", "set yrange [0:*]", "set xrange [0.8:75]",
                       "set key off" if panels else "set key bottom right"])
        found = series(runs, shape, "frequency")
        rows = [(x * 0.98, y, e) for x, y, e in
                by_value(found, "frequency", lambda r: r["parameters"]["frequency"] *
                         strain(r, 0, 4), 1e3)]
        panel.bars(rows, COLOR[shape], 7, "four periods")
        rows = [(x * 1.02, y, e) for x, y, e in
                by_value([r for r in found if r["parameters"]["frequency"] >= 2], "frequency",
                         first_second, 1e3)]
        panel.bars(rows, GREY, 6, "one second")
        law = fitted[shape]
        mean_thrust = over_samples(found, lambda r: (r["thrust"] or math.nan)).mean
        panels.append(panel)
        if not law.fitted:
            continue
        for n, color, title in ((4, COLOR[shape], "law"), (None, GREY, None)):
            points = [(nu, 1e3 * rate_of_law(law, mean_thrust, nu, n))
                      for nu in (65 ** (k / 59) for k in range(60))]
            panel.curve(points, color, title, 1.2, 2)
    draw(path, panels, 1, len(panels), 1600, 460, "0.045, 0.99, 0.14, 0.9", "0.035, 0.1")


def last_in_first_second(run):
    return max([k for k, t in enumerate(run["jams"]["t"]) if t <= 1 + 1e-9] + [1])


def first_second(run):
    """Strain rate of the box between the first jammed state and the last one within the first second."""
    times, x, last = run["jams"]["t"], run["jams"]["x"], last_in_first_second(run)
    return (x[0] - x[last]) / run["length"] / (times[last] - times[0])


def density_rate(run):
    """Relative rate of the solid fraction of the inner volume over the same time, the paper's procedure."""
    times, rho, last = run["jams"]["t"], run["jams"]["rho_inner"], last_in_first_second(run)
    return (rho[last] / rho[0] - 1) / (times[last] - times[0])


def rate_of_law(law, thrust, frequency, count=None):
    """Strain rate by the law of t_u with a thrust [N]: mean over `count` periods, or over those of a second,
    which has 0.85 ν − 0.75 between its first and its last maximum of f; nan for fewer than two."""
    t_u = math.acos(1 - 2 * thrust / CASE["fmax"]) / (math.pi * frequency)
    count = count or 0.85 * frequency - 0.75
    if count < 2:
        return math.nan
    whole = int(count)
    return frequency / count * (sum(law.strain(t_u, i + 1) for i in range(whole)) +
                                (count - whole) * law.strain(t_u, whole + 1))


def compaction_law(runs, path):
    panels = []
    fitted = compaction.laws(runs)
    shapes = [shape for shape in every_shape(runs) if fitted[shape].fitted]
    if not shapes:
        raise Missing
    for shape in shapes:
        law = fitted[shape]
        panel = Panel(TITLE[shape], "t_u  [ms]", "strain of a period × n^b" if not panels else "",
                      ["set logscale xy", "set xrange [0.8:200]", "set yrange [2e-5:3e-2]",
                       "set format y '10^{%L}'", "set key bottom right"])
        data = [g for run in compaction.loading_runs(runs, shape) for g in compaction.groups(run)]
        for first, color, symbol, title in ((True, COLOR[shape], 7, "periods 1, 2"),
                                            (False, BLACK, 6, "periods 3 to 64")):
            panel.points([(1e3 * t, eps * n ** law.b) for t, n, eps, _ in data
                          if (n < 2.5) == first and eps > 0], color, symbol, title, 0.55)
        panel.function(f"{law.share:.6g} * (x / 10)**{law.p:.4f}", GREY,
                       f"t_u^{{{law.p:.2f}}}", 1)
        panels.append(panel)
    for shape in shapes:
        law = fitted[shape]
        panel = Panel("", "period n", "strain of a period / fit at n = 1" if shape == shapes[0]
                      else "", ["set logscale xy", "set xrange [0.8:70]", "set yrange [0.02:4]",
                                "set key bottom left"])
        for nu, color, symbol in ((5.0, "#d07a00", 7), (10.0, "#2e7d4f", 5), (20.0, "#1f5fa8", 9),
                                  (60.0, "#b3261e", 13)):
            rows = {}
            for run in series(runs, shape, "frequency"):
                if run["parameters"]["frequency"] == nu:
                    for t_u, n, eps, _ in compaction.groups(run):
                        rows.setdefault(n, []).append(eps / law.strain(t_u, 1))
            panel.bars([(n, Estimate(v).mean, Estimate(v).half) for n, v in sorted(rows.items())],
                       color, symbol, f"{nu:g} Hz")
        panel.function(f"x**{-law.b:.4f}", GREY, f"n^{{−{law.b:.2f}}}", 1)
        panels.append(panel)
    draw(path, panels, 2, len(shapes), 1600, 860, "0.055, 0.99, 0.08, 0.95", "0.035, 0.12")


def one_state(runs, path):
    """Strain over t_u and over the scaled load, from jammed states, with compliant contacts."""
    rows = [("t_u  [ms]", lambda r: 1e3 * unjammed_time(r), "[0.5:300]", "6e-4 * x / 10", "∝ t_u", 2),
            ("ℓ / L", compaction.load_over_length, "[1e-4:10]", "7.5e-3 * sqrt(x)", "0.0075 (ℓ/L)^{1/2}", 2)]
    panels, shapes = [], []
    for label, value, limits, line, title, dash in rows:
        for shape in SHAPES:
            found = [r for r in select(runs, shape, frequency=ANY, fmax=ANY, jammed=True, **COMPLIANT)
                     if compaction.is_short(r)]
            if len({r["parameters"]["frequency"] for r in found}) < 3:
                continue
            first = not shapes or shape == shapes[0]
            shapes.append(shape)
            panel = Panel(TITLE[shape] if label.startswith("t_u") else "", label,
                          "strain of a period, mean of four" if first else "",
                          ["set logscale xy", f"set xrange {limits}", "set yrange [5e-5:2e-2]",
                           "set format y '10^{%L}'", "set key bottom right"]
                          + ([] if label.startswith("t_u") else ["set format x '10^{%L}'"]))
            for fmax, color, symbol in ((2000.0, "#2e7d4f", 9), (6000.0, "#1f5fa8", 7), (27000.0, "#b3261e", 5)):
                groups = {}
                for r in found:
                    if r["parameters"]["fmax"] == fmax and strain(r, 0, 4) > 0 and value(r) > 0:
                        groups.setdefault(r["parameters"]["frequency"], []).append(r)
                for is_open in (False, True):
                    panel.bars([(Estimate([value(r) for r in group]).mean, e.mean, e.half)
                                for group in groups.values() if all(judged(r) for r in group) != is_open
                                for e in [Estimate([strain(r, 0, 4) for r in group])]],
                               color, symbol - 1 if is_open else symbol,
                               None if is_open else f"{fmax / 1000:g} kN", 0.9)
            groups = {}
            for r in select(runs, shape, frequency=ANY, fmax=ANY, grains=ANY, box_ratio=ANY, size_scale=ANY, jammed=True, **COMPLIANT):
                p = r["parameters"]
                other = (p["grains"], p["box_ratio"], p["size_scale"])
                if other != (CASE["grains"], 1.0, 1.0) and compaction.has_usual_force(r) and value(r) > 0:
                    groups.setdefault((*other, p["frequency"]), []).append(r)
            for is_open in (False, True):
                panel.bars([(Estimate([value(r) for r in group]).mean, e.mean, e.half)
                            for group in groups.values() if all(judged(r) for r in group) != is_open
                            for e in [Estimate([strain(r, 0, 4) for r in group])] if e.mean > 0],
                           BLACK, 12 if is_open else 13, None if is_open else "other boxes", 0.9)
            panel.function(line, GREY, title, dash)
            panels.append(panel)
    if not panels:
        raise Missing
    draw(path, panels, 2, len(panels) // 2, 1500, 860, "0.065, 0.99, 0.08, 0.95", "0.045, 0.12")


def set_aside(runs, path):
    """Strain measured over that predicted by the law of the runs that were not set aside."""
    panels = []
    for shape in SHAPES:
        found = compaction.jammed_runs(runs, shape)
        test = compaction.SetAside(found, ("load",))
        if test.count == 0:
            continue
        panel = Panel(TITLE[shape], "strain predicted", "" if panels else "strain measured",
                      ["set logscale xy", "set xrange [5e-5:2e-2]", "set yrange [5e-5:2e-2]",
                       "set format xy '10^{%L}'", "set key bottom right"])
        for is_aside, color, symbol, title in ((False, GREY, 6, "fitted"), (True, COLOR[shape], 7, "set aside")):
            data = compaction.points([r for r in found if r["set_aside"] == is_aside], ("load",))
            panel.points([(math.exp(y - e), math.exp(y)) for (_, _, y), e in zip(data, test.law.residuals(data))],
                         color, symbol, title, 0.6)
        panel.function("x", BLACK, None, 1)
        for factor in (math.exp(test.law.scatter), math.exp(-test.law.scatter)):
            panel.function(f"{factor:.6g} * x", BLACK)
        panels.append(panel)
    if not panels:
        raise Missing
    draw(path, panels, 1, len(panels), 400 * len(panels), 460, "0.065, 0.99, 0.15, 0.9", "0.045, 0.1")


def thrust(runs, path):
    panels = [Panel("thrust", "Δx / d", "F / mg", ["set logscale x", "set format x '10^{%L}'",
                                                   "set yrange [0:0.6]", "set key bottom left"]),
              Panel("carried mass", "Δx / d", "β", ["set logscale x", "set format x '10^{%L}'",
                                                    "set yrange [0:1.2]", "set key off"])]
    for shape in every_shape(runs):
        groups = {}
        for parameter, wanted in (("frequency", {}), ("fmax", {"frequency": 5.0}),
                                  ("gravity", {"frequency": 5.0})):
            for run in jamming(series(runs, shape, parameter, **wanted)):
                groups.setdefault((parameter, run["parameters"][parameter]), []).append(run)
        for panel, key in zip(panels, ("steady_thrust", "carried_share")):
            rows = []
            for group in groups.values():
                e = over_samples(group, lambda r, key=key: r[key] if r[key] is not None else math.nan)
                dx = over_samples(group, lambda r: r["dx_active"]).mean
                rows.append((dx / SMALLEST, e.mean, e.half))
            panel.bars(rows, COLOR[shape], POINT[shape], TITLE[shape])
    draw(path, panels, 1, 2, 1200, 480, "0.07, 0.99, 0.14, 0.91", "0.07, 0.1")


def predicted(runs, path):
    """The thrust over the displacement of a slow wall, and the excursions that it predicts."""
    panels = [Panel("slow test", "displacement [mm]", "F / mg",
                    ["set xrange [0:1.6]", "set yrange [0:0.6]", "set key bottom left"]),
              Panel("excursion, one parameter changed", "measured Δx [mm]", "measured / predicted Δx",
                    ["set logscale x", "set xrange [0.02:60]", "set yrange [0.5:1.7]", "set key bottom right"])]
    for shape in every_shape(runs):
        curves = excursion.thrust_curves(runs, shape)
        for k, curve in enumerate(curves.values()):
            panels[0].curve([(1e3 * x, f) for x, f in zip(curve.x, curve.f)], COLOR[shape],
                            None if k else TITLE[shape], 1.4)
        found = excursion.Prediction(runs, shape, curves, jammed=True, **COMPLIANT)
        for beyond in (False, True):
            panels[1].points([(1e3 * run["dx_active"], run["dx_active"] / value)
                              for pairs in found.pairs.values() for run, value in pairs
                              if beyond == (value > curves[run["parameters"]["seed"]].x[-1])],
                             COLOR[shape], POINT[shape] - (1 if beyond else 0),
                             None if beyond else TITLE[shape], 0.9)
    if not panels[0].curves:
        raise Missing
    panels[1].function("1", GREY, None, 1)
    draw(path, panels, 1, 2, 1200, 480, "0.07, 0.99, 0.14, 0.91", "0.07, 0.1")


def box_runs(runs, shape):
    """Runs at 5 Hz and 6 kN in boxes of all shapes, with grains of all sizes, both sets of contacts."""
    found = []
    for wanted in (COMPLIANT, {}):
        found += select(runs, shape, frequency=5.0, box_ratio=ANY, size_reading=ANY, size_scale=ANY,
                        jammed=False, **wanted)
    return found


def box(runs, path):
    axis = ["set logscale x", "set xrange [0.27:1.8]", "set xtics (0.3, 0.42, 0.5, 0.7, 1, 1.5)"]
    panels = [Panel("prefactor", "H / L", "C", [*axis, "set logscale y", "set yrange [0.005:0.2]",
                                                 "set key top left"]),
              Panel("thrust in extension", "H / L", "F / mg",
                    [*axis, "set logscale y", "set yrange [0.08:0.9]", "set key top left",
                     "set ytics (0.1, 0.2, 0.3, 0.5)"]),
              Panel("solid fraction of the box at the start", "H / L", "ρ",
                    [*axis, "set yrange [0.48:0.56]", "set key bottom right"])]
    values = (constant, thrust_ratio, lambda r: r["rho_box_initial"])
    if not box_runs(runs, "polyhedron"):
        raise Missing
    for shape, text in (("polyhedron", "polyhedra"), ("polygon", "polygons")):
        for method, symbol in (("contact-dynamics", 6), ("compliant", 7)):
            found = {}
            for run in box_runs(runs, shape):
                p = run["parameters"]
                if p["method"] == method and p["size_reading"] == "circumdiameter" and \
                        p["size_scale"] == 1:
                    found.setdefault(p["box_ratio"], []).append(run)
            for panel, value in zip(panels, values):
                if shape == "polygon" and panel is panels[2]:
                    continue
                rows = []
                for ratio, group in sorted(found.items()):
                    e = over_samples(group, value)
                    rows.append((Estimate([r["height"] / r["length"] for r in group]).mean
                                 * (1 if shape == "polyhedron" else 1.02), e.mean, e.half))
                panel.bars(rows, COLOR[shape], symbol + (0 if shape == "polyhedron" else -2),
                           f"{text}, {'rigid' if method != 'compliant' else 'compliant'}")
    panels[0].function("0.01", "#1f5fa8", "paper, 3D")
    panels[0].function("0.05", "#b3261e", "paper, 2D")
    panels[2].function("0.50", "#1f5fa8", "paper")
    draw(path, panels, 1, 3, 1500, 480, "0.062, 0.99, 0.14, 0.89", "0.06, 0.1")


def rise(run):
    """By how much f_g rises while the wall moves out, over its mean."""
    return run["behaviour"]["active_slope"] * run["dx_active"] / run["thrust"]


def force_rise(runs, path):
    panel = Panel("", "m_w / m", "rise of f_g over the excursion / mean f_g",
                  ["set logscale x", "set xrange [0.07:6]", "set yrange [0:4]"])
    for shape in every_shape(runs):
        rows = by_value(series(runs, shape, "wall_mass_ratio", frequency=5.0), "wall_mass_ratio", rise)
        if len(rows) < 2:
            raise Missing
        panel.bars([(x * SPREAD[shape], y, e) for x, y, e in rows], COLOR[shape], POINT[shape],
                   TITLE[shape])
    draw(path, [panel], 1, 1, 760, 480, "0.1, 0.98, 0.13, 0.96")


class ReturnPhase:
    """The way back of the wall at one frequency, means over periods and samples: phases since the minimum of f, in
    periods, when the wall turns back and when it is fastest; force over fmax then; the share of the impulse of f
    between that the grains take, 1 - m_w v_max / impulse; v_max times frequency [m/s²]."""

    def __init__(self, frequency, rows):
        def mean(k):
            return sum(row[k] for row in rows) / len(rows)
        self.frequency = frequency
        self.samples = len({row[5] for row in rows})
        self.turn, self.fastest, self.force, self.share, self.speed = (mean(k) for k in range(5))


def return_phases(runs, shape):
    """ReturnPhase by rising frequency: compliant contacts, from jammed states, the paper's force. Frequencies
    at which a run is not judged are left out."""
    found = {}
    for run in select(runs, shape, frequency=ANY, jammed=True, **COMPLIANT):
        p, periods = run["parameters"], run["periods"]
        if "t_v_max_passive" not in periods or not compaction.is_short(run):
            continue
        nu, rows = p["frequency"], found.setdefault(p["frequency"], [])
        if not judged(run):
            rows.append(None)
            continue
        for least, peak, fastest, v in zip(*(periods[k] for k in (
                "t_force_minimum", "t_peak", "t_v_max_passive", "v_max_passive"))):
            if fastest is None or fastest <= peak:
                continue
            a, b = nu * (peak - least), nu * (fastest - least)

            def impulse(phase):  # of f / fmax since the minimum, in periods
                return phase / 2 - math.sin(2 * math.pi * phase) / (4 * math.pi)
            pushed = p["fmax"] * (impulse(b) - impulse(a)) / nu
            rows.append((a, b, math.sin(math.pi * b) ** 2, 1 - run["wall_mass"] * v / pushed, v * nu, p["seed"]))
    return [ReturnPhase(nu, rows) for nu, rows in sorted(found.items()) if rows and None not in rows]


CONTACTS = (("rigid, filling", {"jammed": False}), ("compliant, filling", COMPLIANT | {"jammed": False}),
            ("compliant, jammed", COMPLIANT | {"jammed": True}))
SMALL = {"polygon": 94, "disk": 111}


def five_hertz(runs, shape, small=False, **wanted):
    """Runs at 5 Hz and 5 N for each grain, one second from the filling on or four periods from a jammed state. `small`: in the
    boxes of the plane that are as long as those of space; with rigid contacts to a tenth of the tolerance."""
    if small:
        rigid = {} if "method" in wanted else {"tolerance": 1e-5}
        return select(runs, shape, frequency=5.0, grains=SMALL[shape], fmax=ANY, box_ratio=0.9, **(rigid | wanted))
    found = select(runs, shape, frequency=5.0, **wanted)
    return [r for r in found if (compaction.is_short(r) if wanted["jammed"] else r["parameters"]["duration"] == 1)]


def dimension(runs, path):
    """C and strain of a period, plane over space."""
    panels = [Panel("C", "", "plane / space", ["set key top left"]), Panel("strain of a period", "", "", ["set key off"])]
    names = ", ".join(f'"{name.replace(", ", chr(92) + "n")}" {k}' for k, (name, _) in enumerate(CONTACTS))
    for panel in panels:
        panel.commands += ["set logscale y", "set yrange [0.22:4.4]", "set xrange [-0.5:2.5]", f"set xtics ({names})",
                           "set ytics (0.25, 0.5, 0.75, 1, 1.25, 1.5, 2)"]
    quantities = ((constant, ratio), (lambda r: strain(r, 0, 4), ratio_of_means))
    for k, (plane, space) in enumerate((("polygon", "polyhedron"), ("disk", "sphere"))):
        for small in (False, True):
            for panel, (value, compare) in zip(panels, quantities):
                rows = []
                for x, (_, wanted) in enumerate(CONTACTS):
                    above, below = (over_samples(found, value) for found in (
                        five_hertz(runs, plane, small, **wanted), five_hertz(runs, space, **wanted)))
                    if above.n > 1 and below.n > 1 and not (small and x == 1):
                        rows.append((x + 0.16 * (2 * k + small - 1.5), *compare(above.values, below.values)))
                panel.ranges(rows, COLOR[plane], POINT[plane] - (not small),
                             f"{TITLE[plane].split(', ')[1]} / {TITLE[space].split(', ')[1]}, {'one length' if small else '1200 grains in both'}")
    if not panels[0].curves:
        raise Missing
    for panel in panels:
        panel.function("1", GREY)
    draw(path, panels, 1, 2, 1300, 480, "0.06, 0.99, 0.14, 0.91", "0.06, 0.1")


def equal_length(runs, path):
    """C and strain of a period, plane over space in boxes of equal length, over this length: the runs of the plan `controls`."""
    panels = []
    colors = {"rigid": "#b3261e", "compliant": "#1f5fa8"}
    for quantity, name, axis in (("C", "C", ["set logscale xy", "set yrange [0.4:2.5]", "set ytics (0.5, 0.75, 1, 1.5, 2)"]),
                                 ("strain", "strain of a period", ["set logscale x", "set yrange [0:1.7]"])):
        for plane, space in controls.PAIRS:
            has_key = len(panels) == 1
            panel = Panel(f"{name}: {TITLE[plane].split(', ')[1]} / {TITLE[space].split(', ')[1]}", "L / d",
                          "plane / space" if plane == "polygon" else "", ["set key top right" if has_key else "set key off"])
            panel.commands += [*axis, "set xrange [7:20]", "set xtics (8, 10.7, 15.1)"]
            for k, (contacts, start) in enumerate(controls.CONTACTS_AND_STARTS):
                rows = []
                for length in controls.LENGTHS:
                    above, below = (controls.select(runs, shape, contacts, start, length) for shape in (plane, space))
                    value, low, high, *_ = controls.compare(above, below, quantity)
                    if math.isfinite(value):
                        rows.append((controls.mean(above, "length").mean * 1.025 ** (k - 1.5), value, low, high))
                panel.ranges(rows, colors[contacts], (6 if start == "filling" else 7) - 2 * (contacts == "rigid"), f"{contacts}, {start}")
            panels.append(panel)
    if not any(panel.curves for panel in panels):
        raise Missing
    for panel in panels:
        panel.function("1", GREY)
    draw(path, panels, 2, 2, 1300, 860, "0.06, 0.99, 0.08, 0.95", "0.06, 0.13")


def way_back(runs, path):
    panels = [Panel("phases since the minimum of f", "ν  [Hz]", "periods", ["set key off"]),
              Panel("force when the wall is fastest", "ν  [Hz]", "f / fmax", ["set key off"]),
              Panel("impulse that the grains take", "ν  [Hz]", "share of the impulse of f", ["set key bottom right"]),
              Panel("largest inward speed", "ν  [Hz]", "v_{max} ν  [m/s²]", ["set key off"])]
    limits = ("[0:0.3]", "[0:0.6]", "[0:1]", "[0:1.6]")
    for panel, limit in zip(panels, limits):
        panel.commands += ["set logscale x", "set xrange [0.8:40]", f"set yrange {limit}"]
    for shape in SHAPES:
        rows = return_phases(runs, shape)
        shift = SPREAD[shape]
        panels[0].points([(shift * r.frequency, r.fastest) for r in rows], COLOR[shape], POINT[shape],
                         f"{TITLE[shape]}: fastest")
        panels[0].points([(shift * r.frequency, r.turn) for r in rows], COLOR[shape], POINT[shape] - 1, None)
        for panel, value in zip(panels[1:], ("force", "share", "speed")):
            panel.points([(shift * r.frequency, getattr(r, value)) for r in rows], COLOR[shape], POINT[shape],
                         TITLE[shape])
    if not panels[0].curves:
        raise Missing
    draw(path, panels, 1, 4, 1700, 430, "0.052, 0.99, 0.15, 0.89", "0.055, 0.1")


def long_course(runs, path):
    """Solid fraction over the number of periods at 20 Hz, the longest run of each shape."""
    panels = []
    for shape in ("polyhedron", "polygon"):
        found = [r for r in runs if r["parameters"]["shape"] == shape and "long" in r["tables"]]
        if not found:
            raise Missing
        panel = Panel(TITLE[shape], "period n", "ρ − ρ(first maximum of f)" if not panels else "",
                      ["set logscale x", "set key top left"])
        for run in found:
            rows = columns(run, "long", "periods", "rho_inner", "rho_box")
            rigid = run["parameters"]["method"] != "compliant"
            for k, title in ((1, "inner volume"), (2, "whole box")):
                panel.points([(r[0] + 0.25, r[k] - rows[0][k]) for r in rows],
                             GREY if k == 2 else COLOR[shape], 6 if rigid else 7,
                             f"{title}, {'rigid' if rigid else 'compliant'}", 0.9)
        panels.append(panel)
    draw(path, panels, 1, 2, 1200, 430, "0.085, 0.98, 0.15, 0.89", "0.075, 0.1")


# Name, function. The captions are in the templates of the pages.
FIGURES = (
    ("x_t", x_t),
    ("one_period", one_period),
    ("velocity_field", velocity_field),
    ("displacement_field", displacement_field),
    ("f_g_x", f_g_x),
    ("force_rise", force_rise),
    ("force_chains", force_chains),
    ("rho_t", rho_t),
    ("rho_x", rho_x),
    ("phase_portrait", phase_portrait),
    ("way_back", way_back),
    ("dx_v_frequency", dx_v_frequency),
    ("dx_loads", dx_loads),
    ("master", master),
    ("thrust", thrust),
    ("predicted", predicted),
    ("box", box),
    ("dimension", dimension),
    ("compaction_rate", compaction_rate),
    ("compaction_law", compaction_law),
    ("one_state", one_state),
    ("set_aside", set_aside),
    ("long_course", long_course),
)
# The same of the runs of the plan `controls`.
CONTROL_FIGURES = (("equal_length", equal_length),)
