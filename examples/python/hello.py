# SPDX-License-Identifier: MIT
"""Ten grains fall on a floor and come to rest: examples/hello/hello.cpp, with the same bits.

    hello.py [shape] [digits that are printed]
"""
import sys

import moreau


def main(shape: str = "polyhedron", digits: int = 6) -> None:
    simulation = moreau.Simulation(shape, grain_size=0.02, friction=0.4)
    space = simulation.dim == 3
    grain = simulation.add_shape(moreau.regular(shape, 0.02))
    for k in range(10):
        x, up, turn = 0.003 * (k % 3), 0.03 + 0.03 * k, 0.2 * k
        position = [x, 0, up] if space else [x, up]
        rotation = moreau.rotation([turn, turn, turn]) if space else turn
        simulation.add_grain(grain, position, rotation, density=2700)  # kg/m^3
    simulation.add_wall([0, 0, 1] if space else [0, 1], [0] * simulation.dim)
    simulation.set_gravity([0, 0, -9.81] if space else [0, -9.81])

    for step in range(10000):
        report = simulation.step(1e-4)  # s
        if step % 250 != 249:
            continue
        print(f"{report.points} points, {report.solve.sweeps} sweeps, residual {report.solve.residual:.{digits}g}")
        for warning in simulation.check(report):
            print(warning, file=sys.stderr)


if __name__ == "__main__":
    main(*sys.argv[1:2], *map(int, sys.argv[2:3]))
