# SPDX-License-Identifier: MIT
"""table.py RESULTS.json FOLDER: makes a table (narrow_phase.md) and the data of the plot
(narrow_phase.dat) of the results of bench_narrow_phase. Times are in nanoseconds per query."""
import collections
import json
import sys

KINDS = {"": "cold", "coherent_cold": "coherent, cold", "coherent_cached": "cached",
         "from_memory": "cached, from memory"}


def main(results, folder):
    with open(results, encoding="utf8") as file:
        document = json.load(file)
    rows = collections.OrderedDict()
    for run in document["benchmarks"]:
        parts = run["name"].split("/")
        if len(parts) < 3:
            rows.setdefault((parts[0], parts[1], ""), {})["cold"] = run["cpu_time"]
            continue
        kind = KINDS[parts[3] if len(parts) > 3 else ""]
        rows.setdefault(tuple(parts[:3]), {})[kind] = run["cpu_time"]
    context = document["context"]
    with open(folder + "/narrow_phase.md", "w", encoding="utf8") as out:
        out.write(f"Time of a query [ns], one thread, {context['num_cpus']} cores at "
                  f"{context['mhz_per_cpu']} MHz, load {context['load_avg'][0]:.1f} at the start. "
                  f"{context['date'][:10]}.\n\n")
        out.write("| shape | query | situation | " + " | ".join(KINDS.values()) + " |\n")
        out.write("|---" * (3 + len(KINDS)) + "|\n")
        for (shape, query, situation), times in rows.items():
            cells = [f"{times[kind]:.0f}" if kind in times else "" for kind in KINDS.values()]
            out.write(f"| {shape} | {query} | {situation} | " + " | ".join(cells) + " |\n")
    with open(folder + "/narrow_phase.dat", "w", encoding="utf8") as out:
        out.write("# shape, cold, cached, cached from memory: collide, touching [ns]\n")
        for (shape, query, situation), times in rows.items():
            if (query, situation) != ("collide", "touching") or len(times) < len(KINDS):
                continue
            values = [times[kind] for kind in ("cold", "cached", "cached, from memory")]
            out.write(f'"{shape}" ' + " ".join(f"{value:.1f}" for value in values) + "\n")


main(*sys.argv[1:3])
