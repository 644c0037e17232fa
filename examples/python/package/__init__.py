# SPDX-License-Identifier: MIT
"""Contact dynamics of rigid grains, in space and in the plane.

    import moreau

    simulation = moreau.Simulation("polyhedron", grain_size=0.02, friction=0.4)

Units are SI. In the plane, masses, forces and energies are per length if densities are. Vectors are in world
axes; the last axis is the vertical. D is the dimension, 2 or 3. Rotations are unit quaternions (x, y, z, w), as
in SciPy; in the plane they are angles [rad], positive from x to y. Angular velocities and torques have 3
components; in the plane they are numbers.

A wrong argument raises a ValueError that names the function, the argument and its value, and changes nothing. A file
that cannot be written or read raises an OSError; a body whose velocity is no longer finite raises a RuntimeError.
"""
from ._moreau import (  # noqa: F401
    Coordination, SolveReport, StepReport, __version__, has_pictures)
from ._shapes import (  # noqa: F401
    Random, Shape, ball, disk, polygon, polyhedron, regular, rotation)
from ._simulation import Contacts, Drive, HarmonicForce, KineticEnergy, Simulation  # noqa: F401

__all__ = [
    "Contacts", "Coordination", "Drive", "HarmonicForce", "KineticEnergy", "Random", "Shape", "Simulation",
    "SolveReport", "StepReport", "ball", "disk", "has_pictures", "polygon", "polyhedron", "regular", "rotation",
]
