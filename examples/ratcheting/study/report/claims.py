# SPDX-License-Identifier: MIT
"""The ten claims of the paper: for each, one primary observable with its standard error, for four
shapes, and one verdict."""
import math

import excursion
from figures import first_second, rise, speeds
from runs import (ANY, COMPLIANT, SHAPES, constant, excursion_judged, exponent, of_one_length, over_samples, power, select,
                  series, strain)


def base(runs, shape, **wanted):
    """The paper's case in all samples: 5 Hz, 6 kN, m_w = m/2, H/L = 1, one second."""
    return [r for r in select(runs, shape, frequency=5.0, jammed=False, **wanted)
            if r["parameters"]["duration"] == 1]


def flat(runs):
    """Polyhedra in boxes that are to be 0.42 as high as long, compliant contacts."""
    return of_one_length(select(runs, "polyhedron", frequency=5.0, box_ratio=0.42, jammed=False,
                                **COMPLIANT))


def rate_exponent(runs, shape, low, high, rate):
    """The exponent of a rate over the frequencies low..high, sample by sample."""
    found = [r for r in series(runs, shape, "frequency")
             if low <= r["parameters"]["frequency"] <= high]
    return exponent(found, "frequency", rate)


def frequency_exponent(runs, low, high):
    """The exponent of the excursion of polyhedra over the frequencies low..high."""
    return rate_exponent(runs, "polyhedron", low, high, lambda r: r["dx_active"])


def of_dimension(runs, **wanted):
    """C of polygons over that of polyhedra, of disks over that of spheres, at 5 Hz and H/L = 1, in percent."""
    c = {shape: over_samples(base(runs, shape, **wanted), constant).mean for shape in SHAPES}
    return (f"{100 * (c['polygon'] / c['polyhedron'] - 1):.0f} % (polygons over polyhedra) and "
            f"{100 * (c['disk'] / c['sphere'] - 1):.0f} % (disks over spheres)")


def four_periods(run):
    return run["parameters"]["frequency"] * strain(run, 0, 4)


def predicted_exponent(runs, shape, parameter, **wanted):
    """The exponent of the excursion that each run's own thrust and carried mass predict, above 1 Hz."""
    def value(run):
        if not run["steady_thrust"]:
            return math.nan
        p = run["parameters"]
        return excursion.displacement(lambda _: run["steady_thrust"] * run["weight"],
                                      run["wall_mass"] + run["carried_share"] * run["mass"],
                                      p["fmax"], p["frequency"])
    found = [r for r in loaded(runs, shape, parameter, **wanted)
             if r["parameters"]["frequency"] > 1.5]
    return exponent(found, parameter, value)


def loaded(runs, shape, parameter, **wanted):
    return [r for r in series(runs, shape, parameter, **wanted)
            if r["parameters"]["fmax"] >= 1000 and excursion_judged(r)]


def wall_scatter(runs, shape):
    """Standard deviation of ln [dx (m + m_w)] over the wall masses, in percent: mean over samples."""
    scatters = {}
    for run in series(runs, shape, "wall_mass_ratio", frequency=5.0):
        scatters.setdefault(run["parameters"]["seed"], []).append(
            math.log(run["dx_active"] * (run["mass"] + run["wall_mass"])))
    def deviation(v):
        m = sum(v) / len(v)
        return 100 * math.sqrt(sum((x - m) ** 2 for x in v) / (len(v) - 1))
    return sum(deviation(v) for v in scatters.values()) / len(scatters)


def line_scatter(runs, shape, **wanted):
    """C over all loads and its scatter: mean of C, standard deviation of ln C."""
    values = {}
    for parameter, fixed in (("frequency", {}), ("fmax", {"frequency": 5.0}),
                             ("gravity", {"frequency": 5.0}), ("wall_mass_ratio", {"frequency": 5.0})):
        for run in loaded(runs, shape, parameter, **(wanted | fixed)):
            values[run["name"]] = constant(run)
    logs = [math.log(v) for v in values.values() if v > 0]
    if len(logs) < 2:
        return math.nan, math.nan, len(logs)
    mean = sum(logs) / len(logs)
    return math.exp(mean), math.sqrt(sum((v - mean) ** 2 for v in logs) / (len(logs) - 1)), len(logs)


def over_shapes(value):
    return [value(shape) for shape in SHAPES]


def ratio(name):
    return lambda run: run["behaviour"][name + "_xx"] / run["behaviour"][name + "_zz"]


