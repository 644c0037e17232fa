# SPDX-License-Identifier: MIT
"""What every shape does under every law, and what the arrays hold."""
import numpy as np
import pytest

import moreau
from conftest import heap, rows_of


def test_grains_settle_and_are_measured(every):
    report = every.run(5e-4, 1000)
    dim, grains = every.dim, every.grains
    assert report.solve.converged and report.points > 0
    assert every.check(report) == []
    assert every.kinetic_energy().total < 0.01 * every.masses.sum() * 9.81 * every.grain_size
    assert np.all(every.positions[grains, -1] > 0) and np.all(every.positions[grains, 0] > 0)
    carried = sum(-every.contact_impulse(wall)[-1] for wall in every.walls) / 5e-4
    assert carried == pytest.approx(9.81 * every.masses.sum(), rel=0.05)
    assert every.coordination().neighbours >= 1
    assert 0 < every.solid_fraction([0] * dim, [0.1] * dim) < 1
    floor = every.walls[-1]
    assert every.wall_pressure(int(floor), 5e-4, 0.1 ** (dim - 1)) > 0
    stress = every.stress(5e-4, [-0.1] * dim, [0.2] * dim)
    assert stress.shape == (dim, dim) and stress[-1, -1] > 0


def test_contacts_balance_each_grain(every):
    """The forces on each grain and its weight change its momentum: signs, frames and ids are those of the docstring."""
    every.run(5e-4, 300)
    before = every.velocities.copy()
    every.step(5e-4)
    c, dim = every.contacts(), every.dim
    force = c.force(5e-4)
    total = np.zeros((len(every.positions), dim))
    np.add.at(total, every.rows(c.b), force)
    np.add.at(total, every.rows(c.a), -force)
    grains, masses = rows_of(every), every.masses
    expected = masses[grains, None] * ((every.velocities - before)[grains] / 5e-4 - every.gravity)
    assert np.allclose(total[grains], expected, atol=1e-6 * masses.max() * 9.81)
    assert np.allclose(np.einsum("nij,nik->njk", c.frame, c.frame), np.eye(dim))
    assert np.allclose(np.linalg.norm(c.normal, axis=1), 1)
    for wall in every.walls:
        assert np.allclose(total[wall] * 5e-4, every.contact_impulse(wall))
    radius = max(every.shape_of(g).circumradius for g in every.grains)
    both = np.isin(c.a, every.grains)
    assert np.all(np.linalg.norm(c.point - every.positions[every.rows(np.where(both, c.a, c.b))], axis=1) < 1.2 * radius)


def test_views_show_the_present_state_in_the_order_of_ids(every):
    x, v, q, w, m = every.positions, every.velocities, every.rotations, every.spins, every.masses
    every.set_velocity(every.grains, [0.5] + [0] * (every.dim - 1))
    assert np.all(v[every.grains, 0] == 0.5)
    before = x.copy()
    every.step(1e-4)
    assert not np.array_equal(x, before) and np.shares_memory(x, every.positions)
    assert len(x) == len(v) == len(q) == len(w) == len(m) == len(every.grains) + len(every.walls)
    assert np.all(m[every.walls] == 0) and np.all(m[every.grains] > 0)
    if every.dim == 3:
        assert np.allclose(np.linalg.norm(q, axis=1), 1)
    for array in (x, v, q, w, m):
        assert not array.flags.writeable and not array.flags.owndata
        with pytest.raises(ValueError):
            array[0] = 1


def test_rotations_are_those_of_the_arguments():
    space, plane = heap("polyhedron"), heap("polygon")
    q = moreau.rotation([0, 0, np.pi / 2])
    assert np.allclose(q, [0, 0, np.sqrt(0.5), np.sqrt(0.5)])  # x, y, z, w, as in SciPy
    grain = space.add_grain(0, [1, 1, 1], q, density=1000)
    assert np.array_equal(space.rotations[grain], q)
    assert moreau.rotation(np.zeros((5, 3))).shape == (5, 4)
    grain = plane.add_grain(0, [1, 1], 0.7, density=1000)
    assert plane.rotations[grain] == 0.7
    corner = plane.shape_of(grain).vertices[0]
    turned = [corner[0] * np.cos(0.7) - corner[1] * np.sin(0.7), corner[0] * np.sin(0.7) + corner[1] * np.cos(0.7)]
    assert np.allclose(plane.outlines()[-1][0], [1, 1] + np.array(turned))


def test_ids_of_removed_grains_are_refused(disks):
    first, second = disks.grains[:2]
    disks.remove_grains(first)
    assert not disks.contains(int(first)) and disks.contains(int(second))
    with pytest.raises(ValueError, match="Simulation"):
        disks.set_velocity(int(first), [0, 0])
    new = disks.add_grain(0, [0.05, 0.5], density=2700)
    assert new != first and disks.rows(new) == disks.rows(first) and disks.contains(new)
    assert disks.grains.tolist() == sorted(disks.grains.tolist(), key=lambda g: int(disks.rows(g)))
    disks.run(1e-4, 5)


def test_nothing_is_added_if_one_grain_is_faulty(disks):
    count, bytes_before = len(disks.positions), disks.snapshot()
    with pytest.raises(ValueError, match=r"positions\[1\]"):
        disks.add_grains(0, [[0.5, 0.5], [0.5, np.nan]], density=2700)
    assert len(disks.positions) == count and disks.snapshot() == bytes_before


