# SPDX-License-Identifier: MIT
"""No array of Python looks into memory that is gone. run.sh --asan runs these tests under the address sanitizer, where
touch() reads every byte through a checked function."""
import ctypes
import gc
import threading

import numpy as np
import pytest

import moreau
from conftest import heap

NAMES = ("positions", "rotations", "velocities", "spins", "forces", "torques", "masses")


def touch(array: np.ndarray) -> int:
    """Reads the memory from the first to the last number of an array by memcpy, which the sanitizer checks."""
    if array.size == 0:
        return 0
    last = sum((n - 1) * stride for n, stride in zip(array.shape, array.strides)) + array.itemsize
    return sum(ctypes.string_at(array.ctypes.data, last))


GROW = {
    "add_grains": lambda s: s.add_grains(0, [[1.0] * s.dim], density=1000),
    "add_wall": lambda s: s.add_wall([1] + [0] * (s.dim - 1), [-1] * s.dim),
    "add_cylinder": lambda s: s.add_cylinder([0] * s.dim, [0, 0, 1] if s.dim == 3 else 1, 9.0),
    "add_mesh_wall": lambda s: s.add_mesh_wall(np.eye(s.dim), [list(range(s.dim))]),
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("grow", GROW)
def test_growth_is_refused_while_a_view_lives(name, grow, every):
    view = getattr(every, name)
    part = view[1:3]
    del view
    with pytest.raises(ValueError, match=f"Simulation.{grow}: views = 1 must be 0"):
        GROW[grow](every)
    touch(part)
    del part
    gc.collect()
    assert every.live_views == 0
    GROW[grow](every)
    touch(getattr(every, name))


def test_reading_a_snapshot_is_refused_while_a_view_lives(disks, tmp_path):
    disks.write_snapshot(tmp_path / "s")
    x = disks.positions
    with pytest.raises(ValueError, match="read_snapshot: views = 1"):
        disks.read_snapshot(tmp_path / "s")
    touch(x)
    del x
    disks.read_snapshot(tmp_path / "s")


def test_views_of_views_count(disks):
    x = disks.positions
    rows = x[2:]
    heights = rows.T[1]
    flat = np.asarray(heights)[::2]
    del x, rows, heights
    assert disks.live_views == 1
    with pytest.raises(ValueError):
        disks.add_wall([1, 0], [-1, 0])
    copy = flat.copy()
    del flat
    assert disks.live_views == 0
    disks.add_wall([1, 0], [-1, 0])
    touch(copy)


def test_a_view_outlives_its_simulation(every):
    arrays = [getattr(every, name) for name in NAMES]
    every.run(1e-3, 20)
    shape, law = every.shape, every.law
    inner = heap(shape, law, count=5)
    kept = [getattr(inner, name)[1:] for name in NAMES]
    before = [array.copy() for array in kept]
    del inner
    gc.collect()
    junk = [np.full(1000, np.nan) for _ in range(200)]  # takes memory that would be free
    for array, old in zip(kept, before):
        touch(array)
        assert np.array_equal(array, old)
    del junk
    for array in arrays:
        touch(array)


def test_removed_grains_leave_their_rows(disks):
    x, m = disks.positions, disks.masses
    disks.run(1e-3, 20)
    disks.remove_grains(disks.grains[3:])
    disks.run(1e-3, 20)
    touch(x), touch(m)
    assert np.count_nonzero(m) == 3


def test_all_other_arrays_own_their_memory(every):
    every.run(1e-3, 30)
    c = every.contacts()
    shape = every.shape_of(int(every.grains[0]))
    copies = [every.grains, every.walls, every.gravity, *every.cell, every.contact_impulse(0), shape.vertices, c.a, c.b,
              c.gap, c.point, c.frame, c.impulse, c.couple, c.contact_class, every.wrap([[0.0] * every.dim])]
    assert every.live_views == 0
    before = [copy.copy() for copy in copies]
    every.run(1e-3, 30)
    every.remove_grains(every.grains)
    every.step(1e-3)
    for copy, old in zip(copies, before):
        touch(copy)
        assert np.array_equal(copy, old)


@pytest.mark.parametrize("shape", sorted({shape for shape, law in moreau._moreau.instances() if law == "coulomb"}))
def test_an_empty_simulation_has_empty_arrays(shape):
    s = moreau.Simulation(shape, grain_size=1, friction=0)
    full = heap(shape, count=1)
    for name in NAMES:
        assert getattr(s, name).shape == (0, *getattr(full, name).shape[1:])
    assert len(s.contacts()) == 0 and s.coordination().neighbours == 0
    s.step(1e-3)
    s.add_wall([0] * (s.dim - 1) + [1], [0] * s.dim)


def test_other_threads_run_during_a_step_and_are_refused_the_simulation():
    s = heap("polyhedron" if ("polyhedron", "coulomb") in moreau._moreau.instances() else "disk", count=150)
    s.set_solver(tolerance=1e-12, max_sweeps=20000)
    x, refused, counted, done = s.positions, [], 0, threading.Event()

    def work():
        s.run(1e-3, 60)
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    while not done.is_set():
        counted += 1
        try:
            s.contacts()
        except ValueError as error:
            refused.append(str(error))
    worker.join()
    assert counted > 100 and refused
    assert refused[0].startswith("Simulation.contacts: simulation = (in a step of another thread)")
    touch(x)
