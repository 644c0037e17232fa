# SPDX-License-Identifier: MIT
"""scaling.py FOLDER: makes scaling.md and the data of the plot, scaling-SHAPE.dat, of scaling.csv."""
import collections
import csv
import sys


def main(folder):
    with open(folder + "/scaling.csv", encoding="utf8", newline="") as file:
        rows = list(csv.DictReader(file))
    series = collections.defaultdict(list)
    for row in rows:
        if row["order"] == "curve":
            series[row["shape"]].append(row)
    stages = [name for name in rows[0] if name.endswith(" [us]")]
    with open(folder + "/scaling.md", "w", encoding="utf8") as out:
        names = ["shape", "grains", "threads", *stages, "relative", "kB per grain", "relative",
                 "sweeps to 1e-3", "cores free"]
        out.write("| " + " | ".join(names) + " |\n" + "|---" * len(names) + "|\n")
        for shape, lines in series.items():
            first = lines[0]
            for row in lines:
                alone = next(r for r in lines
                             if r["grains"] == row["grains"] and r["threads"] == "1")
                base = first if row["threads"] == "1" else alone
                cells = [shape, row["grains"], row["threads"]]
                cells += [f"{float(row[stage]):.2f}" for stage in stages]
                cells.append(f"{float(row['total [us]']) / float(base['total [us]']):.2f}")
                size = float(row["bytes per grain"])
                cells += [f"{size / 1e3:.1f}", f"{size / float(first['bytes per grain']):.2f}"]
                cells += [row["sweeps to 1e-3"], row["cores free"]]
                out.write("| " + " | ".join(cells) + " |\n")
        out.write("\nTimes per grain and step. 'relative': of one thread to the smallest packing, "
                  "of more threads to one thread with as many grains.\n")
    for shape, lines in series.items():
        with open(f"{folder}/scaling-{shape}.dat", "w", encoding="utf8") as out:
            out.write("# grains, total [us] on 1, 2, .. threads, kB per grain\n")
            by_grains = collections.defaultdict(list)
            for row in lines:
                by_grains[int(row["grains"])].append(row)
            for grains, some in sorted(by_grains.items()):
                times = " ".join(row["total [us]"] for row in some)
                out.write(f"{grains} {times} {float(some[0]['bytes per grain']) / 1e3:.2f}\n")


main(sys.argv[1])
