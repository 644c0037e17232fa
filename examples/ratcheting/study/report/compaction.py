# SPDX-License-Identifier: MIT
"""The law of compaction: strain of the n-th period as a product of powers of what a period does, and of n:

    ln strain = ln a + p ln(measure / unit) - b ln n

The measures are the time t_u during which the driving force is below the thrust of the grains, and the
excursion of the wall and the scaled load, both over the length of the box. The periods of a run are taken together in groups
1, 2, 3-4, 5-8, ... The intervals are those of the jackknife over the samples, because neither the groups of a
run nor the runs of a sample are independent; with fewer than three samples, over the runs."""
import math

from interval import student
from runs import (ANY, CASE, COMPLIANT, SHAPES, judged, least_squares, scaled_load, select,
                  strain, unjammed_time)

UNIT = 0.01  # [s]


def excursion_over_length(run):
    return run["dx_active"] / run["length"]


def load_over_length(run):
    """The scaled load (mg)^2 / [(m + m_w) fmax nu^2] over the length of the box."""
    return scaled_load(run) / run["length"]


def strain_over_load(run):
    """Mean strain of four periods over the root of the scaled load over the length of the box."""
    return strain(run, 0, 4) / math.sqrt(load_over_length(run))


def strain_both_have(run):
    """Mean strain of the three periods that the runs from the filling on and from a jammed state of one packing both have, because a jammed
    state is that at the end of the first period of a run from the filling on."""
    first = 0 if "from" in run["parameters"] else 1
    return strain(run, first, first + 3)


def is_short(run):
    """Whether the run has four periods or five, as all but those of the ageing have."""
    return len(run["periods"]["x_j"]) <= 5


def has_usual_force(run):
    """Whether the largest force per grain is that of the paper's case."""
    p = run["parameters"]
    return p["fmax"] / p["grains"] == CASE["fmax"] / CASE["grains"]


# Function of a run and unit.
MEASURES = {"t_u": (unjammed_time, UNIT), "excursion": (excursion_over_length, 1e-3),
            "load": (load_over_length, 1e-2), "nu": (lambda run: 1 / run["parameters"]["frequency"], 0.1),
            "force": (lambda run: 1 / run["parameters"]["fmax"], 1e-4), "gravity": (lambda run: run["parameters"]["gravity"], 1),
            "masses": (lambda run: run["mass"] + run["wall_mass"], 1)}


def groups(run, before=0):
    """(t_u, mean number of the period, strain per period, periods) of each group. `before`: periods of the packing before the run."""
    t_u = unjammed_time(run)
    if not math.isfinite(t_u):
        return []
    found, first, last = [], 0, 1
    while last <= min(len(run["periods"]["x_j"]), 64):
        found.append((t_u, math.sqrt((first + 1 + before) * (last + before)), strain(run, first, last), last - first))
        first, last = last, max(2 * last, 2)
    return found


def loading_runs(runs, shape, method="contact-dynamics", **more):
    """All runs that jam and differ in the load, the box, the wall or the lid, without those that are not
    judged."""
    wanted = {"frequency": ANY, "fmax": ANY, "gravity": ANY, "wall_mass_ratio": ANY,
              "box_ratio": ANY, "lid_force_weights": ANY, "size_reading": ANY, "size_scale": ANY}
    if method == "compliant":
        wanted = COMPLIANT | wanted
    wanted |= more
    found = [run for run in select(runs, shape, **wanted)
             if run["parameters"]["fmax"] / run["parameters"]["grains"] >= CASE["fmax"] / CASE["grains"] / 6 and run["parameters"]["duration"] <= 5
             and judged(run)]
    # A long run repeats the first second of a short one.
    keys = {}
    for run in found:
        p = run["parameters"]
        key = tuple(str(p[k]) for k in ("seed", "grains", "frequency", "fmax", "gravity", "wall_mass_ratio",
                                        "box_ratio", "lid_force_weights", "size_reading",
                                        "size_scale")) + ("from" in p,)
        if key not in keys or p["duration"] > keys[key]["parameters"]["duration"]:
            keys[key] = run
    return list(keys.values())


def jammed_runs(runs, shape, boxes=False, every_load=False):
    """The judged runs with compliant contacts that start from a jammed state: in boxes as high as long, or in
    all boxes; at scaled loads below the length of the box, where the law holds, or at every load."""
    usual = {} if boxes else {"box_ratio": 1.0, "size_scale": 1.0}
    return [run for run in loading_runs(runs, shape, "compliant", **usual)
            if "from" in run["parameters"] and (every_load or load_over_length(run) < 1)]


