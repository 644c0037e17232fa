# SPDX-License-Identifier: MIT
"""What Python costs: a step of 1,000 polyhedra beside the same step in C++ (the program twin_speed), and the reading of a
million poses. Prints medians; run.sh --speed builds the program.

    speed.py folder-of-the-twins
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import moreau

STEP, STEPS, ROUNDS = 2e-4, 60, 5


def packing() -> moreau.Simulation:
    """1,000 polyhedra that fell into a box for 0.6 s."""
    s = moreau.Simulation("polyhedron", grain_size=0.02, friction=0.4, margin=0.05)
    s.add_box([0, 0, 0], [0.2, 0.2, 1])
    s.set_gravity([0, 0, -9.81])
    random = moreau.Random(1)
    radii = random.sizes({0.02: 0.5, 0.03: 0.5}, 1000) / 2
    x, q = random.deposition(3, radii, 0.2)
    s.add_grains([s.add_shape(random.shape("polyhedron").scaled(r)) for r in radii], x, q, density=2700)
    s.run(5e-4, 1200)
    return s


def milliseconds(snapshot: pathlib.Path) -> list[float]:
    """Of each step from the state of the snapshot, in Python."""
    s = moreau.Simulation("polyhedron", grain_size=0.02, friction=0.4)
    s.read_snapshot(snapshot)
    times = []
    for _ in range(STEPS):
        start = time.perf_counter()
        s.step(STEP)
        times.append(1e3 * (time.perf_counter() - start))
    return times


def steps(program: pathlib.Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        snapshot = pathlib.Path(folder) / "packing.snapshot"
        packing().write_snapshot(snapshot)
        ratios = []
        for _ in range(ROUNDS):
            run = [program, snapshot, "0.02", str(STEP), str(STEPS)]
            cpp = [float(line) for line in subprocess.run(run, check=True, capture_output=True, text=True).stdout.split()]
            ratios.append((statistics.median(milliseconds(snapshot)), statistics.median(cpp)))
    python, cpp = (statistics.median(column) for column in zip(*ratios))
    ratio = statistics.median(p / c for p, c in ratios)
    print(f"1,000 polyhedra, median of {STEPS} steps in {ROUNDS} turns: Python {python:.3f} ms, C++ {cpp:.3f} ms, "
          f"ratio {ratio:.4f} ({min(p / c for p, c in ratios):.4f} to {max(p / c for p, c in ratios):.4f})")
    free = moreau.Simulation("ball", grain_size=0.02, friction=0.4)
    free.step(1e-4)
    start = time.perf_counter()
    for _ in range(10000):
        free.step(1e-4)
    print(f"a step without bodies: {1e2 * (time.perf_counter() - start):.2f} us")


def poses() -> None:
    s = moreau.Simulation("ball", grain_size=0.02, friction=0.4)
    n = 100
    grid = 0.03 * np.stack(np.meshgrid(*[np.arange(n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    ball = s.add_shape(moreau.ball(0.01))
    start = time.perf_counter()
    s.add_grains(ball, grid, density=2700)
    added = time.perf_counter() - start
    views, reads = [], []
    for _ in range(20):
        start = time.perf_counter()
        x, q = s.positions, s.rotations
        views.append(1e3 * (time.perf_counter() - start))
        start = time.perf_counter()
        x.sum(), q.sum()
        reads.append(1e3 * (time.perf_counter() - start))
    start = time.perf_counter()
    copy = x.copy()
    print(f"a million balls: added in {added:.2f} s; positions and rotations read as views in {statistics.median(views):.4f} ms, "
          f"both summed in {statistics.median(reads):.2f} ms, positions copied in {1e3 * (time.perf_counter() - start):.2f} ms")
    assert np.array_equal(copy, grid)


if __name__ == "__main__":
    steps(pathlib.Path(sys.argv[1]) / "twin_speed")
    poses()
