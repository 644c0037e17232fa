# SPDX-License-Identifier: MIT
"""The excursion of a wall that a constant thrust F pushes out against the driving force while it moves
the mass M = m_w + beta m:

    M dv/dt = F - f(t),  from the time when f falls below F to the time when v is 0 again.

For F << fmax: dx = 0.228 F^2 / (M fmax nu^2), the paper's equation 4 with
C = 0.228 (F / mg)^2 (m + m_w) / (m_w + beta m)."""
import math

from runs import ANY, select


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
    6 kN, m_w = m/2, 9.81 m/s²."""

    def __init__(self, runs, shape, **wanted):
        self.ratios = {"frequency": [], "fmax": [], "gravity": [], "wall_mass_ratio": []}
        self.thrusts, self.shares = [], []
        for base in select(runs, shape, frequency=5.0, **wanted):
            if not base["steady_thrust"] or base["parameters"]["duration"] > 1:
                continue
            thrust, share = base["steady_thrust"], base["carried_share"]
            self.thrusts.append(thrust)
            self.shares.append(share)
            seed = base["parameters"]["seed"]
            for name, ratios in self.ratios.items():
                ranges = {"frequency": 5.0} | {name: ANY}
                for run in select(runs, shape, seed=seed, **ranges, **wanted):
                    p = run["parameters"]
                    if run is base or p["fmax"] < 1000 or p["duration"] > 5 or \
                            p[name] == base["parameters"][name]:
                        continue
                    predicted = displacement(thrust * run["weight"],
                                             run["wall_mass"] + share * run["mass"], p["fmax"],
                                             p["frequency"])
                    ratios.append(run["dx_active"] / predicted)

    def all(self):
        return [ratio for ratios in self.ratios.values() for ratio in ratios]


def mean_and_scatter(ratios):
    """Geometric mean, standard deviation of the logarithm."""
    logs = [math.log(r) for r in ratios if r > 0 and math.isfinite(r)]
    if len(logs) < 2:
        return math.nan, math.nan
    mean = sum(logs) / len(logs)
    return math.exp(mean), math.sqrt(sum((v - mean) ** 2 for v in logs) / (len(logs) - 1))
