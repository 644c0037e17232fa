# SPDX-License-Identifier: MIT
"""stiffness.py FOLDER: tables of the runs of stiffness.sh.

The jammed wall moves outward while the force falls. Its displacement since the start of the fall is
compared at equal force, at five forces between 0.9 and 0.2 of the largest one, in the first period:
  tolerance  with a tenth of the tolerance
  step       with half the time step
  stiffness  with 3 k and 10 k, each less the elastic line of its own: the same fall at 1 Hz
All in percent of the first opening displacement at k. The last columns are means of four periods.

The second table has the opening displacement of four periods, net of the elastic line at the force that
equals the weight of the grains: mean and standard error over the samples."""
import csv
import json
import math
import pathlib
import sys

SHARES = (0.9, 0.7, 0.5, 0.3, 0.2)
HOLD = 0.05  # time at the largest force before it falls [s]


class Run:
    """One run, from the files that the program ratcheting writes."""

    def __init__(self, folder, frequency):
        with open(folder / "wall.csv", encoding="utf8") as file:
            rows = [tuple(map(float, row[:3])) for row in list(csv.reader(file))[1:]]
        with open(folder / "run.json", encoding="utf8") as file:
            document = json.load(file)
        self.compaction = document["results"].get("compaction_per_period")
        self.capped = document["solver"]["capped_steps"]
        self.openings = [period["dx_max"] for period in document["periods"]]
        with open(folder / "solver.csv", encoding="utf8") as file:
            table = list(csv.reader(file))
        column = table[0].index("sweeps")
        self.sweeps = sum(float(row[column]) for row in table[1:]) / (len(table) - 1)
        self.weight = document["sample"]["mass"] * document["parameters"]["gravity"]
        step = document["parameters"]["step"]
        start = rows[0][0] - step + HOLD
        fall = [(f, x) for t, f, x in rows if start - 1e-9 <= t <= start + 0.5 / frequency]
        largest, first = fall[0]
        self.line = [self.at(fall, share * largest) - first for share in SHARES]
        self.to_weight = self.at(fall, self.weight) - first

    @staticmethod
    def at(fall, force):
        for (f0, x0), (f1, x1) in zip(fall, fall[1:]):
            if f0 >= force >= f1 and f0 > f1:
                return x0 + (x1 - x0) * (f0 - force) / (f0 - f1)
        raise ValueError(f"no force {force}")


def mean_and_error(values):
    """Mean ± standard error."""
    mean = sum(values) / len(values)
    if len(values) == 1:
        return f"{mean:.3f} (1)"
    variance = sum((v - mean) ** 2 for v in values) / (len(values) - 1)
    return f"{mean:.3f} ± {math.sqrt(variance / len(values)):.3f} ({len(values)})"


def print_openings(root, run):
    """Net opening displacements over the samples."""
    found = {}
    for start in sorted(root.glob("*-start-soft")):
        sample = start.name.removesuffix("-start-soft")
        for frequency in (5, 20):
            for name in ("k", "3k", "10k"):
                moved = run(f"{sample}-{frequency}-{name}", frequency)
                elastic = run(f"{sample}-static-{name}", 1)
                if moved and elastic:
                    net = sum(moved.openings) / len(moved.openings) - elastic.to_weight
                    key = (sample.split("-")[0], frequency)
                    found.setdefault(key, {}).setdefault(name, []).append(1e3 * net)
    print("\n| shape | Hz | k [mm] | 3 k [mm] | 10 k [mm] |\n|---|---|---|---|---|")
    for (shape, frequency), by_name in found.items():
        cells = [mean_and_error(by_name[name]) if name in by_name else "–"
                 for name in ("k", "3k", "10k")]
        print(f"| {shape} | {frequency} | " + " | ".join(cells) + " |")


def difference(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def main(folder):
    root = pathlib.Path(folder)

    def run(name, frequency):
        path = root / name
        return Run(path, frequency) if (path / "done").exists() else None

    print("| sample | Hz | opening [mm] | tolerance [%] | step [%] | 3 k [%] | 10 k [%] "
          "| opening k, 3 k, 10 k, rigid [mm] | compaction per period k, 3 k, 10 k, rigid [1e-4] "
          "| sweeps k, k tolerance/10, rigid | capped |")
    print("|---" * 11 + "|")
    for start in sorted(root.glob("*-start-soft")):
        sample = start.name.removesuffix("-start-soft")
        elastic = {name: run(f"{sample}-static-{name}", 1) for name in ("k", "3k", "10k")}
        for frequency in (5, 20):
            names = ("k", "k-tol10", "3k", "10k", "half-step", "rigid")
            runs = {name: run(f"{sample}-{frequency}-{name}", frequency) for name in names}
            k = runs["k"]
            if not k:
                continue
            opening = k.openings[0]

            def percent(a, b):
                return f"{100 * difference(a, b) / opening:.1f}"

            def net(name):
                return [x - y for x, y in zip(runs[name].line, elastic[name].line)]

            cells = [sample, str(frequency), f"{1e3 * opening:.3f}"]
            cells += [percent(k.line, runs[name].line) if runs[name] else ""
                      for name in ("k-tol10", "half-step")]
            cells += [percent(net("k"), net(name)) if runs[name] and elastic[name] else ""
                      for name in ("3k", "10k")]
            shown = [runs[name] for name in ("k", "3k", "10k", "rigid")]
            cells.append(", ".join(f"{1e3 * sum(r.openings) / len(r.openings):.2f}" if r else "–"
                                   for r in shown))
            cells.append(", ".join(f"{1e4 * r.compaction:.1f}" if r else "–"
                                   for r in shown))
            cells.append(", ".join(f"{runs[name].sweeps:.0f}" if runs[name] else "–"
                                   for name in ("k", "k-tol10", "rigid")))
            cells.append(", ".join(f"{name} {r.capped}" for name, r in runs.items()
                                   if r and r.capped) or "0")
            print("| " + " | ".join(cells) + " |")
    print_openings(root, run)


main(sys.argv[1])
