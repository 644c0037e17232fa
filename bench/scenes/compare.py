# SPDX-License-Identifier: MIT
"""compare.py FOLDER [RUNS [SCENE..]]: bench_scenes beside the physics engines of bench/peers/engines, in turn.

FOLDER is that of the benches in a build: it has scenes/bench_scenes and what there is of peers/bench_box3d,
peers/bench_jolt and peers/bench_box2d. Prints a table with the median CPU times of RUNS (default 3) runs on one
thread, and the overlaps of the poses of the last run, which bench_scenes measures for all programs."""
import os
import re
import statistics
import subprocess
import sys
import tempfile

ENGINES = {
    "convex_pile": ["box3d", "jolt"],
    "falling": ["box3d", "jolt"],
    "pyramid": ["box3d", "jolt"],
    "plane_pyramid": ["box2d"],
    "plane_falling": ["box2d"],
}
SETTINGS = [  # name in the table, options of bench_scenes
    ("default, 1e-4", ["tolerance=1e-4"]),
    ("1e-3, islands=no", ["tolerance=1e-3", "islands=no"]),
    ("1e-3, islands=no, float", ["tolerance=1e-3", "islands=no", "scalar=float"]),
    ("1e-2, islands=no, points=few", ["tolerance=1e-2", "islands=no", "points=few"]),
    ("games", ["setting=games"]),
    ("games, float", ["setting=games", "scalar=float"]),
]


def output_of(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def main(folder, runs=3, *scenes):
    """Prints the table."""
    ours = os.path.join(folder, "scenes", "bench_scenes")
    header = [cell.strip() for cell in output_of([ours]).splitlines()[0].split("|")]
    column = header.index("CPU time of a step, mean [ms]")
    step = 1 / 60
    print("| scene | program | ms per step | ms per second | overlapping pairs | "
          "overlap, mean | largest |\n" + "|---" * 7 + "|")
    for scene in scenes or ENGINES:
        engines = ENGINES[scene]
        with tempfile.TemporaryDirectory() as place:
            text = os.path.join(place, "scene")
            output_of([ours, scene, "write=" + text])
            programs = {}
            for engine in engines:
                path = os.path.join(folder, "peers", "bench_" + engine)
                if os.path.exists(path):
                    programs[engine] = [path, text]
            for name, setting in SETTINGS:
                programs[name] = [ours, scene, *setting]
            times = {name: [] for name in programs}
            for _ in range(int(runs)):
                for name, command in programs.items():
                    line = output_of([*command, "poses=" + os.path.join(place, name)])
                    if name in engines:
                        times[name].append(float(re.search(r"per step ([\d.]+)", line)[1]))
                    else:
                        times[name].append(float(line.split("|")[column]))
            for name, values in times.items():
                check = output_of([ours, scene, "check=" + os.path.join(place, name)])
                pairs, mean, largest = re.search(
                    r"pairs (\S+), mean overlap (\S+), largest (\S+),", check).groups()
                time = statistics.median(values)
                print(f"| {scene} | {name} | {time:.2f} ({min(values):.2f} to {max(values):.2f}) | "
                      f"{time / step:.0f} | {pairs} | {mean} | {largest} |", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
