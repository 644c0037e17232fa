# SPDX-License-Identifier: MIT
"""The observables of the paper's claims, and the runs that they are taken from."""
import math

import compaction
from runs import (ANY, COMPLIANT, SHAPES, TITLE, judged, select, series, strain)


# The parameters of the load, and what is fixed in the series of each.
LOADS = (("frequency", {}), ("fmax", {"frequency": 5.0}), ("gravity", {"frequency": 5.0}),
         ("wall_mass_ratio", {"frequency": 5.0}))


def base(runs, shape, **wanted):
    """The paper's case in all samples: 5 Hz, 6 kN, m_w = m/2, H/L = 1, one second."""
    return [r for r in select(runs, shape, frequency=5.0, jammed=False, **wanted)
            if r["parameters"]["duration"] == 1]


def jammed_ratio(run):
    """H/L at the first maximum of f that is judged. H is the height of the box, gap below the lid included."""
    return run["height"] / (run["length"] + run["periods"]["x_j"][0])


def above_1_hz(runs, shape):
    return [r for r in series(runs, shape, "frequency") if r["parameters"]["frequency"] > 1.5]


def highest(found):
    return max((r["parameters"]["frequency"] for r in found), default=math.nan)


def four_periods(run):
    return run["parameters"]["frequency"] * strain(run, 0, 4)


def loaded(runs, shape, parameter, **wanted):
    return [r for r in series(runs, shape, parameter, **wanted)
            if r["parameters"]["fmax"] >= 1000 and judged(r)]


def ratio(name):
    return lambda run: run["behaviour"][name + "_xx"] / run["behaviour"][name + "_zz"]


def turning(run):
    """Angle by which the field of displacements of a period turns [mrad], counter-clockwise with the wall on the right;
    nan without its table."""
    table = run["tables"].get("displacement_field")
    if not table:
        return math.nan
    rows = [r for r in zip(*(table[k] for k in ("x", "z", "u_x", "u_z", "grains"))) if r[4] > 0]
    mean = [sum(r[k] for r in rows) / len(rows) for k in range(4)]
    turned = sum((r[0] - mean[0]) * (r[3] - mean[3]) - (r[1] - mean[1]) * (r[2] - mean[2]) for r in rows)
    arms = sum((r[0] - mean[0]) ** 2 + (r[1] - mean[1]) ** 2 for r in rows)
    return 1e3 * turned / arms


def in_contraction(run, volume, end="t_finish"):
    """Change of the solid fraction of a control volume from the largest x to the next maximum of f, or to another
    time of the period, mean over the periods [1e-4]; nan without its table."""
    table = run["tables"].get("packing", {})
    if volume not in table or end not in run["periods"] or None in run["periods"][end]:
        return math.nan

    def at(time):
        return next((rho for t, rho in zip(table["t"], table[volume]) if t >= time - 1e-9), math.nan)
    changes = [at(finish) - at(peak) for peak, finish in zip(run["periods"]["t_peak"],
                                                             run["periods"][end])]
    return 1e4 * sum(changes) / len(changes)


VOLUMES = {"rho_inner": "inner", "rho_to_wall": "up to the wall", "rho_to_lid": "up to the lid",
           "rho_moving": "moving with the wall"}


def every_frequency(runs, shape):
    """Rigid contacts, over the frequency, runs of a second or of five periods."""
    return [r for r in series(runs, shape, "frequency") if r["parameters"]["duration"] <= 5]


def aged(runs, shape):
    """Strain of the periods 9 to 20 over that of the first four, at 5 and at 20 Hz, for each sample that has both."""
    found = {}
    for nu in (5.0, 20.0):
        for r in select(runs, shape, frequency=nu, jammed=True, **COMPLIANT):
            if len(r["periods"]["x_j"]) == 20:
                found.setdefault(r["parameters"]["seed"], {})[nu] = strain(r, 8, 20) / strain(r, 0, 4)
    return [(values[5.0], values[20.0]) for _, values in sorted(found.items()) if len(values) == 2]


def jammed_position(run):
    """Position of the wall at the first maximum of f over the length of the box: it tells jammed states apart."""
    return run["periods"]["x_j"][0] / run["length"]


def states(runs):
    """The samples of which runs at one force start from two jammed states or more, as text. The position of the wall in a jammed state
    depends on the force, so states at different forces cannot be compared."""
    texts = []
    for shape in SHAPES:
        several = []
        for seed in range(1, 6):
            places = {}
            for r in select(runs, shape, frequency=ANY, fmax=ANY, seed=seed, jammed=True, **COMPLIANT):
                if compaction.is_short(r):
                    places.setdefault(r["parameters"]["fmax"], []).append(jammed_position(r))
            if any(b - a > 1e-4 for found in map(sorted, places.values()) for a, b in zip(found, found[1:])):
                several.append(str(seed))
        if several:
            texts.append(f"{' and '.join(several)} of {TITLE[shape].split(', ')[1]}")
    return ", ".join(texts)
