# SPDX-License-Identifier: MIT
"""The law of compaction: strain of the n-th period as a power of the time t_u during which the driving
force is below the thrust of the grains, and of n.

    ln strain = ln a + p ln(t_u / 10 ms) - b ln n

The periods of a run are taken together in groups 1, 2, 3-4, 5-8, ... The errors are those of the
jackknife over the runs, because the groups of a run are not independent."""
import math

from runs import (ANY, CASE, COMPLIANT, SHAPES, judged, least_squares, line, select, strain,
                  unjammed_time)

UNIT = 0.01  # [s]
SET_ASIDE = 3  # the sample whose runs are predicted, not fitted


def groups(run):
    """(t_u, mean number of the period, strain per period, periods) of each group."""
    t_u = unjammed_time(run)
    if not math.isfinite(t_u):
        return []
    found, first, last = [], 0, 1
    while last <= min(len(run["periods"]["x_j"]), 64):
        found.append((t_u, math.sqrt((first + 1) * last), strain(run, first, last), last - first))
        first, last = last, max(2 * last, 2)
    return found


def loading_runs(runs, shape, method="contact-dynamics"):
    """All runs that jam and differ in the load, the box, the wall or the lid, without those whose
    displacement is mostly elastic."""
    wanted = {"frequency": ANY, "fmax": ANY, "gravity": ANY, "wall_mass_ratio": ANY,
              "box_ratio": ANY, "lid_force_weights": ANY, "size_reading": ANY, "size_scale": ANY}
    if method == "compliant":
        wanted = COMPLIANT | wanted
    found = [run for run in select(runs, shape, **wanted)
             if run["parameters"]["fmax"] >= CASE["fmax"] / 6 and run["parameters"]["duration"] <= 5
             and judged(run)]
    # A long run repeats the first second of a short one.
    keys = {}
    for run in found:
        p = run["parameters"]
        key = tuple(str(p[k]) for k in ("seed", "frequency", "fmax", "gravity", "wall_mass_ratio",
                                        "box_ratio", "lid_force_weights", "size_reading",
                                        "size_scale")) + ("from" in p,)
        if key not in keys or p["duration"] > keys[key]["parameters"]["duration"]:
            keys[key] = run
    return list(keys.values())


def points(runs):
    return [(math.log(t_u / UNIT), math.log(n), math.log(eps))
            for run in runs for t_u, n, eps, _ in groups(run) if eps > 0]


class Law:
    def __init__(self, runs):
        self.runs = [run for run in runs if groups(run)]
        by_run = [points([run]) for run in self.runs]
        everything = [p for part in by_run for p in part]
        self.count, self.run_count = len(everything), len(self.runs)
        self.fitted = len(everything) >= 8 and len({p[0] for p in everything}) > 2 and \
            len({p[1] for p in everything}) > 1
        if not self.fitted:
            self.a = self.p = self.b = self.scatter = self.share = self.share_error = math.nan
            self.errors = [math.nan] * 3
            return
        self.a, self.p, self.b = self.fit(everything)
        self.scatter = self.deviation(everything)
        n = len(by_run)
        parts = []
        for k in range(n):
            rest = [p for i, part in enumerate(by_run) if i != k for p in part]
            parts.append(self.fit(rest))
        means = [sum(part[j] for part in parts) / n for j in range(3)]
        self.errors = [math.sqrt((n - 1) / n * sum((part[j] - means[j]) ** 2 for part in parts))
                       for j in range(3)]
        self.share = math.exp(self.a)  # strain of the first period at t_u = 10 ms
        self.share_error = self.share * self.errors[0]

    @staticmethod
    def fit(data):
        a, p, minus_b = least_squares([(1, x, n) for x, n, _ in data], [y for _, _, y in data])
        return a, p, -minus_b

    def residuals(self, data):
        return [y - self.a - self.p * x + self.b * n for x, n, y in data]

    def deviation(self, data):
        r = self.residuals(data)
        return math.sqrt(sum(v * v for v in r) / max(len(r) - 3, 1))

    def strain(self, t_u, n):
        return math.exp(self.a + self.p * math.log(t_u / UNIT) - self.b * math.log(n))


class Prediction:
    """The sample SET_ASIDE, predicted by the fit of the others."""

    def __init__(self, runs):
        self.law = Law([r for r in runs if r["parameters"]["seed"] != SET_ASIDE])
        aside = [r for r in runs if r["parameters"]["seed"] == SET_ASIDE]
        data = points(aside)
        self.runs = len(aside)
        if not data or not self.law.fitted:
            self.bias = self.rms = math.nan
            return
        residuals = self.law.residuals(data)
        self.bias = sum(residuals) / len(residuals)
        self.rms = math.sqrt(sum(v * v for v in residuals) / len(residuals))


def local_power(runs, shape, law, shortest):
    """The fit of the strain, times n^b, over t_u above `shortest` [s]: a, power, its error, scatter."""
    data = [(x, y + law.b * n) for x, n, y in points(loading_runs(runs, shape))
            if x > math.log(shortest / UNIT)]
    return line([x for x, _ in data], [y for _, y in data]) if len(data) > 3 else (math.nan,) * 4


def laws(runs, method="contact-dynamics"):
    return {shape: Law(loading_runs(runs, shape, method)) for shape in SHAPES}


def predictions(runs, method="contact-dynamics"):
    return {shape: Prediction(loading_runs(runs, shape, method)) for shape in SHAPES}
