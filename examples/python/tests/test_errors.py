# SPDX-License-Identifier: MIT
"""Wrong uses: each ends in one line that names the function, the argument and its value, and changes nothing."""
import math
import re

import numpy as np
import pytest

import moreau
from conftest import heap

NAN = math.nan
MAKE = dict(shape="disk", grain_size=0.02, friction=0.4)


def new(**changes):
    return moreau.Simulation(**MAKE | changes)


# (what the message must contain: function, argument, value; the wrong use)
WRONG = [
    ("Simulation: shape = 'cube'", lambda s: new(shape="cube")),
    ("Simulation: shape = 3", lambda s: new(shape=3)),
    ("Simulation: law = 'hertz'", lambda s: new(law="hertz")),
    ("Simulation: grain_size = -1", lambda s: new(grain_size=-1)),
    ("Simulation: grain_size = '2 cm'", lambda s: new(grain_size="2 cm")),
    ("SignoriniCoulomb: friction = -0.1", lambda s: new(friction=-0.1)),
    ("SignoriniCoulomb: restitution = 2", lambda s: new(restitution=2)),
    ("SignoriniCoulomb: static_friction = 0.1", lambda s: new(static_friction=0.1)),
    ("Simulation: rolling = 0.1", lambda s: new(rolling=0.1)),
    ("Simulation: rolling = None", lambda s: new(law="rolling")),
    ("Simulation: stiffness = None", lambda s: new(law="compliant")),
    ("Compliant: stiffness = -1", lambda s: new(law="compliant", stiffness=-1)),
    ("Simulation: materials = 0", lambda s: new(materials=0)),
    ("Simulation: margin = 0", lambda s: new(margin=0)),
    ("Simulation: tolerence = 1e-06", lambda s: new(tolerence=1e-6)),
    ("ColouredGaussSeidel: tolerance = 0", lambda s: s.set_solver(tolerance=0)),
    ("Simulation.set_solver: max_sweeps = 1.5", lambda s: s.set_solver(max_sweeps=1.5)),
    ("Simulation.set_solver: stop_test = 'qm'", lambda s: s.set_solver(stop_test="qm")),
    ("Simulation.set_threads: threads = 0", lambda s: s.set_threads(0)),
    ("Simulation.set_threads: threads = 'all'", lambda s: s.set_threads("all")),
    ("Simulation.add_shape: shape = <moreau ball", lambda s: s.add_shape(moreau.ball(0.01))),
    ("Simulation.add_shape: shape = 0.01", lambda s: s.add_shape(0.01)),
    ("Simulation.add_grains: shapes[0] = 99", lambda s: s.add_grains(99, [[0, 1]], density=1)),
    ("Simulation.add_grains: shapes = [0, 0]", lambda s: s.add_grains([0, 0], [[0, 1]], density=1)),
    ("Simulation.add_grains: shapes = [0.5]", lambda s: s.add_grains([0.5], [[0, 1]], density=1)),
    ("Simulation.add_grains: positions = [[0, 1, 2]]", lambda s: s.add_grains(0, [[0, 1, 2]], density=1)),
    ("Simulation.add_grains: positions = [[0, 1], [2]]", lambda s: s.add_grains(0, [[0, 1], [2]], density=1)),
    ("Simulation.add_grains: positions[0] = (0, nan)", lambda s: s.add_grains(0, [[0, NAN]], density=1)),
    ("Simulation.add_grains: positions = 'here'", lambda s: s.add_grains(0, "here", density=1)),
    ("Simulation.add_grains: rotations = [0, 0]", lambda s: s.add_grains(0, [[0, 1]], [0, 0], density=1)),
    ("Simulation.add_grains: density[0] = 0", lambda s: s.add_grains(0, [[0, 1]], density=0)),
    ("Simulation.add_grains: density = None", lambda s: s.add_grains(0, [[0, 1]], density=None)),
    ("Simulation.add_grains: material[0] = 1", lambda s: s.add_grains(0, [[0, 1]], density=1, material=1)),
    ("Simulation.add_wall: normal = (0, 2)", lambda s: s.add_wall([0, 2], [0, 0])),
    ("Simulation.add_wall: normal = [0, 0, 1]", lambda s: s.add_wall([0, 0, 1], [0, 0])),
    ("Simulation.add_wall: point = (inf, 0)", lambda s: s.add_wall([0, 1], [math.inf, 0])),
    ("Simulation.add_wall: material = 3", lambda s: s.add_wall([0, 1], [0, 0], 3)),
    ("Simulation.add_box: upper = [0, 0]", lambda s: s.add_box([0, 0], [0, 0])),
    ("Simulation.add_cylinder: radius = -1", lambda s: s.add_cylinder([0, 0], 1, -1)),
    ("Simulation.add_cylinder: axis = (0.5)", lambda s: s.add_cylinder([0, 0], 0.5, 1)),
    ("Simulation.add_mesh_wall: facets = [[0, 1, 2]]", lambda s: s.add_mesh_wall([[0, 0], [1, 0]], [[0, 1, 2]])),
    ("Simulation.add_mesh_wall: facets[0] = 7", lambda s: s.add_mesh_wall([[0, 0], [1, 0]], [[0, 7]])),
    ("Simulation.set_periodic: axis = 2", lambda s: s.set_periodic(2, 0, 1)),
    ("Simulation.set_periodic: upper = 0", lambda s: s.set_periodic(0, 1, 0)),
    ("Simulation.set_gravity: gravity = -9.81", lambda s: s.set_gravity(-9.81)),
    ("Simulation.set_gravity: gravity = (0, nan)", lambda s: s.set_gravity([0, NAN])),
    ("Simulation.set_velocity: body = 'first'", lambda s: s.set_velocity("first", [0, 0])),
    ("Simulation.set_velocity: body = 9999", lambda s: s.set_velocity(9999, [0, 0])),
    ("Simulation.set_velocity: body = -1", lambda s: s.set_velocity(-1, [0, 0])),
    ("Simulation.set_velocity: velocity = [0]", lambda s: s.set_velocity(4, [0])),
    ("Simulation.set_velocity: bodies[1] = 9999", lambda s: s.set_velocity([4, 9999], [0, 0])),
    ("Simulation.set_spin: spin = [0, 0, 1]", lambda s: s.set_spin(4, [0, 0, 1])),
    ("Simulation.set_force: force = (nan, 0)", lambda s: s.set_force(4, [NAN, 0])),
    ("Simulation.set_wall_mass: mass = 0", lambda s: s.set_wall_mass(0, 0)),
    ("Simulation.set_wall_mass: wall = 4", lambda s: s.set_wall_mass(4, 1)),
    ("Simulation.set_pose: position = [1]", lambda s: s.set_pose(4, [1])),
    ("Simulation.set_pose: rotation = [0, 0, 0, 1]", lambda s: s.set_pose(4, [0, 0], [0, 0, 0, 1])),
    ("Simulation.set_pose: rotation = 2 numbers", lambda s: s._world.set_pose(4, [0, 0], [0, 0])),
    ("Simulation.remove_grains: grain = 0", lambda s: s.remove_grains(0)),
    ("Simulation.remove_grains: grains = 'all'", lambda s: s.remove_grains("all")),
    ("Simulation.prescribe_motion: grain = 0", lambda s: s.prescribe_motion(0)),
    ("Simulation.drive_force: direction = [2, 0]", lambda s: s.drive_force(0, [2, 0], math.sin)),
    ("Simulation.drive_velocity: function = 0.1", lambda s: s.drive_velocity(0, [1, 0], 0.1)),
    ("Simulation.stop_drive: drive = None", lambda s: s.stop_drive(None)),
    ("Simulation.set_law: a = 1", lambda s: s.set_law(1, 0, friction=0)),
    ("Simulation.set_theta: theta = 'half'", lambda s: s.set_theta("half")),
    ("MoreauJean: theta = 2", lambda s: s.set_theta(2)),
    ("Simulation.set_overlap_correction: enabled = 1", lambda s: s.set_overlap_correction(enabled=1)),
    ("OverlapCorrection: rate = 2", lambda s: s.set_overlap_correction(rate=2)),
    ("Simulation.set_contact_points: points = 'two'", lambda s: s.set_contact_points("two")),
    ("Simulation.step: step = 0", lambda s: s.step(0)),
    ("Simulation.step: step = nan", lambda s: s.step(NAN)),
    ("Simulation.step: step = '1 ms'", lambda s: s.step("1 ms")),
    ("Simulation.run: count = 0", lambda s: s.run(1e-3, 0)),
    ("Simulation.run: count = 10.0", lambda s: s.run(1e-3, 10.0)),
    ("Simulation.check: report = None", lambda s: s.check(None)),
    ("solid_fraction: control_volume", lambda s: s.solid_fraction([1, 1], [0, 0])),
    ("Simulation.solid_fraction: lower = [0, 0, 0]", lambda s: s.solid_fraction([0, 0, 0], [1, 1])),
    ("Simulation.stress: step = 0", lambda s: s.stress(0, [0, 0], [1, 1])),
    ("Simulation.coordination: fewest = -1", lambda s: s.coordination(-1)),
    ("wall_pressure: wall = 4", lambda s: s.wall_pressure(4, 1e-3, 1)),
    ("Simulation.contact_impulse: body = 9999", lambda s: s.contact_impulse(9999)),
    ("Simulation.write_paraview: path = 3", lambda s: s.write_paraview(3, 1e-3)),
    ("Simulation.write_picture: colors = [[0, 0, 0]]", lambda s: s.write_picture("a.png", colors=[[0, 0, 0]])),
    ("Simulation.write_picture: width = 0", lambda s: s.write_picture("a.png", width=0)),
    ("moreau.polygon: points = [[0, 0, 0]]", lambda s: moreau.polygon([[0, 0, 0]])),
    ("Polygon: ", lambda s: moreau.polygon([[0, 0], [1, 0], [2, 0]])),
    ("moreau.disk: radius = -1", lambda s: moreau.disk(-1)),
    ("moreau.regular: kind = 'sphere'", lambda s: moreau.regular("sphere", 1)),
    ("moreau.rotation: vectors = [1, 2]", lambda s: moreau.rotation([1, 2])),
    ("Random: seed = -1", lambda s: moreau.Random(-1)),
    ("Random.sizes: shares = [1, 2]", lambda s: moreau.Random(1).sizes([1, 2], 3)),
    ("Random.deposition: dim = 4", lambda s: moreau.Random(1).deposition(4, [1], 5)),
    ("random_deposition: radii[0] = 9", lambda s: moreau.Random(1).deposition(2, [9], 5)),
    ("HarmonicForce: fmin = 2", lambda s: moreau.HarmonicForce(2, 1, 5) and moreau.HarmonicForce("2", 1, 5)),
]
WRONG = [pair for pair in WRONG if not pair[0].startswith("HarmonicForce")] + [
    ("HarmonicForce: fmin = '2'", lambda s: moreau.HarmonicForce("2", 3, 5)),
    ("HarmonicForce: fmax = 1", lambda s: moreau.HarmonicForce(2, 1, 5)),
]


