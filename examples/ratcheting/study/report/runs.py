# SPDX-License-Identifier: MIT
"""The table of the runs: reading, selection, and the statistics of the report.

A run is the dictionary of its line in runs.jsonl. All quantities are in SI units."""
import json
import math
import pathlib
from collections import Counter

from interval import Estimate, finite, student

SHAPES = ("polyhedron", "polygon", "sphere", "disk")
TITLE = {"polyhedron": "3D, polyhedra", "polygon": "2D, polygons", "sphere": "3D, spheres",
         "disk": "2D, disks"}
SMALLEST = 0.025  # smallest grain size d of the paper [m]

# The paper's case: what select() demands unless it is told otherwise.
CASE = {"grains": 1200, "fmax": 6000.0, "fmin": 0.0, "gravity": 9.81, "wall_mass_ratio": 0.5,
        "size_reading": "circumdiameter", "size_scale": 1.0, "box_ratio": 1.0,
        "lid_force_weights": 10.0, "friction": 0.4}
# The two sets of runs. Rigid contacts: the stopping test QM/16 of LMGC90 at 1e-4. Compliant contacts:
# k = 1e8 N/m, residual 1e-5.
RIGID = {"method": "contact-dynamics", "step": 2e-4, "tolerance": 1e-4, "max_sweeps": 5000,
         "overlap_correction": True}
COMPLIANT = {"method": "compliant", "step": 2e-4, "tolerance": 1e-5, "stiffness": 1e8}
# Parameters that a line has only if they are not these.
DEFAULT = {"wall_speed": 0, "flatness": 1.0, "fewest_vertices": 0, "most_vertices": 0}
ANY = object()


def read(path):
    """The runs of a table. If none has the paper's number of grains, as in the plan `small`, the case
    that select() demands becomes the most frequent one. Runs named in set_aside.txt beside the table are marked
    `set_aside`: they were made after the laws had been fitted to the others."""
    with open(path, encoding="utf8") as file:
        runs = [json.loads(line) for line in file]
    aside = pathlib.Path(path).parent / "set_aside.txt"
    if aside.exists():
        names = set(aside.read_text(encoding="utf8").split())
        for run in runs:
            run["set_aside"] = run["name"] in names
    if runs and not any(run["parameters"]["grains"] == CASE["grains"] for run in runs):
        for known, keys in ((CASE, ("grains", "fmax")), (RIGID, ("step",))):
            for key in keys:
                known[key] = Counter(run["parameters"][key] for run in runs).most_common(1)[0][0]
    return runs


def shapes_of(runs):
    """The shapes that have runs over the frequency."""
    return [shape for shape in SHAPES if series(runs, shape, "frequency")]


def select(runs, shape, **wanted):
    """The runs of a shape with the paper's parameters but for `wanted`; ANY leaves one open. Without a
    method: rigid contacts."""
    contacts = COMPLIANT if wanted.get("method") == "compliant" else RIGID
    conditions = DEFAULT | CASE | contacts | wanted
    jammed = conditions.pop("jammed", ANY)
    return [run for run in runs
            if run["parameters"]["shape"] == shape and
            (jammed is ANY or jammed == ("from" in run["parameters"])) and
            all(value is ANY or run["parameters"].get(key, DEFAULT.get(key)) == value
                for key, value in conditions.items())]


def series(runs, shape, parameter, **wanted):
    """Runs that differ in one parameter and the sample, by rising parameter. A run of the same
    parameters that lasts longer is left out."""
    found = {}
    for run in select(runs, shape, **{parameter: ANY}, **wanted):
        key = (run["parameters"][parameter], run["parameters"]["seed"])
        if key not in found or run["parameters"]["duration"] < found[key]["parameters"]["duration"]:
            found[key] = run
    return [found[key] for key in sorted(found)]


def of_one_length(runs):
    """The runs with the most periods of at most a second; the preparations of jammed states are left out."""
    lengths = [r["parameters"]["duration"] for r in runs if 0.5 < r["parameters"]["duration"] <= 1]
    return [r for r in runs if lengths and r["parameters"]["duration"] == max(lengths)]


def over_samples(runs, value):
    """Estimate over the seeds of the mean of value(run) of each seed."""
    seeds = {}
    for run in runs:
        seeds.setdefault(run["parameters"]["seed"], []).append(value(run))
    means = []
    for values in seeds.values():
        values = finite(values)
        if values:
            means.append(sum(values) / len(values))
    return Estimate(means)


