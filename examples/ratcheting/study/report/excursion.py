# SPDX-License-Identifier: MIT
"""The excursion of a wall that a constant thrust F pushes out against the driving force while it moves
the mass M = m_w + beta m:

    M dv/dt = F - f(t),  from the time when f falls below F to the time when v is 0 again.

For F << fmax: dx = 0.228 F^2 / (M fmax nu^2), the paper's equation 4 with
C = 0.228 (F / mg)^2 (m + m_w) / (m_w + beta m)."""
import math

from runs import ANY, COMPLIANT, judged, select


def displacement(thrust, mass, fmax, frequency, steps=2000):
    """Largest displacement [m]."""
    if not 0 < thrust < fmax or mass <= 0:
        return math.nan
    omega = 2 * math.pi * frequency
    tau = -math.acos(1 - 2 * thrust / fmax) / omega  # time since the minimum of f
    h = -4 * tau / steps
    v = x = 0.0
    for _ in range(4 * steps):
        middle = tau + h / 2
        a = (thrust - fmax / 2 * (1 - math.cos(omega * middle))) / mass
        if v + a * h < 0:
            return x
        x += h * (v + a * h / 2)
        v += a * h
        tau += h
    return math.nan


class Prediction:
    """Excursions over all loads from the thrust and the carried mass of one run of each sample: 5 Hz,
    6 kN, m_w = m/2, 9.81 m/s².

    thrusts_of: thrust over weight of each sample from elsewhere, as from the static test; samples that
    it lacks are left out."""

    def __init__(self, runs, shape, thrusts_of=None, **wanted):
        self.ratios = {"frequency": [], "fmax": [], "gravity": [], "wall_mass_ratio": []}
        self.thrusts, self.shares = [], []
        for base in select(runs, shape, frequency=5.0, **wanted):
            if not base["steady_thrust"] or base["parameters"]["duration"] > 1:
                continue
            thrust, share = base["steady_thrust"], base["carried_share"]
            if thrusts_of is not None:
                thrust = thrusts_of.get(base["parameters"]["seed"], math.nan)
                if not math.isfinite(thrust):
                    continue
            self.thrusts.append(thrust)
            self.shares.append(share)
            seed = base["parameters"]["seed"]
            for name, ratios in self.ratios.items():
                ranges = {"frequency": 5.0} | {name: ANY}
                for run in select(runs, shape, seed=seed, **ranges, **wanted):
                    p = run["parameters"]
                    if run is base or p["fmax"] < 1000 or p["duration"] > 5 or \
                            p[name] == base["parameters"][name] or not judged(run):
                        continue
                    predicted = displacement(thrust * run["weight"],
                                             run["wall_mass"] + share * run["mass"], p["fmax"],
                                             p["frequency"])
                    ratios.append(run["dx_active"] / predicted)

    def all(self):
        return [ratio for ratios in self.ratios.values() for ratio in ratios]


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


def static_thrusts(runs, shape):
    """Thrust over weight by sample."""
    return {r["parameters"]["seed"]: static_thrust(r) for r in static_runs(runs, shape)}


def static_runs(runs, shape):
    return select(runs, shape, frequency=5.0, wall_speed=2e-3, jammed=True, **COMPLIANT)


def mean_and_scatter(ratios):
    """Geometric mean, standard deviation of the logarithm."""
    logs = [math.log(r) for r in ratios if r > 0 and math.isfinite(r)]
    if len(logs) < 2:
        return math.nan, math.nan
    mean = sum(logs) / len(logs)
    return math.exp(mean), math.sqrt(sum((v - mean) ** 2 for v in logs) / (len(logs) - 1))