def convection(runs, shape):
    """Angle by which the field of displacements of a period turns [mrad], counter-clockwise with the
    wall on the right. From the tables of the runs that have them."""
    def angle(run):
        table = run["tables"].get("displacement_field")
        if not table:
            return math.nan
        rows = [r for r in zip(*(table[k] for k in ("x", "z", "u_x", "u_z", "grains"))) if r[4] > 0]
        n = len(rows)
        mean = [sum(r[k] for r in rows) / n for k in range(4)]
        turning = sum((r[0] - mean[0]) * (r[3] - mean[3]) - (r[1] - mean[1]) * (r[2] - mean[2])
                      for r in rows)
        arms = sum((r[0] - mean[0]) ** 2 + (r[1] - mean[1]) ** 2 for r in rows)
        return 1e3 * turning / arms
    return over_samples(base(runs, shape, **COMPLIANT), angle)


def contracting(runs):
    """In how many periods x_j falls, over all shapes and samples of the paper's case."""
    found = [r for shape in SHAPES for r in base(runs, shape)]
    fall, all_of_them = sum(r["contracting"] for r in found), sum(len(r["periods"]["x_j"]) for r in found)
    return f"In {fall} of {all_of_them} periods of four shapes and three samples."


def in_contraction(run, volume):
    """Change of the solid fraction of a control volume from the largest x to the next maximum of f, mean
    over the periods [1e-4]; nan without its table."""
    table = run["tables"].get("packing", {})
    if volume not in table:
        return math.nan
    def at(time):
        return next((rho for t, rho in zip(table["t"], table[volume]) if t >= time - 1e-9), math.nan)
    changes = [at(finish) - at(peak) for peak, finish in zip(run["periods"]["t_peak"],
                                                             run["periods"]["t_finish"])]
    return 1e4 * sum(changes) / len(changes)


def other_volumes(runs):
    """What other control volumes say of contraction, for polyhedra."""
    found = base(runs, "polyhedron", **COMPLIANT)
    texts = []
    for volume, name in (("rho_inner", "the inner volume"), ("rho_to_wall", "a volume up to the wall"),
                         ("rho_to_lid", "one up to the lid"), ("rho_moving", "one that moves with the wall")):
        e = over_samples(found, lambda r, volume=volume: in_contraction(r, volume))
        if e.n:
            texts.append(f"{e.text()} in {name}")
    if not texts:
        return ""
    return (" With compliant contacts the change from the largest x to the next maximum of f is "
            + ", ".join(texts) + " (polyhedra).")


class Claim:
    def __init__(self, text, observable, paper, cells, verdict, cause):
        self.text, self.observable, self.paper = text, observable, paper
        self.cells, self.verdict, self.cause = cells, verdict, cause


