# SPDX-License-Identifier: MIT
"""The excursion of a wall that the thrust F of the grains pushes out against the driving force while it
moves the mass M = m_w + beta m:

    M dv/dt = F(x) - f(t),  from the time when f falls below F(0) to the time when v is 0 again.

For a constant F << fmax: dx = 0.228 F^2 / (M fmax nu^2), the paper's equation 4 with
C = 0.228 (F / mg)^2 (m + m_w) / (m_w + beta m)."""
import bisect
import math

from interval import number, student
from runs import ANY, COMPLIANT, exponent, judged, power, scaled_load, select


def displacement(thrust, mass, fmax, frequency, steps=2000):
    """Largest displacement [m] under the thrust [N], a function of the displacement; nan where f does not
    cross it or the wall does not return."""
    if not 0 < thrust(0) < fmax or mass <= 0:
        return math.nan
    omega = 2 * math.pi * frequency
    tau = -math.acos(1 - 2 * thrust(0) / fmax) / omega  # time since the minimum of f
    h = -4 * tau / steps
    v = x = 0.0
    for _ in range(4 * steps):
        middle = tau + h / 2
        a = (thrust(x) - fmax / 2 * (1 - math.cos(omega * middle))) / mass
        if v + a * h < 0:
            if middle > 0:
                return x
            a = -v / h  # before the minimum the wall waits
        x += h * (v + a * h / 2)
        v += a * h
        tau += h
    return math.nan


class ThrustCurve:
    """Force of the grains over their weight, over the displacement of a wall that moves slowly outward:
    the non-increasing function that fits the force best (least squares), from where the force has fallen
    to half of the weight. Constant beyond the end of the test."""

    def __init__(self, run):
        table, weight = run["tables"].get("wall", {"x": [], "f_g": []}), run["weight"]
        rows = list(zip(table["x"], table["f_g"]))
        start = next((k for k, (_, f_g) in enumerate(rows) if f_g < weight / 2), len(rows))
        blocks = []  # force, number of rows, first and last displacement
        for x, f_g in rows[start:]:
            x -= rows[start][0]
            blocks.append((f_g / weight, 1, x, x))
            while len(blocks) > 1 and blocks[-2][0] < blocks[-1][0]:
                (g, m, _, last), (f, n, first, _) = blocks.pop(), blocks.pop()
                blocks.append(((f * n + g * m) / (n + m), n + m, first, last))
        self.x = [(first + last) / 2 for _, _, first, last in blocks]
        self.f = [f for f, _, _, _ in blocks]

    def at(self, x):
        """Linear between the middles of the steps."""
        k = bisect.bisect(self.x, x)
        if k == 0 or k == len(self.x):
            return self.f[min(k, len(self.f) - 1)]
        share = (x - self.x[k - 1]) / (self.x[k] - self.x[k - 1])
        return self.f[k - 1] + share * (self.f[k] - self.f[k - 1])


def thrust_curves(runs, shape, box_ratio=1.0):
    """By sample."""
    curves = {r["parameters"]["seed"]: ThrustCurve(r) for r in static_runs(runs, shape, box_ratio)}
    return {seed: curve for seed, curve in curves.items() if curve.f}


def share_that_gives(excursion, run, thrust):
    """The share beta of the grains with which a run has this excursion [m]."""
    low, high = -0.99 * run["wall_mass"] / run["mass"], 20.0
    p = run["parameters"]
    for _ in range(25):
        share = (low + high) / 2
        moved = displacement(thrust, run["wall_mass"] + share * run["mass"], p["fmax"], p["frequency"], 500)
        if moved > excursion or math.isnan(moved):
            low = share
        else:
            high = share
    return (low + high) / 2