def line(x, y):
    """Least squares y = a + b x: a, b, standard error of b, standard deviation of the residuals."""
    n = len(x)
    mx, my = sum(x) / n, sum(y) / n
    sxx = sum((v - mx) ** 2 for v in x)
    b = sum((u - mx) * (v - my) for u, v in zip(x, y)) / sxx
    a = my - b * mx
    scatter = math.sqrt(sum((v - a - b * u) ** 2 for u, v in zip(x, y)) / (n - 2)) if n > 2 else math.nan
    return a, b, scatter / math.sqrt(sxx), scatter


def power(points, fewest=3):
    """Fit of y = c x^b to pairs of positive numbers: c, b, error of b, scatter of ln y; nan if there
    are fewer than three."""
    points = [(math.log(x), math.log(y)) for x, y in points
              if x and y and math.isfinite(x) and math.isfinite(y) and x > 0 and y > 0]
    if len(points) < fewest:
        return (math.nan,) * 4
    a, b, error, scatter = line([p[0] for p in points], [p[1] for p in points])
    return math.exp(a), b, error, scatter


def exponent_of_samples(runs, argument, value, fewest=3):
    """The exponent of value(run) over argument(run), fitted sample by sample: Estimate. Its interval is the wider of that
    over the samples, which may agree by chance, and that of the scatter about the fits. Samples with less than `fewest` values
    of the argument are left out."""
    seeds = {}
    for run in runs:
        seeds.setdefault(run["parameters"]["seed"], []).append((argument(run), value(run)))
    fits = [power(points, fewest) + (len(points),) for points in seeds.values() if len({p[0] for p in points}) >= fewest]
    fits = [fit for fit in fits if math.isfinite(fit[1])]
    e = Estimate([fit[1] for fit in fits])
    freedom = sum(fit[4] - 2 for fit in fits)
    if freedom > 0:
        of_fits = math.sqrt(sum(fit[2] ** 2 for fit in fits if fit[4] > 2)) / e.n
        if e.n == 1 or student(freedom) * of_fits > student(e.n - 1) * e.error:
            e.error, e.freedom = of_fits, freedom
    return e


def exponent(runs, parameter, value):
    """The exponent of value(run) over a parameter; see exponent_of_samples()."""
    return exponent_of_samples(runs, lambda run: run["parameters"][parameter], value)


def solve(matrix, right):
    """Gaussian elimination with pivoting."""
    n = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def least_squares(rows, values):
    """Coefficients of a linear model."""
    n = len(rows[0])
    matrix = [[sum(row[i] * row[j] for row in rows) for j in range(n)] for i in range(n)]
    return solve(matrix, [sum(row[i] * v for row, v in zip(rows, values)) for i in range(n)])


# Quantities of a run.

def constant(run, displacement="dx_active"):
    """C of the paper's equation 4."""
    p = run["parameters"]
    load = run["weight"] ** 2 / ((run["mass"] + run["wall_mass"]) * p["fmax"] * p["frequency"] ** 2)
    return run[displacement] / load


JAMMED_MOTION = 0.3  # largest motion of the jammed wall over the displacement in a run that is judged


def judged(run, share=JAMMED_MOTION):
    """Whether the wall hardly moves while the packing is jammed, from the maximum of f to where f has fallen
    to the weight: outward by elastic rebound or numerical drift, inward by drift or because the packing is
    still being compacted. Else the displacement mostly is this motion, and the excursion has no beginning.
    The motion of each period counts by its size: motions outward and inward do not cancel."""
    drift, moved = ([abs(v) for v in finite(run["periods"][key])] for key in ("drift", "dx_max"))
    return len(moved) > 0 and sum(drift) <= share * sum(moved)


def scaled_load(run):
    p = run["parameters"]
    return run["weight"] ** 2 / ((run["mass"] + run["wall_mass"]) * p["fmax"] * p["frequency"] ** 2)


def thrust_ratio(run):
    return (run["thrust"] or math.nan) / run["weight"]


def unjammed_time(run):
    """t_u: how long f is below the thrust of the grains on the outward-moving wall [s]."""
    p = run["parameters"]
    if not run["thrust"] or run["thrust"] <= 0 or run["thrust"] >= p["fmax"]:
        return math.nan
    return math.acos(1 - 2 * run["thrust"] / p["fmax"]) / (math.pi * p["frequency"])


def strain(run, first, last):
    """Strain per period (x_j - x_j') / L over the periods first <= n < last, counted from 0; nan if the
    run is shorter."""
    periods = run["periods"]
    if len(periods["x_j"]) < last:
        return math.nan
    return (periods["x_j"][first] - periods["x_j_after"][last - 1]) / (last - first) / run["length"]