@pytest.mark.parametrize("message,use", WRONG, ids=[message for message, _ in WRONG])
def test_wrong_use(message, use, disks):
    state = disks.snapshot()
    with pytest.raises(ValueError) as caught:
        use(disks)
    text = str(caught.value)
    assert text.startswith(message), text
    assert "\n" not in text and len(text) < 250 and "::" not in text
    assert re.search(r" (must|is|cannot) ", text), text
    assert disks.snapshot() == state


def test_at_least_thirty():
    assert len(WRONG) >= 30


def test_python_refuses_wrong_arguments_in_one_line(disks):
    for use in (lambda: moreau.Simulation("disk"), lambda: disks.add_wall([0, 1]), lambda: disks.step(),
                lambda: disks.add_grains(0, [[0, 1]], density=1, colour="red"), lambda: disks.steps(1)):
        with pytest.raises((TypeError, AttributeError)) as caught:
            use()
        assert "\n" not in str(caught.value)


def test_a_deep_overlap_is_refused_and_names_the_bodies(disks):
    disks.add_grain(0, disks.positions[disks.grains[0]].copy(), density=2700)
    with pytest.raises(ValueError, match="Simulation.step"):
        disks.step(1e-3)
    assert disks.time == 0


def test_files_that_cannot_be_written_or_read(disks, tmp_path):
    with pytest.raises(OSError, match="nowhere"):
        disks.write_snapshot(tmp_path / "nowhere" / "a.snapshot")
    with pytest.raises(OSError, match="missing"):
        disks.read_snapshot(tmp_path / "missing")
    (tmp_path / "text").write_text("no snapshot")
    with pytest.raises(RuntimeError, match="text"):
        disks.read_snapshot(tmp_path / "text")
    heap("polygon").write_snapshot(tmp_path / "polygons")
    with pytest.raises(RuntimeError, match="Polygon"):
        disks.read_snapshot(tmp_path / "polygons")


def test_overlap_correction_is_refused_under_springs():
    soft = heap("disk", "compliant")
    with pytest.raises(ValueError) as caught:
        soft.set_overlap_correction(enabled=True)
    assert "\n" not in str(caught.value)
    soft.set_overlap_correction(slop=1e-3)


def test_an_error_in_a_drive_reaches_the_caller(disks):
    disks.drive_velocity(int(disks.walls[0]), [1, 0], lambda t: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        disks.step(1e-3)
    other = heap("disk")
    other.drive_velocity(int(other.walls[0]), [1, 0], lambda t: "fast")
    with pytest.raises(ValueError, match="drive_velocity: function"):
        other.step(1e-3)
    third = heap("disk")
    third.drive_force(int(third.walls[0]), [1, 0], np.sin)
    with pytest.raises(ValueError, match="ForceDrive.apply: body = 0 must have a mass"):
        third.step(1e-3)