def points(runs, measures=("t_u",), before=0):
    """(ln of each measure, ln n, ln strain) of each group; `before`: see groups()."""
    found = []
    for run in runs:
        values = [MEASURES[m][0](run) / MEASURES[m][1] for m in measures]
        if all(v > 0 for v in values):
            found += [([math.log(v) for v in values], math.log(n), math.log(eps))
                      for _, n, eps, _ in groups(run, before) if eps > 0]
    return found


class Law:
    """Without `fitted`, too few points were given, and all numbers are nan. `before`: see groups()."""

    def __init__(self, runs, measures=("t_u",), before=0):
        self.measures = measures
        self.runs = [run for run in runs if groups(run)]
        by_run = [points([run], measures, before) for run in self.runs]
        everything = [p for part in by_run for p in part]
        self.count, self.run_count = len(everything), len(self.runs)
        self.fitted = len(everything) >= 8 and len({p[0][0] for p in everything}) > 2 and \
            len({p[1] for p in everything}) > 1
        if not self.fitted:
            self.a = self.b = self.b_half = self.scatter = self.share = self.share_half = math.nan
            self.powers = self.power_halves = [math.nan] * len(measures)
            return
        self.a, *self.powers, self.b = self.fit(everything)
        self.scatter = self.deviation(everything)
        labels = [run["parameters"]["seed"] for run in self.runs]
        if len(set(labels)) < 3:
            labels = list(range(len(by_run)))
        parts = [self.fit([p for label, part in zip(labels, by_run) if label != left_out for p in part])
                 for left_out in sorted(set(labels))]
        n = len(parts)
        means = [sum(part[j] for part in parts) / n for j in range(len(measures) + 2)]
        errors = [math.sqrt((n - 1) / n * sum((part[j] - means[j]) ** 2 for part in parts))
                  for j in range(len(measures) + 2)]
        halves = [student(n - 1) * error for error in errors]
        self.power_halves, self.b_half = halves[1:-1], halves[-1]
        self.share = math.exp(self.a)  # strain of the first period where each measure is its unit
        self.share_half = self.share * halves[0]

    @property
    def p(self):
        return self.powers[0]

    @property
    def p_half(self):
        return self.power_halves[0]

    @staticmethod
    def fit(data):
        a, *powers, minus_b = least_squares([(1, *xs, n) for xs, n, _ in data], [y for _, _, y in data])
        return [a, *powers, -minus_b]

    def residuals(self, data):
        return [y - self.a - sum(p * x for p, x in zip(self.powers, xs)) + self.b * n
                for xs, n, y in data]

    def deviation(self, data):
        r = self.residuals(data)
        return math.sqrt(sum(v * v for v in r) / max(len(r) - 2 - len(self.measures), 1))

    def strain(self, value, n):
        """Of the n-th period, from the first measure."""
        unit = MEASURES[self.measures[0]][1]
        return math.exp(self.a + self.p * math.log(value / unit) - self.b * math.log(n))


class Prediction:
    """Each sample, predicted by the fit of the others: rms of ln(measured / predicted), and by sample its mean."""

    def __init__(self, runs, measures=("t_u",)):
        self.bias, squares = {}, []
        for seed in sorted({r["parameters"]["seed"] for r in runs}):
            law = Law([r for r in runs if r["parameters"]["seed"] != seed], measures)
            data = points([r for r in runs if r["parameters"]["seed"] == seed], measures)
            if not data or not law.fitted:
                continue
            residuals = law.residuals(data)
            self.bias[seed] = sum(residuals) / len(residuals)
            squares += [v * v for v in residuals]
        self.rms = math.sqrt(sum(squares) / len(squares)) if squares else math.nan

    def text(self):
        """rms, and the means of the samples, in percent."""
        if not self.bias:
            return "–"
        return (f"{100 * self.rms:.0f} % ("
                + ", ".join(f"{100 * b:+.0f}" for b in self.bias.values()).replace("-", "−") + ")")


class SetAside:
    """The runs that were set aside (runs.read()), predicted by the fit of the others: their number and that of
    their points, rms and mean of ln(measured / predicted), and the fit, whose scatter is that of the others."""

    def __init__(self, runs, measures=("t_u",)):
        aside = [r for r in runs if r.get("set_aside")]
        self.law = Law([r for r in runs if not r.get("set_aside")], measures)
        data = points(aside, measures) if self.law.fitted else []
        self.run_count, self.count = len(aside), len(data)
        residuals = self.law.residuals(data)
        self.rms = math.sqrt(sum(v * v for v in residuals) / len(data)) if data else math.nan
        self.mean = sum(residuals) / len(data) if data else math.nan


def laws(runs, measures=("t_u",)):
    """Of the runs with rigid contacts, by shape."""
    return {shape: Law(loading_runs(runs, shape), measures) for shape in SHAPES}


def predictions(runs, measures=("t_u",)):
    return {shape: Prediction(loading_runs(runs, shape), measures) for shape in SHAPES}
