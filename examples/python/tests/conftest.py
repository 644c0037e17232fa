# SPDX-License-Identifier: MIT
"""Simulations that the tests share. The module is found by PYTHONPATH; TWINS is the folder of the C++ programs."""
import numpy as np
import pytest

import moreau

SHAPES = ("polyhedron", "polygon", "ball", "disk")
LAWS = ("coulomb", "rolling", "compliant")


def law_parameters(law: str) -> dict:
    return {"coulomb": {}, "rolling": {"rolling": 0.1}, "compliant": {"stiffness": 1e6}}[law]


def heap(shape: str = "disk", law: str = "coulomb", count: int = 12, seed: int = 1, **more) -> moreau.Simulation:
    """An open box with grains above its floor, walls first."""
    simulation = moreau.Simulation(shape, law, grain_size=0.02, friction=0.4, margin=0.1, **law_parameters(law), **more)
    dim = simulation.dim
    simulation.add_box([0] * dim, [0.1] * dim)
    simulation.set_gravity([0] * (dim - 1) + [-9.81])
    random = moreau.Random(seed)
    radii = random.sizes({0.02: 0.5, 0.03: 0.5}, count) / 2
    shapes = [simulation.add_shape(random.shape(shape).scaled(r)) for r in radii]
    positions, rotations = random.deposition(dim, radii, 0.1)
    simulation.add_grains(shapes, positions, rotations, density=2700)
    return simulation


@pytest.fixture
def disks() -> moreau.Simulation:
    return heap("disk")


@pytest.fixture(params=[(shape, law) for shape in SHAPES for law in LAWS if (shape, law) in
                        __import__("moreau._moreau", fromlist=["instances"]).instances()],
                ids=lambda pair: "-".join(pair))
def every(request) -> moreau.Simulation:
    return heap(*request.param)


def rows_of(simulation: moreau.Simulation) -> np.ndarray:
    return simulation.rows(simulation.grains)
