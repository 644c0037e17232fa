# SPDX-License-Identifier: MIT
"""The class Simulation."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Callable, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _arguments as check
from . import _moreau
from ._arguments import Floats, Ids
from ._moreau import Coordination, Shape, StepReport
from ._shapes import DIMENSIONS, KINDS

Path = Union[str, "os.PathLike[str]"]

# The parameters of each law, beside friction and restitution.
LAWS = {"coulomb": ("static_friction",), "rolling": ("rolling",),
        "compliant": ("static_friction", "stiffness", "tangential_stiffness")}
NEEDED = {"coulomb": (), "rolling": ("rolling",), "compliant": ("stiffness",)}
CLASSES = ("vertex_vertex", "vertex_edge", "vertex_face", "edge_edge", "edge_face", "face_face")
POSITION, ROTATION, VELOCITY, SPIN, FORCE, TORQUE, MASS = range(7)


@dataclass(frozen=True, repr=False)
class Contacts:
    """A copy of the contact points of the last step: n points, sorted by their bodies. D is the dimension."""

    a: Ids  #: (n,) first body
    b: Ids  #: (n,) second body
    gap: Floats  #: (n,) distance along the normal [m]; < 0 is an overlap
    point: Floats  #: (n, D) world axes [m]
    frame: Floats  #: (n, D, D); frame[i, :, 0] is the normal from a to b, the other columns are the tangents
    impulse: Floats  #: (n, D) on b, in the frame, normal first [N s]; impulse[:, 0] > 0 pushes
    couple: Floats  #: (n, 3), in the plane (n, 1): couple of rolling resistance on b, in the frame [N m s]
    contact_class: NDArray[np.uint8]  #: (n,) which features touch; CLASSES[k] is the name

    CLASSES = CLASSES

    def __len__(self) -> int:
        return len(self.gap)

    def __repr__(self) -> str:
        return f"<moreau.Contacts: {len(self)} points; arrays {', '.join(self.__dataclass_fields__)}>"

    @property
    def normal(self) -> Floats:
        """(n, D) unit normals from a to b, world axes."""
        return self.frame[:, :, 0]

    def force(self, step: float) -> Floats:
        """(n, D) mean forces on b in a last step of this length [s], world axes [N]."""
        h = check.positive("Contacts.force", "step", step)
        return np.einsum("nij,nj->ni", self.frame, self.impulse) / h


class KineticEnergy(NamedTuple):
    """Kinetic energy of all grains [J]."""

    translation: float
    rotation: float

    @property
    def total(self) -> float:
        """[J]"""
        return self.translation + self.rotation


class HarmonicForce:
    """f(t) = (fmax + fmin)/2 - (fmax - fmin)/2 sin(2 pi frequency (t - start)) [N], a function for drive_force()."""

    def __init__(self, fmin: float, fmax: float, frequency: float, start: float = 0) -> None:
        """fmin, fmax: [N], fmin <= fmax. frequency: >= 0 [Hz]. start: [s]."""
        given = dict(fmin=fmin, fmax=fmax, frequency=frequency, start=start)
        self._f = _moreau.HarmonicForce(*(check.number("HarmonicForce", k, x) for k, x in given.items()))

    def __call__(self, t: float) -> float:
        """The force at the time t [s]: [N]."""
        return self._f(t)


@dataclass(frozen=True)
class Drive:
    """A force or a velocity of a body as a function of time: what drive_force() and drive_velocity() return."""

    body: int
    direction: Floats
    function: Callable[[float], float]
    is_force: bool


class Simulation:
    """Grains and walls in contact. Bodies have ids, integers in the order in which they are added.

    positions, velocities, ... are views: arrays without a copy that show the present state after every step, with
    one row for each body, grains and walls. The row of a body is its id, as long as no grain was removed: then
    rows(ids) gives the rows. They are read-only. While such an array, or a part of it, is alive, adding bodies and
    read_snapshot() are refused, because the memory would move. An array keeps the memory of its simulation alive.
    All other arrays are copies: grains, walls, contacts(), and what NumPy computes, e.g. positions[simulation.grains].
    """

    def __init__(self, shape: str, law: str = "coulomb", *, grain_size: float, friction: float,
                 restitution: float = 0, static_friction: float | None = None, rolling: float | None = None,
                 stiffness: float | None = None, tangential_stiffness: float | None = None, materials: int = 1,
                 margin: float = 0.02, skin: float = 0.05, resolution: float = 1e-3, threads: int = 1,
                 **solver: Any) -> None:
        """
        shape: "polyhedron", "polygon", "ball" or "disk", the kind of all grains. It sets the dimension D.
        law: "coulomb" (Signorini's condition and Coulomb friction), "rolling" (the same with rolling resistance) or
            "compliant" (Coulomb friction with springs in the contacts).
        grain_size: diameter of the smallest grain [m], > 0. All tolerances are relative to it.
        friction, restitution: coefficients [-], >= 0 and in [0, 1].
        static_friction: >= friction [-]; as friction if it is None. Not under "rolling".
        rolling: coefficient of rolling resistance [-], >= 0. Only under "rolling", where it is needed.
        stiffness, tangential_stiffness: of a contact [N/m], > 0; the second as the first if it is None. Only under
            "compliant", which needs the first.
        materials: number of materials. All pairs have the law given here until set_law() changes it.
        margin: largest gap at which a contact is made, relative to grain_size, > 0. In one step two bodies must not
            approach by more.
        skin, resolution: see examples/guide/choosing.md, relative to grain_size.
        threads: that share a step; they change no bit.
        solver: the arguments of set_solver().
        """
        me = "Simulation"
        self._shape = check.choice(me, "shape", shape, KINDS)
        self._law = check.choice(me, "law", law, tuple(LAWS))
        self._dim = DIMENSIONS[shape]
        self._angular = 3 if self._dim == 3 else 1
        given = self._law_parameters(me, friction, restitution, static_friction=static_friction, rolling=rolling,
                                     stiffness=stiffness, tangential_stiffness=tangential_stiffness)
        tolerances = {"margin": margin, "skin": skin, "resolution": resolution}
        tolerances = {key: check.number(me, key, value) for key, value in tolerances.items()}
        self._materials = check.integer(me, "materials", materials, 1)
        self._world = _moreau.World(self._shape, self._law, check.positive(me, "grain_size", grain_size),
                                    self._materials, given, tolerances, self._solver_options(me, solver))
        self._drives: list[Drive] = []
        self.set_threads(threads)

    def __repr__(self) -> str:
        return f"<moreau.Simulation: {len(self.grains)} grains, shape {self._shape}, law {self._law}, t = {self.time} s>"

    # What it is.

    @property
    def shape(self) -> str:
        """The kind of all grains."""
        return self._shape

    @property
    def law(self) -> str:
        """The name of the law."""
        return self._law

    @property
    def dim(self) -> int:
        """D: 2 or 3."""
        return self._dim

    @property
    def grain_size(self) -> float:
        """The length that tolerances are relative to [m]."""
        return self._world.grain_size()

    @property
    def time(self) -> float:
        """Sum of the steps [s]."""
        return self._world.time()

    @property
    def materials(self) -> int:
        """The number of materials."""
        return self._materials

    # Bodies.

    def add_shape(self, shape: Shape) -> int:
        """Adds a shape that grains share, and returns its number. The shape is copied.

        shape: of the kind of the simulation, from moreau.polyhedron(), polygon(), ball(), disk(), regular() or
            Random.shape().
        """
        if not isinstance(shape, Shape) or shape.kind != self._shape:
            check.refuse("Simulation.add_shape", "shape", shape, f"must be a {self._shape}, e.g. moreau.{self._shape}(...)")
        return self._world.add_shape(shape)

    def add_grains(self, shapes: Any, positions: Any, rotations: Any = None, *, density: Any, material: Any = 0) -> Ids:
        """Adds n grains at rest and returns their ids, (n,).

        shapes: numbers from add_shape(), one for all grains or (n,).
        positions: of the centres of mass, (n, D) [m]; (D,) for one grain.
        rotations: from the axes of the shape to world axes: (n, 4) unit quaternions (x, y, z, w), in the plane (n,)
            angles [rad]; one row or number for all; None for no rotation.
        density: [kg/m^3], in the plane [kg/m^2], > 0, one for all grains or (n,).
        material: of the surface, below `materials`, one for all grains or (n,).
        A grain may not overlap another body by more than half of its width: the next step refuses it.
        ValueError: names the first faulty element; then no grain is added. While a view lives.
        """
        me = "Simulation.add_grains"
        x = check.rows(me, "positions", positions, self._dim)
        n = len(x)
        return self._world.add_grains(check.each_integer(me, "shapes", shapes, n), x, self._rotations(me, rotations, n),
                                      check.each(me, "density", density, n),
                                      check.each_integer(me, "material", material, n))

    def add_grain(self, shape: int, position: Any, rotation: Any = None, *, density: float, material: int = 0) -> int:
        """Adds one grain as add_grains() does, and returns its id."""
        me = "Simulation.add_grain"
        x = check.vector(me, "position", position, self._dim).reshape(1, self._dim)
        return int(self.add_grains(shape, x, rotation, density=density, material=material)[0])

    def remove_grains(self, grains: Any) -> None:
        """Removes grains with their contacts. Their ids are refused from now on; their rows stay, with the mass 0.

        grains: one id or ids (n,).
        """
        self._world.remove_grains(check.ids("Simulation.remove_grains", "grains", grains))

    def add_wall(self, normal: Any, point: Any, material: int = 0) -> int:
        """Adds a half-space that stands still, and returns its id.

        normal: unit vector out of the solid, towards the grains, (D,). point: any point of its plane, (D,) [m].
        """
        me = "Simulation.add_wall"
        return self._world.add_wall(check.vector(me, "normal", normal, self._dim),
                                    check.vector(me, "point", point, self._dim), self._material(me, material))

    def add_box(self, lower: Any, upper: Any, *, lid: bool = False, material: int = 0) -> Ids:
        """Adds the walls of a box around the space between two corners, open at the top unless lid is True.

        lower, upper: (D,) [m]. Returns the ids of the walls: lower and upper wall of each horizontal axis, the floor,
        the lid. Periodic axes get no walls.
        """
        me = "Simulation.add_box"
        low, high = check.vector(me, "lower", lower, self._dim), check.vector(me, "upper", upper, self._dim)
        if not np.all(np.isfinite(low) & np.isfinite(high) & (high > low)):
            check.refuse(me, "upper", upper, "must be finite and above lower")
        lid, walls = check.flag(me, "lid", lid), []
        material = self._material(me, material)
        for axis in range(self._dim):
            if self.cell[1][axis] > 0:
                continue
            normal = np.eye(self._dim)[axis]
            walls.append(self.add_wall(normal, low, material))
            if axis < self._dim - 1 or lid:
                walls.append(self.add_wall(-normal, high, material))
        return np.array(walls, dtype=np.int64)

    def add_cylinder(self, point: Any, axis: Any, radius: float, material: int = 0) -> int:
        """Adds the inside of an infinite cylinder (in the plane, of a circle) as a wall, and returns its id.

        point: of its axis, (D,) [m]. axis: unit vector (3,), in the plane 1 or -1. radius: [m], > 0.
        """
        me = "Simulation.add_cylinder"
        return self._world.add_cylinder(check.vector(me, "point", point, self._dim),
                                        check.vector(me, "axis", axis, self._angular),
                                        check.positive(me, "radius", radius), self._material(me, material))

    def add_mesh_wall(self, vertices: Any, facets: Any, *, both_sides: bool = False, material: int = 0) -> int:
        """Adds a wall of triangles, in the plane of segments, and returns its id.

        vertices: (n, D) [m], world axes. facets: (m, D) rows of the corners; grains are held on the side from which
        the corners of a triangle run counter-clockwise (in the plane: on the right of a segment), or on both sides.
        """
        me = "Simulation.add_mesh_wall"
        x = check.rows(me, "vertices", vertices, self._dim)
        corners = np.asarray(facets)
        if corners.ndim != 2 or corners.shape[1] != self._dim or corners.dtype.kind not in "iu":
            check.refuse(me, "facets", facets, f"must be integers of the shape (m, {self._dim})")
        return self._world.add_mesh_wall(x, np.ascontiguousarray(corners, dtype=np.int64),
                                         check.flag(me, "both_sides", both_sides), self._material(me, material))

    @property
    def grains(self) -> Ids:
        """The ids of all grains, ascending: (n,), a copy."""
        return self._world.grains()

    @property
    def walls(self) -> Ids:
        """The ids of all half-spaces, in the order in which they were added, a copy."""
        return self._world.walls()

    def rows(self, ids: Any) -> Ids:
        """The rows of bodies in positions, velocities, ..."""
        ids = np.asarray(ids)
        return ids & 0xFFFFFFFF

    def contains(self, body: int) -> bool:
        """Whether this is the id of a grain or wall that was not removed."""
        return self._world.contains(check.body("Simulation.contains", "body", body))

    def shape_of(self, grain: int) -> Shape:
        """The shape of a grain, in its own frame, a copy."""
        return self._world.shape(check.body("Simulation.shape_of", "grain", grain))

    # Views.

    @property
    def positions(self) -> Floats:
        """Centres of mass of all bodies, (bodies, D) [m]; of a wall, a point of its plane. A view. Not wrapped in a
        periodic cell: wrap() does."""
        return self._world.view(POSITION, False)

    @property
    def rotations(self) -> Floats:
        """Rotations from body to world axes: (bodies, 4) unit quaternions (x, y, z, w), in the plane (bodies,) angles
        [rad]. A view."""
        return self._world.view(ROTATION, self._dim == 2)

    @property
    def velocities(self) -> Floats:
        """Velocities of the centres of mass, (bodies, D), world axes [m/s]. A view."""
        return self._world.view(VELOCITY, False)

    @property
    def spins(self) -> Floats:
        """Angular velocities, (bodies, 3), in the plane (bodies,), world axes [rad/s]. A view."""
        return self._world.view(SPIN, self._dim == 2)

    @property
    def forces(self) -> Floats:
        """What set_force() set, (bodies, D), without gravity and contacts, world axes [N]. A view."""
        return self._world.view(FORCE, False)

    @property
    def torques(self) -> Floats:
        """What set_torque() set, (bodies, 3), in the plane (bodies,), world axes [N m]. A view."""
        return self._world.view(TORQUE, self._dim == 2)

    @property
    def masses(self) -> Floats:
        """Masses of the grains, (bodies,) [kg]; 0 for walls and removed grains. A view."""
        return self._world.view(MASS, True)

    @property
    def live_views(self) -> int:
        """How many views are alive. Unless it is 0, adding bodies is refused."""
        return self._world.views

    # Motion.

    def set_pose(self, body: int, position: Any, rotation: Any = None) -> None:
        """Moves a body; its velocity stays.

        position: (D,) [m]. rotation: (4,), in the plane an angle [rad]; None keeps it.
        """
        me = "Simulation.set_pose"
        x = check.vector(me, "position", position, self._dim)
        q = np.zeros(0) if rotation is None else check.vector(me, "rotation", rotation, 4 if self._dim == 3 else 1)
        self._world.set_pose(check.body(me, "body", body), x, q)

    def set_velocity(self, bodies: Any, velocity: Any) -> None:
        """Sets the velocity of the centre of a body, (D,), or of n bodies, (n, D) or (D,) for all, world axes [m/s].
        A body whose motion is prescribed, such as a wall, keeps it."""
        self._set("Simulation.set_velocity", VELOCITY, "velocity", bodies, velocity, self._dim)

    def set_spin(self, bodies: Any, spin: Any) -> None:
        """Sets the angular velocity of a body, (3,), in the plane a number, or of n bodies, one row each or one for
        all, world axes [rad/s]."""
        self._set("Simulation.set_spin", SPIN, "spin", bodies, spin, self._angular)

    def set_force(self, bodies: Any, force: Any) -> None:
        """Sets the external force on a body, (D,), or on n bodies, one row each or one for all, world axes [N]. It adds
        to gravity and acts until it is set again. It does not move a wall without set_wall_mass()."""
        self._set("Simulation.set_force", FORCE, "force", bodies, force, self._dim)

    def set_torque(self, bodies: Any, torque: Any) -> None:
        """Sets the external torque about the centre of mass, as set_force() does: (3,), in the plane a number,
        world axes [N m]."""
        self._set("Simulation.set_torque", TORQUE, "torque", bodies, torque, self._angular)

    def set_wall_mass(self, wall: int, mass: float) -> None:
        """Makes a wall move along its normal as a body of this mass [kg], > 0, under set_force() and its contacts.
        With float("inf") its motion is prescribed again. Gravity does not act on walls."""
        me = "Simulation.set_wall_mass"
        self._world.set_wall_mass(check.body(me, "wall", wall), check.number(me, "mass", mass))

    def prescribe_motion(self, grain: int) -> None:
        """Makes a grain an obstacle: neither forces nor contacts change its velocity."""
        self._world.prescribe_motion(check.body("Simulation.prescribe_motion", "grain", grain))

    def release(self, grain: int) -> None:
        """The inverse of prescribe_motion()."""
        self._world.release(check.body("Simulation.release", "grain", grain))

    def is_prescribed(self, body: int) -> bool:
        """Whether neither forces nor contacts change the velocity of a body, as of a wall without a mass."""
        return self._world.is_prescribed(check.body("Simulation.is_prescribed", "body", body))

    def drive_force(self, body: int, direction: Any, function: Callable[[float], float]) -> Drive:
        """Applies a force function(t) [N] to a body from the next step on, evaluated at the middle of each step.

        body: a grain, or a wall after set_wall_mass(). direction: unit vector (D,), world axes.
        Returns what stop_drive() takes. Snapshots do not contain drives.
        """
        return self._drive("Simulation.drive_force", body, direction, function, True)

    def drive_velocity(self, body: int, direction: Any, function: Callable[[float], float]) -> Drive:
        """Moves a wall, or a grain after prescribe_motion(), at a velocity function(t) [m/s] from the next step on,
        evaluated at the middle of each step. Arguments are those of drive_force()."""
        return self._drive("Simulation.drive_velocity", body, direction, function, False)

    def stop_drive(self, drive: Drive) -> None:
        """Ends a drive. The last force or velocity stays until it is set again."""
        if not any(drive is d for d in self._drives):
            check.refuse("Simulation.stop_drive", "drive", drive, "must be a drive of this simulation")
        self._drives = [d for d in self._drives if d is not drive]

    # Settings.

    def set_gravity(self, gravity: Any) -> None:
        """Sets the acceleration of gravity, (D,), world axes [m/s^2]; zero at first."""
        me = "Simulation.set_gravity"
        self._world.set_gravity(check.vector(me, "gravity", gravity, self._dim))

    @property
    def gravity(self) -> Floats:
        """(D,) [m/s^2], a copy."""
        return self._world.gravity()

    def set_periodic(self, axis: int, lower: float, upper: float) -> None:
        """Makes an axis periodic between two bounds [m]; -inf and inf open it again.

        axis: 0 for x, 1 for y, ... ValueError: a wall across the axis, a cell of less than two grains.
        """
        me = "Simulation.set_periodic"
        self._world.set_periodic(min(check.integer(me, "axis", axis), 99), check.number(me, "lower", lower),
                                 check.number(me, "upper", upper))

    @property
    def cell(self) -> tuple[Floats, Floats]:
        """Lower bounds and lengths of the periodic cell, (D,) each [m]; the length of an open axis is 0."""
        return self._world.cell()

    def wrap(self, points: Any) -> Floats:
        """The images of points in the periodic cell, (n, D) [m], a copy."""
        return self._world.wrap(check.rows("Simulation.wrap", "points", points, self._dim))

    def set_threads(self, threads: int) -> None:
        """Sets how many threads share a step. The results have the same bits for any number."""
        n = check.integer("Simulation.set_threads", "threads", threads, 1)
        if n > 1024:
            check.refuse("Simulation.set_threads", "threads", threads, "must be at most 1024")
        self._world.set_threads(n)

    def set_solver(self, **options: Any) -> None:
        """Sets the solver of the contact problem from the next step on. Options that are not given have these values:

        tolerance=1e-4: on the residual; stop_test="natural_map", or "qm16", the test of LMGC90;
        max_sweeps=2000: cap on the sweeps; cold_sweeps=0: of a second attempt from zero impulses;
        check_interval=20: sweeps between two tests; accelerate=True;
        islands=True: small structures are solved by a direct method until velocity_tolerance=1e-5.
        See examples/guide/choosing.md.
        """
        self._world.set_solver(self._solver_options("Simulation.set_solver", options))

    def set_theta(self, theta: float) -> None:
        """Sets the parameter of the Moreau-Jean scheme, in [0.5, 1]; 0.5 at first."""
        self._world.set_theta(check.number("Simulation.set_theta", "theta", theta))

    def set_overlap_correction(self, **options: Any) -> None:
        """Sets how overlaps are corrected from the next step on. Options that are not given have these values:

        enabled=True, refused under "compliant"; slop=2e-4: overlap that stays, relative to grain_size; rate=0.2: share
        of the rest that is corrected per step; sweeps=10; max_shift=0.02: per step, relative to grain_size;
        islands=True.
        """
        me = "Simulation.set_overlap_correction"
        known = {"enabled": "flag", "slop": "number", "rate": "number", "sweeps": "integer", "max_shift": "number",
                 "islands": "flag"}
        self._world.set_correction(self._options(me, known, {"enabled": self._world.rigid} | options))

    def set_contact_points(self, points: str) -> None:
        """Sets which points of a contact between faces are used: "all", or "few", at most D, as LMGC90 does."""
        me = "Simulation.set_contact_points"
        self._world.set_contact_points(check.choice(me, "points", points, ("all", "few")) == "few")

    def set_law(self, a: int, b: int, *, friction: float, restitution: float = 0, static_friction: float | None = None,
                rolling: float | None = None, stiffness: float | None = None,
                tangential_stiffness: float | None = None) -> None:
        """Sets the parameters of the law between two materials, from the next step on; see Simulation."""
        me = "Simulation.set_law"
        given = self._law_parameters(me, friction, restitution, static_friction=static_friction, rolling=rolling,
                                     stiffness=stiffness, tangential_stiffness=tangential_stiffness)
        self._world.set_law(self._material(me, a, "a"), self._material(me, b, "b"), given)

    def allow_overlaps(self, allow: bool = True) -> None:
        """Allows deep overlaps of bodies that are added or moved, or refuses them again."""
        self._world.allow_overlaps(check.flag("Simulation.allow_overlaps", "allow", allow))

    # Steps.

    def step(self, step: float) -> StepReport:
        """Advances the time by a step [s], > 0, and returns the report. Other threads of Python run meanwhile.

        ValueError: a deep overlap of a body that was added or moved since the last step; nothing has moved.
        RuntimeError: the velocity or position of a body is not finite.
        """
        h = check.positive("Simulation.step", "step", step)
        if self._drives:
            self._apply_drives(h)
        return self._world.step(h)

    def run(self, step: float, count: int, each: Callable[[StepReport], Any] | None = None) -> StepReport:
        """Makes `count` >= 1 steps and returns the report of the last one alone: what an earlier step reported is
        seen by `each`. Ctrl-C ends it after the present step.

        each: called with the report after every step; if it returns True, the run ends.
        """
        h, n = check.positive("Simulation.run", "step", step), check.integer("Simulation.run", "count", count, 1)
        if each is None and not self._drives:
            return self._world.run(h, n)
        for _ in range(n):
            report = self.step(h)
            if each is not None and each(report) is True:
                break
        return report

    # Measures.

    def contacts(self) -> Contacts:
        """The contact points of the last step, copied."""
        return Contacts(**self._world.contacts())

    def contact_impulse(self, body: int) -> Floats:
        """Sum of the impulses that a body received from its contacts in the last step, (D,), world axes [N s]."""
        return self._world.contact_impulse(check.body("Simulation.contact_impulse", "body", body))

    def coordination(self, fewest: int = 0) -> Coordination:
        """The coordination number: .neighbours is the mean number of bodies with which a grain has a contact that
        pushes, walls included. A grain of prescribed motion counts as a wall.

        fewest: grains with fewer neighbours are removed first, until none is left (.rattlers); 0 keeps all.
        """
        return self._world.coordination(check.integer("Simulation.coordination", "fewest", fewest))

    def solid_fraction(self, lower: Any, upper: Any) -> float:
        """The share of a control volume that grains fill [-], exact.

        lower, upper: its corners, (D,), world axes [m].
        """
        me = "Simulation.solid_fraction"
        return self._world.solid_fraction(check.vector(me, "lower", lower, self._dim),
                                          check.vector(me, "upper", upper, self._dim))

    def kinetic_energy(self) -> KineticEnergy:
        """Of all grains [J]: .translation, .rotation, .total."""
        return KineticEnergy(*self._world.kinetic_energy())

    def stress(self, step: float, lower: Any, upper: Any) -> Floats:
        """Love-Weber stress of the contacts in a control volume, (D, D), compression positive [Pa], in the plane [N/m].

        step: length of the last step [s]. lower, upper: corners of the volume, (D,), at least a grain diameter inside
        the walls [m].
        """
        me = "Simulation.stress"
        return self._world.stress(check.positive(me, "step", step), check.vector(me, "lower", lower, self._dim),
                                  check.vector(me, "upper", upper, self._dim))

    def wall_pressure(self, wall: int, step: float, area: float) -> float:
        """Pressure of the grains on a half-space in the last step [Pa], in the plane [N/m].

        step: its length [s]. area: of the wall [m^2], in the plane its length [m].
        """
        me = "Simulation.wall_pressure"
        return self._world.wall_pressure(check.body(me, "wall", wall), check.positive(me, "step", step),
                                         check.positive(me, "area", area))

    def check(self, report: StepReport) -> list[str]:
        """A sentence for each setting that looks wrong in this report, that of one step: too long a step, overlaps,
        other units, a solver that did not converge, a lost grain. Empty if there are none. The report of grains at rest
        does not show that the step was too long while they fell: check() then."""
        if not isinstance(report, StepReport):
            check.refuse("Simulation.check", "report", report, "must be what step() returned")
        return self._world.check(report)

    def outlines(self, corners: int = 32) -> list[Floats]:
        """In the plane: the outline of each grain, (k, 2) [m], in the order of grains, at its place in the periodic
        cell. For matplotlib.collections.PolyCollection. A disk has this number of corners."""
        me = "Simulation.outlines"
        if self._dim != 2:
            check.refuse(me, "dim", self._dim, "must be 2; in space write_picture() draws the grains")
        angle = np.linspace(0, 2 * np.pi, check.integer(me, "corners", corners, 3), endpoint=False)
        circle = np.column_stack([np.cos(angle), np.sin(angle)])
        grains = self.grains
        place, turned = self.wrap(self.positions[self.rows(grains)]), self.rotations[self.rows(grains)]
        outlines = []
        for k, grain in enumerate(grains):
            shape = self._world.shape(grain)
            points = circle * shape.circumradius if self._shape == "disk" else shape.vertices
            c, s = np.cos(turned[k]), np.sin(turned[k])
            outlines.append(place[k] + points @ np.array([[c, s], [-s, c]]))
        return outlines

    # Files.

    def write_snapshot(self, path: Path) -> None:
        """Writes the whole state into a file; a run that reads it continues with the same bits. OSError if it fails."""
        self._world.write_snapshot(check.path("Simulation.write_snapshot", "path", path))

    def read_snapshot(self, path: Path) -> None:
        """Replaces the state by that of a file, which a simulation of the same shape and law has written; drives and
        threads stay. ValueError: while a view lives. RuntimeError: not such a file; nothing is changed."""
        self._world.read_snapshot(check.path("Simulation.read_snapshot", "path", path))

    def snapshot(self) -> bytes:
        """The bytes that write_snapshot() writes: equal for two runs if and only if their states have the same bits."""
        return self._world.snapshot()

    def write_paraview(self, path: Path, step: float) -> None:
        """Writes grains, walls and contacts for ParaView: path.vtm, which names the other files.

        step: length of the last step [s], by which impulses are divided.
        """
        me = "Simulation.write_paraview"
        self._world.write_paraview(check.path(me, "path", path), check.positive(me, "step", step))

    def write_picture(self, path: Path, *, colors: Any = None, width: int = 1200, height: int = 1000,
                      azimuth: float = 32, elevation: float = 22, walls: bool = True) -> None:
        """Draws the grains into a PNG file: in space a scene with shadows, in the plane a drawing.

        colors: (n, 3) or (n, 4), red, green, blue in [0, 1] for each of grains, e.g. plt.cm.viridis(x); None for the
            colours of stone. width, height: [pixels]. azimuth, elevation: of the eye [degrees].
        """
        me = "Simulation.write_picture"
        if not _moreau.has_pictures:
            check.refuse(me, "path", path, "cannot be written: the module was built without libpng")
        rgb = np.zeros((0, 3))
        if colors is not None:
            rgb = check.numbers(me, "colors", colors, "an array of the shape (n, 3)")
            if rgb.ndim != 2 or rgb.shape[1] not in (3, 4) or len(rgb) != len(self.grains) or not np.all(np.isfinite(rgb)):
                check.refuse(me, "colors", colors, f"must be finite, of the shape ({len(self.grains)}, 3)")
            rgb = np.ascontiguousarray(rgb[:, :3])
        size = [check.integer(me, name, value, 1) for name, value in (("width", width), ("height", height))]
        if max(size) > 20000:
            check.refuse(me, "width, height", size, "must be at most 20000")
        self._world.write_picture(check.path(me, "path", path), *size, check.number(me, "azimuth", azimuth),
                                  check.number(me, "elevation", elevation), check.flag(me, "walls", walls), rgb)

    # Arguments.

    def _material(self, function: str, value: Any, name: str = "material") -> int:
        k = check.integer(function, name, value)
        if k >= self._materials:
            check.refuse(function, name, value, f"must be below the number of materials, {self._materials}")
        return k

    def _rotations(self, function: str, value: Any, count: int) -> Floats:
        if self._dim == 2:
            return check.each(function, "rotations", 0.0 if value is None else value, count)
        if value is None:
            value = [0, 0, 0, 1]
        if np.shape(value) == (4,):
            value = np.tile(check.vector(function, "rotations", value, 4), (count, 1))
        return check.rows(function, "rotations", value, 4, count)

    def _law_parameters(self, function: str, friction: Any, restitution: Any, **others: Any) -> dict[str, float]:
        given = {"friction": friction, "restitution": restitution}
        for name, value in others.items():
            if value is not None and name not in LAWS[self._law]:
                check.refuse(function, name, value, f"must be left out under the law {self._law!r}")
            if value is None and name in NEEDED[self._law]:
                check.refuse(function, name, value, f"must be given under the law {self._law!r}")
            if value is not None:
                given[name] = value
        return {name: check.number(function, name, value) for name, value in given.items()}

    @staticmethod
    def _options(function: str, known: dict[str, str], options: dict[str, Any]) -> dict[str, Any]:
        checked: dict[str, Any] = {}
        for name, value in options.items():
            kind = known.get(name)
            if kind is None:
                check.refuse(function, name, value, f"is not an option; there are {', '.join(known)}")
            if kind == "flag":
                checked[name] = check.flag(function, name, value)
            elif kind == "integer":
                checked[name] = check.integer(function, name, value)
                if checked[name] > 2**31 - 1:
                    check.refuse(function, name, value, "must be below 2^31")
            elif kind == "test":
                checked[name] = check.choice(function, name, value, ("natural_map", "qm16"))
            else:
                checked[name] = check.number(function, name, value)
        return checked

    @staticmethod
    def _solver_options(function: str, options: dict[str, Any]) -> dict[str, Any]:
        known = {"tolerance": "number", "stop_test": "test", "max_sweeps": "integer", "cold_sweeps": "integer",
                 "check_interval": "integer", "accelerate": "flag", "islands": "flag", "velocity_tolerance": "number"}
        return Simulation._options(function, known, options)

    def _set(self, function: str, quantity: int, name: str, bodies: Any, value: Any, size: int) -> None:
        if np.ndim(bodies) == 0:
            one = check.body(function, "body", bodies)
            self._world.set_vector(one, quantity, check.vector(function, name, value, size))
            return
        ids = check.ids(function, "bodies", bodies)
        array = check.numbers(function, name, value, "numbers")
        if size == 1 and array.ndim < 2:
            array = check.each(function, name, value, len(ids)).reshape(-1, 1)
        elif array.shape == (size,):
            array = np.tile(array, (len(ids), 1))
        array = check.rows(function, name, array, size, len(ids))
        for i, one in enumerate(ids):
            if not self._world.contains(int(one)):
                check.refuse(function, f"bodies[{i}]", int(one), "must be the id of a body")
        if not np.all(np.isfinite(array)):
            i = int(np.flatnonzero(~np.isfinite(array).all(axis=1))[0])
            check.refuse(function, f"{name}[{i}]", array[i], "must be finite")
        for one, row in zip(ids, array):
            self._world.set_vector(int(one), quantity, row)

    def _drive(self, function: str, body: Any, direction: Any, f: Any, is_force: bool) -> Drive:
        one = check.body(function, "body", body)
        if not self._world.contains(one):
            check.refuse(function, "body", body, "must be the id of a body")
        along = check.vector(function, "direction", direction, self._dim)
        if not abs(float(np.linalg.norm(along)) - 1) <= 1e-5:
            check.refuse(function, "direction", direction, "must be unit")
        if not callable(f):
            check.refuse(function, "function", f, "must be a function of the time")
        drive = Drive(one, along, f, is_force)
        self._drives.append(drive)
        return drive

    def _apply_drives(self, step: float) -> None:
        middle = self.time + step / 2
        for drive in self._drives:
            name = "Simulation.drive_force" if drive.is_force else "Simulation.drive_velocity"
            value = check.number(name, "function(t)", drive.function(middle))
            self._world.drive(drive.body, drive.direction, value, drive.is_force, step)
