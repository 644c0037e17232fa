#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Validation with several compilers and instruction sets: one table of what differs between them.

    examples/validation/builds.py          # builds and runs what is not there yet, writes builds.md

Each build is configured in build/validation-COMPILER-CPU and runs all cases but the packings, which take
most of the time. A build whose table.csv exists is not run again; remove the folder to repeat it. The
instruction set x86-64-v4 has AVX-512: it is left out where the processor has none.
"""

import csv
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPILERS = {"g++": "g++", "clang++": "clang++"}
CPUS = ["x86-64", "x86-64-v3", "x86-64-v4"]
PACKINGS = {"close_packing", "stiff_springs", "janssen", "plane_shear"}


def run(*command):
    """Runs a command; its output goes to the log of this program."""
    print("+", *command, flush=True)
    return subprocess.run(command, cwd=ROOT, check=False).returncode


def has_avx512():
    return " avx512vl " in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf8") + " "


def results_of(compiler, cpu):
    """Path of the table of a build, after building and running it if need be."""
    folder = ROOT / "build" / f"validation-{compiler}-{cpu}"
    table = folder / "output" / "table.csv"
    if table.exists() and (folder / "complete").exists():
        return table
    flags = f"-march={cpu}"
    if compiler == "g++" and cpu == "x86-64-v4":  # GCC bug 105593, as in .cmake/development.cmake
        flags += " -Wno-maybe-uninitialized -Wno-uninitialized"
    if run("cmake", "-S", ".", "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
           f"-DCMAKE_CXX_COMPILER={COMPILERS[compiler]}", f"-DCMAKE_CXX_FLAGS={flags}",
           "-DMOREAU_BUILD_TESTS=OFF", "-DMOREAU_BUILD_BENCHES=OFF") != 0:
        sys.exit(f"builds.py: {folder.name} cannot be configured")
    if run("cmake", "--build", str(folder), "--parallel", "1", "--target", "validation_with_float") != 0:
        sys.exit(f"builds.py: {folder.name} does not build")
    program = next(folder.rglob("validation_with_float"))
    help_text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    names = help_text[help_text.index("{") + 1:help_text.index("}")].replace("\n", "").replace(" ", "")
    cases = [name for name in dict.fromkeys(names.split(",")) if name not in PACKINGS]
    run(str(program), "--output", str(table.parent), "--only", *cases)
    (folder / "complete").touch()
    return table


def over_tolerance(row):
    """Error over tolerance; a comparison whose tolerance is zero passes only without an error."""
    error, tolerance = float(row["error"]), float(row["tolerance"])
    return error / tolerance if tolerance > 0 else (0.0 if error == 0 else float("inf"))


def main():
    cpus = [cpu for cpu in CPUS if cpu != "x86-64-v4" or has_avx512()]
    builds = [(compiler, cpu) for compiler in COMPILERS for cpu in cpus]
    rows = {}  # comparison -> build -> row
    for build in builds:
        with open(results_of(*build), encoding="utf8") as file:
            for row in csv.DictReader(file):
                rows.setdefault((row["comparison"], row["space"]), {})[build] = row
    text = ["# Validation with several builds", "",
            "Written by `builds.py`. All cases but the packings; error over tolerance of each comparison "
            "(at most 1 passes) that does not pass in some build.", "",
            "| comparison | | " + " | ".join(f"{c}, {cpu}" for c, cpu in builds) + " |",
            "|---|---|" + "---|" * len(builds)]
    passed = {build: 0 for build in builds}
    for (name, space), of_build in rows.items():
        ratios = []
        for build in builds:
            row = of_build.get(build)
            ratios.append(None if row is None else over_tolerance(row))
            passed[build] += row is not None and row["pass"] == "1"
        if any(ratio is None or ratio > 1 for ratio in ratios):
            cells = ["–" if r is None else f"{r:.2g}" for r in ratios]
            text.append(f"| {name} | {space} | " + " | ".join(cells) + " |")
    text.append(f"| **passed of {len(rows)}** | | " + " | ".join(str(passed[b]) for b in builds) + " |")
    (ROOT / "examples" / "validation" / "builds.md").write_text("\n".join(text) + "\n", encoding="utf8")


if __name__ == "__main__":
    main()