def test_drives_move_a_wall_and_a_force_loads_it(disks):
    wall = int(disks.walls[1])
    drive = disks.drive_velocity(wall, [1, 0], lambda t: 0.2 if t < 0.01 else 0.0)
    x = disks.positions[wall, 0]
    disks.run(1e-3, 20)
    assert disks.positions[wall, 0] - x == pytest.approx(0.002)
    disks.stop_drive(drive)
    disks.set_wall_mass(wall, 1.0)
    f = moreau.HarmonicForce(0, 10, 5)
    assert f(0.15) == pytest.approx(10) and f(0.05) == pytest.approx(0)
    disks.drive_force(wall, [-1, 0], f)
    disks.step(1e-4)
    assert disks.forces[wall, 0] == pytest.approx(-f(disks.time - 5e-5))


def test_periodic_cell_cylinder_and_mesh():
    s = moreau.Simulation("ball", grain_size=0.02, friction=0.3)
    s.set_periodic(0, 0, 0.2)
    assert s.cell[1].tolist() == [0.2, 0, 0] and s.wrap([0.25, 0, 0])[0, 0] == pytest.approx(0.05)
    s.add_cylinder([0, 0, 0.1], [1, 0, 0], 0.1)
    grain = s.add_grain(s.add_shape(moreau.ball(0.01)), [0.1, 0, 0.02], density=2500)
    s.set_gravity([0, 0, -9.81])
    s.run(1e-3, 200)
    assert s.positions[grain, 2] == pytest.approx(0.01, abs=1e-4)
    m = moreau.Simulation("ball", grain_size=0.02, friction=0.3)
    m.add_mesh_wall([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
    grain = m.add_grain(m.add_shape(moreau.ball(0.01)), [0, 0, 0.02], density=2500)
    m.set_gravity([0, 0, -9.81])
    m.run(1e-3, 200)
    assert m.positions[grain, 2] == pytest.approx(0.01, abs=1e-4)


def test_restart_and_threads_change_no_bit(every, tmp_path):
    every.run(5e-4, 100)
    every.write_snapshot(tmp_path / "a.snapshot")
    again = moreau.Simulation(every.shape, every.law, grain_size=1, friction=0, threads=2,
                              **({"rolling": 0} if every.law == "rolling" else {}),
                              **({"stiffness": 1} if every.law == "compliant" else {}))
    again.read_snapshot(tmp_path / "a.snapshot")
    assert again.snapshot() == every.snapshot() == (tmp_path / "a.snapshot").read_bytes()
    every.run(5e-4, 100), again.run(5e-4, 100)
    assert again.snapshot() == every.snapshot()
    shape = again.shape_of(int(again.grains[0]))
    again.add_grain(again.add_shape(shape), [5] * again.dim, density=1000)  # shapes go on where they were


def test_files(every, tmp_path):
    every.run(5e-4, 50)
    every.write_paraview(tmp_path / "state", 5e-4)
    assert {p.name for p in tmp_path.iterdir()} == {"state.vtm", "state_grains.vtp", "state_walls.vtp", "state_contacts.vtp"}
    if moreau.has_pictures:
        colors = np.linspace(0, 1, 3 * len(every.grains)).reshape(-1, 3)
        every.write_picture(tmp_path / "a.png", width=200, height=160)
        every.write_picture(tmp_path / "b.png", width=200, height=160, colors=colors)
        a, b = ((tmp_path / name).read_bytes() for name in ("a.png", "b.png"))
        assert a[:8] == b[:8] == b"\x89PNG\r\n\x1a\n" and a != b


def test_shapes_and_random_numbers():
    cube = moreau.regular("polyhedron", 2)
    assert cube.volume == pytest.approx(8) and cube.vertices.shape == (8, 3) and len(cube.faces) == 6
    assert moreau.ball(1).volume == pytest.approx(4 * np.pi / 3) and moreau.disk(1).volume == pytest.approx(np.pi)
    assert moreau.polygon([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]]).vertices.shape == (4, 2)
    assert moreau.polygon([[0, 0], [1, 0], [0, 1]]).scaled(2).volume == pytest.approx(2)
    a, b = moreau.Random(7), moreau.Random(7)
    assert np.array_equal(a.shape("polyhedron").vertices, b.shape("polyhedron").vertices)
    sizes = a.sizes({1.0: 0.25, 2.0: 0.75}, 8)
    assert sorted(sizes) == [1, 1, 2, 2, 2, 2, 2, 2]
    x, q = a.deposition(3, sizes / 2, 4.0)
    gap = np.linalg.norm(x[:, None] - x[None], axis=2) - (sizes[:, None] + sizes[None]) / 2
    assert np.all(gap[~np.eye(8, dtype=bool)] > -1e-12) and np.allclose(np.linalg.norm(q, axis=1), 1)


def test_run_stops_when_asked(disks):
    reports = []
    disks.run(1e-4, 50, each=lambda report: reports.append(report) or len(reports) == 7)
    assert len(reports) == 7 and disks.time == pytest.approx(7e-4)


def test_reports_show_their_fields(disks):
    report = disks.run(1e-3, 20)
    assert repr(report).startswith("StepReport(solve=SolveReport(sweeps=")
    assert f"converged={report.solve.converged}" in repr(report)
    assert repr(disks.coordination()).startswith(f"Coordination(grains={disks.coordination().grains}, rattlers=")
    lines = str(report).splitlines()
    assert lines[0] == "solve:" and f"points = {report.points}" in lines
    contacts = disks.contacts()
    assert len(repr(contacts)) < 200 and f"{len(contacts)} points" in repr(contacts)
    assert all(thing.__doc__ for thing in (type(report), type(report.solve), type(disks.coordination())))
