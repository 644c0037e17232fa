# SPDX-License-Identifier: MIT
"""Fills a box with 300 random polyhedra of three sizes, lets them fall until they are at rest, and measures the
packing: examples/packing/packing.cpp, with the same bits. Writes packing.snapshot and packing.png.

    packing.py [digits that are printed]
"""
import sys

import numpy as np

import moreau

WIDTH, DENSITY, GRAVITY, STEP = 0.15, 2700, 9.81, 5e-4  # m, kg/m^3, m/s^2, s


def fill(shape: str, count: int) -> moreau.Simulation:
    """An open box with grains above its floor."""
    # In one step a falling grain moves by up to 1.5 mm, so the margin is 0.08 of the grain size.
    simulation = moreau.Simulation(shape, grain_size=0.02, friction=0.4, margin=0.08)
    axes, zero = np.eye(simulation.dim), np.zeros(simulation.dim)
    for axis in axes:
        simulation.add_wall(axis, zero)
    for axis in axes[:-1]:
        simulation.add_wall(-axis, WIDTH * axis)
    simulation.set_gravity(-GRAVITY * axes[-1])

    random = moreau.Random(1)
    radii = random.sizes({0.02: 0.5, 0.03: 0.3, 0.04: 0.2}, count) / 2
    shapes = [simulation.add_shape(random.shape(shape).scaled(radius)) for radius in radii]
    positions, rotations = random.deposition(simulation.dim, radii, WIDTH)
    simulation.add_grains(shapes, positions, rotations, density=DENSITY)
    return simulation


def add(numbers) -> float:
    """The sum from the first to the last number, as a loop in C++ adds; numpy.sum() adds in pairs."""
    total = 0.0
    for number in numbers:
        total += number
    return total


def main(digits: int = 6) -> int:
    simulation = fill("polyhedron", 300)
    weight = add(simulation.masses) * GRAVITY

    def carried() -> float:
        """Force by which floor and walls carried the grains in the last step, upwards [N]."""
        return add(-simulation.contact_impulse(wall)[-1] for wall in simulation.walls) / STEP

    # The packing is at rest if 100 steps in a row were calm.
    calm = step = 0
    while calm < 100 and simulation.time < 5:
        step += 1
        report = simulation.step(STEP)
        energy = simulation.kinetic_energy().total
        is_calm = (report.solve.converged and energy <= 1e-5 * weight * simulation.grain_size
                   and abs(carried() - weight) <= 0.01 * weight)
        calm = calm + 1 if is_calm else 0
        if step % 200 == 0:
            print(f"t = {simulation.time:.{digits}g} s: kinetic energy {energy:.{digits}g} J, "
                  f"carried {carried() / weight:.{digits}g} of the weight")
    print(f"{'at rest' if calm >= 100 else 'not at rest'} at t = {simulation.time:.{digits}g} s; largest overlap "
          f"{report.max_overlap / simulation.grain_size:.{digits}g} of the smallest grain")
    # Inside the packing, below its surface.
    fraction = simulation.solid_fraction([0.03, 0.03, 0.03], [WIDTH - 0.03, WIDTH - 0.03, 0.09])
    print(f"solid fraction {fraction:.{digits}g}, "
          f"mean number of neighbours {simulation.coordination(2).neighbours:.{digits}g}")
    simulation.write_snapshot("packing.snapshot")
    if moreau.has_pictures:
        simulation.write_picture("packing.png")
    return 0 if calm >= 100 else 1


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:2])))
