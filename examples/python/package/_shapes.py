# SPDX-License-Identifier: MIT
"""Shapes of grains, and random numbers."""
from __future__ import annotations

from typing import Any, Mapping

import numpy as np

from . import _arguments as check
from . import _moreau
from ._arguments import Floats
from ._moreau import Shape

KINDS = ("polyhedron", "polygon", "ball", "disk")
DIMENSIONS = {"polyhedron": 3, "polygon": 2, "ball": 3, "disk": 2}


def polyhedron(points: Any) -> Shape:
    """The convex hull of points, for shape="polyhedron".

    points: (n, 3) in any frame [m]; the origin of the shape is moved to its centre of mass.
    ValueError: fewer than 4 points, points in one plane, a point that is not finite.
    """
    return _moreau.shape("polyhedron", check.rows("moreau.polyhedron", "points", points, 3))


def polygon(points: Any) -> Shape:
    """The convex hull of points in the plane, for shape="polygon".

    points: (n, 2) in any frame [m]; the origin of the shape is moved to its centre of mass.
    ValueError: fewer than 3 points, points on one line, a point that is not finite.
    """
    return _moreau.shape("polygon", check.rows("moreau.polygon", "points", points, 2))


def ball(radius: float) -> Shape:
    """A ball, for shape="ball". radius: [m], > 0."""
    return _moreau.shape("ball", np.array([check.positive("moreau.ball", "radius", radius)]))


def disk(radius: float) -> Shape:
    """A disk, for shape="disk". radius: [m], > 0."""
    return _moreau.shape("disk", np.array([check.positive("moreau.disk", "radius", radius)]))


def regular(kind: str, size: float) -> Shape:
    """The simplest grain of a kind: a cube or a square with this length of an edge, a ball or a disk with this
    diameter [m], > 0.

    kind: "polyhedron", "polygon", "ball" or "disk".
    """
    kind = check.choice("moreau.regular", "kind", kind, KINDS)
    return _moreau.regular(kind, check.positive("moreau.regular", "size", size))


def rotation(vectors: Any) -> Floats:
    """Rotations in space about vectors, by their length [rad].

    vectors: (3,) or (n, 3) [rad]. Returns unit quaternions (x, y, z, w), (4,) or (n, 4).
    In the plane a rotation is an angle and needs no function.
    """
    one = np.ndim(vectors) == 1
    out = _moreau.rotations(check.rows("moreau.rotation", "vectors", vectors, 3))
    return out[0] if one else out


class Random:
    """A random number generator: std::mt19937_64 of C++. The same seed gives the same grains, in C++ too."""

    def __init__(self, seed: int) -> None:
        """seed: an integer >= 0."""
        self._random = _moreau.Random(check.integer("Random", "seed", seed))

    def shape(self, kind: str) -> Shape:
        """A random angular grain, similar to crushed rock, with the circumradius 1: a polyhedron of 8 to 37
        vertices or a polygon of 5 to 7. scaled(r) gives it the circumradius r [m]. Balls and disks have the
        radius 1.
        """
        return _moreau.ballast(check.choice("Random.shape", "kind", kind, KINDS), self._random)

    def sizes(self, shares: Mapping[float, float], count: int) -> Floats:
        """The sizes of grains of several classes, in random order.

        shares: size [m] -> share by number, e.g. {0.02: 0.5, 0.03: 0.5}.
        Returns (count,) [m]. Each class has its share of the grains, up to one grain.
        """
        self_ = "Random.sizes"
        if not isinstance(shares, Mapping) or not shares:
            check.refuse(self_, "shares", shares, "must be a dictionary from sizes to shares")
        keys = np.array([check.positive(self_, "size", size) for size in shares])
        values = np.array([check.number(self_, "share", share) for share in shares.values()])
        return _moreau.sample_sizes(keys, values, check.integer(self_, "count", count, 1), self._random)

    def deposition(self, dim: int, radii: Any, length: float) -> tuple[Floats, Floats]:
        """Places of grains that lie loosely above a floor and do not overlap: each comes down on those before.

        dim: 2 or 3. radii: (n,) circumradii [m]. length: of the floor along each horizontal axis, from 0 [m].
        Returns positions (n, dim) [m] and random rotations: (n, 4), in the plane (n,).
        ValueError: a radius that is not > 0 or more than half of the length.
        """
        self_ = "Random.deposition"
        if dim not in (2, 3):
            check.refuse(self_, "dim", dim, "must be 2 or 3")
        r = check.numbers(self_, "radii", radii, "an array of the shape (n,)")
        if r.ndim != 1:
            check.refuse(self_, "radii", radii, "must be an array of the shape (n,)")
        return _moreau.random_deposition(dim, r, check.positive(self_, "length", length), self._random)
