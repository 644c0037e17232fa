# SPDX-License-Identifier: MIT
"""A small run of the ratcheting study, examples/ratcheting: grains in a box are compressed by a lid, then a wall of
the box oscillates under a harmonic force. Same bits as its class Experiment. Writes wall.csv.

    ratcheting.py [--shape polygon] [--grains 60] [--duration 0.2] [--fmax 300]
"""
import argparse
import csv
import math

import numpy as np

import moreau

DENSITY, STEP, MARGIN, FREQUENCY, LID_FORCE, LID_RAISE = 2700, 2e-4, 0.02, 5, 10, 0.01
SIZES = {0.025: 0.50, 0.0375: 0.34, 0.05: 0.16}  # m: share by number (Azema et al., arXiv 0711.1081)
PACKED = {2: 0.80, 3: 0.53}  # solid fraction after the compression
SOLVER = dict(tolerance=1e-4, stop_test="qm16", max_sweeps=5000, islands=False)
GRAINS, HORIZONTAL, VERTICAL = 0, 1, 2  # materials
SOLID = {"polygon": "polyhedron", "disk": "ball"}


def make_grains(shape: str, count: int, random: moreau.Random) -> tuple[list, np.ndarray, float]:
    """Grains of 30 different shapes, their circumradii [m] and the sum of their volumes."""
    bases = [random.shape(shape) for _ in range(30)]
    radii = random.sizes(SIZES, count) / 2
    shapes = [bases[k % 30].scaled(radius) for k, radius in enumerate(radii)]
    volume = 0.0
    for one in shapes:
        volume += one.volume
    return shapes, radii, volume


class Experiment:
    """The box, the grains and the moving wall, whose outward normal is x."""

    def __init__(self, shape: str, count: int, seed: int = 1) -> None:
        random = moreau.Random(seed)
        self.simulation = simulation = moreau.Simulation(
            shape, grain_size=min(SIZES), friction=0.4, materials=3, margin=MARGIN, **SOLVER)
        simulation.set_law(GRAINS, VERTICAL, friction=0)
        simulation.set_contact_points("few")
        shapes, radii, volume = make_grains(shape, count, random)
        # A sample of the plane weighs what the same sample weighs in space.
        thickness = make_grains(SOLID[shape], count, moreau.Random(seed))[2] / volume if shape in SOLID else 1.0
        self.mass = DENSITY * thickness * volume
        dim = simulation.dim
        self.length = (volume / (PACKED[dim] * 1)) ** (1.0 / dim)
        positions, rotations = random.deposition(dim, radii, self.length)
        numbers = [simulation.add_shape(one) for one in shapes]
        simulation.add_grains(numbers, positions, rotations, density=DENSITY * thickness)
        top = float((positions[:, -1] + radii).max())
        self.axes = axes = np.eye(dim)
        for axis in range(dim - 1):
            simulation.add_wall(axes[axis], np.zeros(dim), VERTICAL)
            far = simulation.add_wall(-axes[axis], self.length * axes[axis], VERTICAL)
            if axis == 0:
                self.wall = far
        simulation.add_wall(axes[-1], np.zeros(dim), HORIZONTAL)
        self.lid = simulation.add_wall(-axes[-1], top * axes[-1], HORIZONTAL)

    def compress(self) -> None:
        """The lid moves down until the grains react with its force, then the force acts until they are at rest."""
        s, up = self.simulation, self.axes[-1]
        s.set_solver(**SOLVER | dict(max_sweeps=200))
        force = LID_FORCE * self.mass * 9.81
        s.set_velocity(self.lid, -(0.4 * MARGIN * s.grain_size / STEP) * up)
        reaction = 0.0
        while reaction < force:
            s.step(STEP)
            reaction += 0.05 * (s.contact_impulse(self.lid)[-1] / STEP - reaction)
        s.set_velocity(self.lid, 0 * up)
        s.set_wall_mass(self.lid, self.mass)
        s.set_force(self.lid, -force * up)
        still, begin, k = 1e-6 * force * s.grain_size * len(s.grains), s.time, 0
        while s.time - begin < 1:
            s.step(STEP)
            if k >= 20 and s.kinetic_energy().total <= still:
                break
            k += 1

    def release(self) -> None:
        """Raises and fixes the lid, switches on gravity, and gives the wall its mass."""
        s, up = self.simulation, self.axes[-1]
        s.set_solver(**SOLVER)
        s.set_wall_mass(self.lid, math.inf)
        s.set_velocity(self.lid, 0 * up)
        s.set_force(self.lid, 0 * up)
        position = s.positions[self.lid].copy()
        position[-1] += LID_RAISE
        s.set_pose(self.lid, position)
        s.set_gravity(-9.81 * up)
        s.set_wall_mass(self.wall, 0.5 * self.mass)
        self.start = s.time

    def vibrate(self, fmax: float, duration: float) -> list[tuple[float, ...]]:
        """Steps under the force. Returns time [s], force [N], displacement [m] and velocity [m/s] of the wall, and the
        force of the grains on it [N]."""
        s, rows = self.simulation, []
        force = moreau.HarmonicForce(0, fmax, FREQUENCY)
        for _ in range(round(duration / STEP)):
            s.set_force(self.wall, -force(s.time - self.start + STEP / 2) * self.axes[0])
            s.step(STEP)
            t = s.time - self.start
            rows.append((t, force(t - STEP / 2), float(s.positions[self.wall, 0]) - self.length,
                         float(s.velocities[self.wall, 0]), float(s.contact_impulse(self.wall)[0]) / STEP))
        return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shape", default="polygon")
    parser.add_argument("--grains", type=int, default=60)
    parser.add_argument("--duration", type=float, default=0.2, help="of the oscillation [s]")
    parser.add_argument("--fmax", type=float, default=300, help="[N]")
    options = parser.parse_args()
    experiment = Experiment(options.shape, options.grains)
    experiment.compress()
    experiment.release()
    rows = experiment.vibrate(options.fmax, options.duration)
    with open("wall.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t", "f", "x", "v", "f_g"])
        writer.writerows([repr(number) for number in row] for row in rows)
    x = np.array([row[2] for row in rows])
    print(f"{options.grains} grains, box {experiment.length:.4g} m long; the wall moved by {1e3 * x.min():.4g} to "
          f"{1e3 * x.max():.4g} mm; wall.csv has {len(rows)} steps")


if __name__ == "__main__":
    main()
