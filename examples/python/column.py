# SPDX-License-Identifier: MIT
"""The collapse of a column in the plane and in space: examples/plane_and_space, with the same bits. Writes column.png:
the run-out over the aspect ratio, and the heaps of the last aspect ratio.

    column.py [--plane 120] [--space 480] [--aspects 0.5 1 2 4] [--shapes polygon polyhedron] [--digits 6]
"""
import argparse
import math

import numpy as np

import moreau

SIZE, DEPTH, GRAVITY, STEP, FRICTION, LONGEST = 0.01, 0.05, 9.81, 5e-4, 0.4, 1.5  # m, m, m/s^2, s, -, s


class Column:
    """Grains in a box of the length L0, filled up to the height of about aspect times L0."""

    def __init__(self, shape: str, count: int, aspect: float, seed: int) -> None:
        random = moreau.Random(seed)
        # A larger margin than the default, for grains that fall at 2 m/s.
        self.simulation = moreau.Simulation(shape, grain_size=SIZE, friction=FRICTION, margin=0.1)
        dim, self.steps, self.unsolved, self.duration = self.simulation.dim, 0, 0, 0.0
        radii = random.sizes({SIZE: 0.5, 1.5 * SIZE: 0.5}, count) / 2
        shapes = [random.shape(shape).scaled(radius) for radius in radii]
        volume = 0.0
        for one in shapes:
            volume += one.volume
        # Solid fractions of about 0.8 in the plane and 0.55 in space.
        section = volume / 0.8 if dim == 2 else volume / 0.55 / DEPTH
        self.length = math.sqrt(section / aspect)
        self._fill(shapes, radii, random)
        axes, zero = np.eye(dim), np.zeros(dim)
        self.simulation.add_wall(axes[-1], zero)
        self.simulation.add_wall(axes[0], zero)
        self.gate = self.simulation.add_wall(-axes[0], self.length * axes[0])
        if dim == 3:
            self.simulation.set_periodic(1, 0, DEPTH)
        self.simulation.set_gravity(-GRAVITY * axes[-1])

    def _fill(self, shapes: list, radii: np.ndarray, random: moreau.Random) -> None:
        """Adds the grains. Their floor is a square in space, so several depositions stand side by side."""
        dim = self.simulation.dim
        widest = self.length if dim == 2 else DEPTH
        towers = math.ceil(self.length / widest)
        width = min(widest, self.length / towers)
        for tower in range(towers):
            own = range(tower, len(radii), towers)
            positions, rotations = random.deposition(dim, radii[own], width)
            positions[:, 0] += self.length / towers * tower
            numbers = [self.simulation.add_shape(shapes[k]) for k in own]
            self.simulation.add_grains(numbers, positions, rotations, density=2500)

    def settle(self, longest: float) -> None:
        """Steps until the fastest grain moves by less than a hundredth of its size in 0.05 s, for `longest` s."""
        start, fastest, grains = self.simulation.time, 1.0, self.simulation.grains
        velocities = self.simulation.velocities  # a view: it shows the present state
        while self.simulation.time - start < longest and (fastest > 0.2 * SIZE or self.simulation.time - start < 0.2):
            report = self.simulation.step(STEP)
            self.steps += 1
            self.unsolved += not report.solve.converged
            v = velocities[grains]
            fastest = math.sqrt((v * v).sum(axis=1).max())
        self.duration = self.simulation.time - start

    def collapse(self) -> float:
        """Fills the box, takes the wall away and waits for rest. Returns the run-out (L - L0) / L0, where L is the
        length that contains 98 % of the grains."""
        self.settle(1.5)
        position = self.simulation.positions[self.gate].copy()
        position[0] += 1000
        self.simulation.set_pose(self.gate, position)
        self.settle(LONGEST)
        x = np.sort(self.simulation.positions[self.simulation.grains, 0])
        return float((x[int(0.98 * len(x))] - self.length) / self.length)


def draw(run_outs: dict, heaps: dict, aspect: float) -> None:
    """Draws the run-out of each shape over the aspect ratio, and one heap of each."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import PolyCollection

    figure = plt.figure(figsize=(10, 6.5), layout="constrained")
    rows = figure.subfigures(2, 1, height_ratios=[1.1, 1])
    axes = rows[0].subplots()
    for marker, (shape, values) in zip("os^D", run_outs.items()):
        axes.loglog(*zip(*values), marker=marker, label=f"{shape}, N = {len(heaps[shape].simulation.grains)}")
    axes.set(xlabel="aspect ratio H / L0", ylabel="run-out (L - L0) / L0", title="Collapse of a column, one sample each")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    panels = np.atleast_1d(rows[1].subplots(1, len(heaps)))
    for panel, (shape, column) in zip(panels, heaps.items()):
        panel.set_title(f"{shape}, a = {aspect:g}, at the end")
        simulation = column.simulation
        if simulation.dim == 2:
            panel.add_collection(PolyCollection(simulation.outlines(), facecolor="#d3c1a5", edgecolor="#4a4f57", linewidth=0.5))
            panel.axhline(0, color="#4a4f57")
            panel.autoscale()
            panel.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
        else:  # the side view of the balls around the grains, the far grains first
            grains = simulation.grains
            order = grains[np.argsort(-simulation.wrap(simulation.positions[grains])[:, 1])]
            for grain in order:
                x, y, z = simulation.wrap(simulation.positions[grain])[0]
                radius = simulation.shape_of(grain).circumradius
                panel.add_patch(plt.Circle((x, z), 0.8 * radius, facecolor=plt.cm.cividis(1 - y / DEPTH),
                                           edgecolor="#4a4f57", linewidth=0.4))
            panel.axhline(0, color="#4a4f57")
            panel.autoscale()
            panel.set(aspect="equal", xlabel="x [m]", ylabel="z [m]")
    figure.savefig("column.png", dpi=110)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--plane", type=int, default=120, help="grains in the plane")
    parser.add_argument("--space", type=int, default=480, help="grains in space")
    parser.add_argument("--aspects", type=float, nargs="+", default=[0.5, 1, 2, 4])
    parser.add_argument("--shapes", nargs="+", default=["polygon", "polyhedron"])
    parser.add_argument("--digits", type=int, default=6)
    options = parser.parse_args()
    run_outs, heaps = {}, {}
    for shape in options.shapes:
        count = options.plane if shape in ("polygon", "disk") else options.space
        for aspect in options.aspects:
            column = Column(shape, count, aspect, seed=1)
            run_out = column.collapse()
            d = options.digits
            print(f"{shape} {aspect:g}: {run_out:.{d}g} {column.duration:.{d}g} {column.length:.{d}g} {column.steps} "
                  f"{column.unsolved}", flush=True)
            run_outs.setdefault(shape, []).append((aspect, run_out))
            heaps[shape] = column
    draw(run_outs, heaps, options.aspects[-1])


if __name__ == "__main__":
    main()