def claims(runs):
    def at_base(value, factor=1.0, digits=2):
        return over_shapes(lambda s: over_samples(base(runs, s), value).text(digits, factor))

    in_flat = flat(runs)
    flat_rho = over_samples(in_flat, lambda r: r["rho_box_initial"])
    flat_c = over_samples(in_flat, constant)
    heights = [r["height"] / r["length"] for r in in_flat]
    flat_text = f"H/L = {sum(heights) / len(heights):.2f} (set: 0.42)" if heights else ""
    turned = {s: convection(runs, s) for s in SHAPES}
    has_field = all(e.n > 0 for e in turned.values())
    polyhedra = turned["polyhedron"]
    turns = polyhedra.n > 1 and abs(polyhedra.mean) > 2 * polyhedra.error
    rolls = at_base(lambda r: r["behaviour"]["roll"], 1e3)
    heavy = over_samples(select(runs, "polyhedron", frequency=5.0, wall_mass_ratio=4.0), rise)
    light = over_samples(select(runs, "polyhedron", frequency=5.0, wall_mass_ratio=0.1), rise)
    own = predicted_exponent(runs, "polyhedron", "frequency")
    one_second = over_shapes(lambda s: rate_exponent(runs, s, 9, 61, first_second).text())
    low = rate_exponent(runs, "polyhedron", 1.5, 7.5, four_periods)
    high = rate_exponent(runs, "polyhedron", 9, 61, four_periods)
    extension = over_samples(base(runs, "polyhedron"), lambda r: 1e4 * r["behaviour"]["rho_extension"])

    return [
        Claim("The initial solid fraction is 0.50.", "ρ of the whole box at t = 0", "0.50",
              at_base(lambda r: r["rho_box_initial"]),
              "depends on the box" if in_flat else "not reproduced",
              f"The gap of 1 cm below the lid is a larger share of a flat box: {flat_rho.text()} at "
              f"{flat_text} (samples: {flat_rho.n}). Spheres and polyhedra differ by 0.01."
              if in_flat else "0.529 at H/L = 0.7: the gap below the lid is a larger share of a flat box. "
              "Flatter boxes are not run (section 7)."),
        Claim("The wall jams farther in after every period.",
              "strain (x_j − x_j′)/L of the first four periods [1e-4]", "> 0",
              at_base(lambda r: strain(r, 0, 4), 1e4), "reproduced",
              contracting(runs) + " The wall turns back δt_r = "
              + over_samples(base(runs, "polyhedron"), lambda r: r["delay"]).text(factor=1e3)
              + " ms after the minimum of f (polyhedra)."),
        Claim("In extension f_g rises slightly with x.",
              "rise of f_g over the excursion / mean f_g", "“slightly”", at_base(rise),
              "not reproduced",
              f"The rise is the inertia of the grains that move along. It falls with the mass of the wall, "
              f"from {light.text()} at m/10 to {heavy.text()} at 4 m (polyhedra). The paper does not give its wall."),
        Claim("Force chains are horizontal in the jammed state, vertical in the active state.",
              "σ_xx/σ_zz at the maximum of f", "> 1", at_base(ratio("jammed")), "reproduced",
              "In extension the ratio is " + ", ".join(at_base(ratio("active"))) + "."),
        Claim("The grains move in a clockwise roll.",
              "angle of the displacement field of a period [mrad]" if has_field else
              "rotation of the velocity field in contraction [mrad/s]", "clockwise (< 0), wall's side not "
              "given", over_shapes(lambda s: turned[s].text()) if has_field else rolls,
              ("sense depends on the wall's side" if turns else "velocities turn, displacements of a period do not")
              if has_field else "not decided",
              ("Clockwise with the wall on the " + ("left" if turned["polyhedron"].mean > 0 else "right")
               if turns else "The field of polyhedra has no sense beyond its error") + ". The paper shows velocities in "
              "contraction: those turn by " + ", ".join(rolls) + " mrad/s, counter-clockwise with the wall on the "
              "right as here, clockwise with the wall on the left (rigid contacts)."
              if has_field else "Convection is the displacement over a period, which the rigid runs do not "
              "have. The velocities in contraction turn counter-clockwise with the wall on the right, that "
              "is clockwise with the wall on the left."),
        Claim("The solid fraction rises in extension and falls in contraction.",
              "change of ρ of the inner volume in contraction [1e-4]", "< 0",
              at_base(lambda r: r["behaviour"]["rho_contraction"], 1e4), "not reproduced",
              f"Most of the compaction does happen in extension ({extension.text()} for polyhedra), but the "
              "inner volume also densifies in contraction. The whole box does the opposite by definition." + other_volumes(runs)),
        Claim("The excursion goes as ν⁻².", "exponent of Δx over ν, 2 to 60 Hz, without drift", "−2",
              over_shapes(lambda s: exponent(
                  [r for r in series(runs, s, "frequency") if r["parameters"]["frequency"] > 1.5],
                  "frequency", lambda r: r["dx_active"]).text()), "reproduced to 0.1",
              "In long excursions the thrust is smaller, which the smaller carried mass does not make up (figure). The closed form with "
              f"each run's own thrust and carried mass has {own.text()} for polyhedra. From 2 to 10 Hz polyhedra have "
              f"{frequency_exponent(runs, 1.5, 11).text()}, from 10 to 60 Hz {frequency_exponent(runs, 9, 61).text()}; 1 Hz is left out."),
        Claim("The largest inward speed goes as ν⁻¹; phase portraits collapse.",
              "exponent of v_max over ν, 2 to 60 Hz", "−1",
              over_shapes(lambda s: exponent(
                  [r for r in series(runs, s, "frequency") if r["parameters"]["frequency"] > 1.5],
                  "frequency", lambda r: r["v_max"]).text()), "not reproduced",
              "On the way back the wall goes past x_j by the strain of the period, and is pushed on meanwhile. That strain "
              "does not scale as ν⁻² (claim 10). v_max/(Δx ν) of all loads rises with the way back over "
              "the excursion (figure), with the powers " + ", ".join(
                  "{1:.2f} ± {2:.2f}".format(*power(speeds(runs, s))) for s in SHAPES) + ". That is also why the phase portraits do "
              "not collapse."),
        Claim("All excursions lie on one line with C = 0.01 in 3D and 0.05 in 2D.",
              "C at 5 Hz, H/L = 1, without drift", "0.01; 0.05",
              at_base(constant), "one line within 10 to 17 %; C depends on the box",
              "C = 0.228 (F/mg)² (m + m_w)/(m_w + βm), and the thrust F grows with H/L (figure). "
              + (f"{flat_text} has C = {flat_c.text()} (samples: {flat_c.n}). " if in_flat else
                 "H/L = 0.7 has 0.025, H/L = 1.46 has 0.056. ")
              + "In boxes of the same H/L C of the plane is larger by " + of_dimension(runs) + "; compliant: "
              + of_dimension(runs, **COMPLIANT) + "."),
        Claim("The compaction rate grows as ν up to 10 Hz and falls as ν⁻¹ beyond.",
              "exponent of the rate in the first second, 10 to 60 Hz", "−1", one_second,
              "not reproduced",
              f"Over a fixed number of periods the rate is nearly constant: exponent {high.text()} above 9 Hz and "
              f"{low.text()} between 2 and 7 Hz (polyhedra). The decline over one second is ageing: at higher ν "
              "more periods fit into it (section 6)."),
    ]