class Prediction:
    """Excursions over all loads, from one run of each sample: 5 Hz, 6 kN, m_w = m/2, 9.81 m/s².

    Without curves the thrust is the constant and beta the share that are fitted to the force on the wall
    in that run. With curves (ThrustCurve by sample) the thrust is that of the slow test, and beta the
    share with which that run has its excursion; samples without a curve are left out."""

    def __init__(self, runs, shape, curves=None, **wanted):
        self.pairs = {"frequency": [], "fmax": [], "gravity": [], "wall_mass_ratio": []}  # run, predicted
        self.bases, self.thrusts = [], []
        self.excluded = []  # run, predicted: the runs that are not judged
        self.shares = {}  # beta by sample
        self.set_aside, self.set_aside_ratios = [], []  # the judged runs that were set aside; their measured over predicted excursion
        for base in select(runs, shape, frequency=5.0, **wanted):
            if not base["steady_thrust"] or base["parameters"]["duration"] > 1:
                continue
            seed = base["parameters"]["seed"]
            if curves is None:
                thrust_at, share = (lambda _, f=base["steady_thrust"]: f), base["carried_share"]
                self.thrusts.append(base["steady_thrust"])
            elif seed in curves:
                thrust_at = curves[seed].at
                share = share_that_gives(base["dx_active"], base, lambda x: thrust_at(x) * base["weight"])
            else:
                continue
            self.bases.append(base)
            self.shares[seed] = share

            def predicted(run, thrust_at=thrust_at, share=share):
                weight, p = run["weight"], run["parameters"]
                return displacement(lambda x: thrust_at(x) * weight, run["wall_mass"] + share * run["mass"], p["fmax"],
                                    p["frequency"])
            aside = [run for run in select(runs, shape, seed=seed, frequency=ANY, fmax=ANY, **wanted) if run.get("set_aside") and judged(run)]
            self.set_aside += aside
            self.set_aside_ratios += [run["dx_active"] / predicted(run) for run in aside]
            for name, pairs in self.pairs.items():
                for run in select(runs, shape, seed=seed, **({"frequency": 5.0} | {name: ANY}), **wanted):
                    p = run["parameters"]
                    if p["fmax"] < 1000 or p["duration"] > 5 or p[name] == base["parameters"][name]:
                        continue
                    (pairs if judged(run) else self.excluded).append((run, predicted(run)))

    def exponents(self, name):
        """Exponents over a parameter of the measured and of the predicted excursion, as text."""
        predicted = {id(run): value for run, value in self.pairs[name]}
        predicted |= {id(run): run["dx_active"] for run in self.bases}
        found = [run for run in self.bases + [run for run, _ in self.pairs[name]]
                 if run["parameters"]["frequency"] > 1.5]
        return (exponent(found, name, lambda run: run["dx_active"]).text(),
                exponent(found, name, lambda run: predicted[id(run)]).text())

    def trend(self):
        """Power of the ratio measured / predicted over the measured excursion, and the scatter about it, as text."""
        points = [(run["dx_active"], run["dx_active"] / value) for pairs in self.pairs.values() for run, value in pairs]
        _, b, error, scatter = power(points)
        return f"{number(b, student(len(points) - 2) * error)}, {100 * scatter:.0f} %"

    def every_ratio(self):
        """Measured over predicted excursion, with the runs that are not judged."""
        return self.ratios() + [run["dx_active"] / predicted for run, predicted in self.excluded]

    def over_base(self, run):
        """Logarithms of the excursion and of the load of a run over those of the base run of its sample."""
        base = next(b for b in self.bases if b["parameters"]["seed"] == run["parameters"]["seed"])
        return math.log(run["dx_active"] / base["dx_active"]), math.log(scaled_load(run) / scaled_load(base))

    def null_ratios(self, fitted, *names):
        """The null model: measured excursion over that of the base run times the ratio of the loads, or a power of it. The
        power is fitted to the ratios of all parameters."""
        p = self.null_power() if fitted else 1
        return [math.exp(y - p * x) for name, pairs in self.pairs.items() if not names or name in names
                for run, _ in pairs for y, x in [self.over_base(run)]]

    def null_power(self):
        rows = [self.over_base(run) for pairs in self.pairs.values() for run, _ in pairs]
        return sum(y * x for y, x in rows) / sum(x * x for _, x in rows)

    def null_of_others(self):
        """The null model with a power that is fitted to the runs of the other samples."""
        rows = [(run["parameters"]["seed"], *self.over_base(run)) for pairs in self.pairs.values() for run, _ in pairs]
        found = []
        for seed in sorted({row[0] for row in rows}):
            others = [(y, x) for s, y, x in rows if s != seed]
            p = sum(y * x for y, x in others) / sum(x * x for _, x in others)
            found += [math.exp(y - p * x) for s, y, x in rows if s == seed]
        return found

    def set_aside_null(self):
        """The null model with the power, for the judged runs that were set aside."""
        p = self.null_power()
        return [math.exp(y - p * x) for y, x in map(self.over_base, self.set_aside)]

    def ratios(self, *names):
        """Measured over predicted excursion of the runs over these parameters, or over all."""
        return [run["dx_active"] / predicted
                for name in names or self.pairs for run, predicted in self.pairs[name]]


def static_thrust(run):
    """Mean force of the grains on a wall that moves slowly outward, over 1 mm from where it has fallen to
    half of their weight, over the weight."""
    table, weight = run["tables"].get("wall", {"x": [], "f_g": []}), run["weight"]
    rows = list(zip(table["x"], table["f_g"]))
    start = next((k for k, (_, f_g) in enumerate(rows) if f_g < weight / 2), None)
    if start is None:
        return math.nan
    forces = [f_g for x, f_g in rows[start:] if x - rows[start][0] <= 1e-3]
    return sum(forces) / len(forces) / weight


def static_runs(runs, shape, box_ratio=1.0):
    return select(runs, shape, frequency=5.0, wall_speed=2e-3, jammed=True, box_ratio=box_ratio, **COMPLIANT)


def constants_of_boxes(runs, shape, box_ratio, measured):
    """From the slow test in this box, at 5 Hz, 6 kN and m_w = m/2, by sample: C with the share beta of the
    sample in the box H/L = 1; the share with which C is as measured."""
    shares = Prediction(runs, shape, thrust_curves(runs, shape), jammed=True, **COMPLIANT).shares
    constants, own = [], []
    for run in static_runs(runs, shape, box_ratio):
        seed, p, curve = run["parameters"]["seed"], run["parameters"], ThrustCurve(run)
        if seed not in shares or not curve.f:
            continue

        def thrust(x, at=curve.at, weight=run["weight"]):
            return at(x) * weight
        moved = displacement(thrust, run["wall_mass"] + shares[seed] * run["mass"], p["fmax"],
                             p["frequency"])
        constants.append(moved / scaled_load(run))
        own.append(share_that_gives(measured * scaled_load(run), run, thrust))
    return constants, own


def mean_and_scatter(ratios):
    """Geometric mean, standard deviation of the logarithm."""
    logs = [math.log(r) for r in ratios if r > 0 and math.isfinite(r)]
    if len(logs) < 2:
        return math.nan, math.nan
    mean = sum(logs) / len(logs)
    return math.exp(mean), math.sqrt(sum((v - mean) ** 2 for v in logs) / (len(logs) - 1))
