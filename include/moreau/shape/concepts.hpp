// SPDX-License-Identifier: MIT
// Concepts of shapes. A shape is immutable geometry in its own (body) frame, with the centre of
// mass at the origin. Its position is a Pose that is stored elsewhere.
#pragma once

#include <concepts>

#include "moreau/core/aabb.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/shape/mass_properties.hpp"

namespace moreau {

/// The space of a shape.
template <class Shape>
using SpaceOf = typename Shape::Space;

/// A shape: it has a mass and a bounding box.
///
/// - mass_properties(density): at a uniform density [kg/m^D]; the centre of mass of a grain must be
///   the origin
/// - bounding_box(pose): a box that contains the shape at the pose, world axes [m]
template <class T>
concept Shape = requires(const T shape, typename T::Space::Scalar density, Pose<SpaceOf<T>> pose) {
  { shape.mass_properties(density) } -> std::same_as<MassProperties<SpaceOf<T>>>;
  { shape.bounding_box(pose) } -> std::same_as<Aabb<SpaceOf<T>>>;
};

/// A convex shape. support(direction) returns the farthest point in a direction (any length but
/// zero), in body coordinates [m]. This is enough for a shape of your own.
template <class T>
concept ConvexShape = Shape<T> && requires(const T shape, typename T::Space::Vector direction) {
  { shape.support(direction) } -> std::same_as<typename T::Space::Vector>;
};

/// A convex set with a support function and a bounding box. Unlike a shape it may be flat and need
/// not have a mass. It can be the core of a rounded shape (rounded.hpp).
template <class T>
concept ConvexCore = requires(const T core, typename T::Space::Vector direction,
                              Pose<SpaceOf<T>> pose) {
  { core.support(direction) } -> std::same_as<typename T::Space::Vector>;
  { core.bounding_box(pose) } -> std::same_as<Aabb<SpaceOf<T>>>;
};

/// A convex shape with flat faces. vertices(): N x D, one row each; face_normals(): F x D, unit and
/// outward; face_offsets(): F, the distance of each face's plane from the origin, normal . x =
/// offset on it. Lengths in [m], all in body coordinates. In the plane the faces are the edges:
/// face i runs from vertex i to vertex i + 1.
template <class T>
concept Polytope = ConvexShape<T> && requires(const T shape) {
  shape.vertices();
  shape.face_normals();
  shape.face_offsets();
};

// Optional members of shapes. A shape that consists of other shapes has them if those shapes have
// them.

/// volume() [m^D].
template <class T>
concept HasVolume = requires(const T shape) {
  shape.volume();
};
/// circumradius(): the farthest point's distance from the origin [m].
template <class T>
concept HasCircumradius = requires(const T shape) {
  shape.circumradius();
};
/// inradius(): the distance of the surface's nearest point from the origin [m].
template <class T>
concept HasInradius = requires(const T shape) {
  shape.inradius();
};
/// scaled(factor): the same shape, all lengths times the factor [-], > 0.
template <class T>
concept Scalable = requires(const T shape, typename T::Space::Scalar factor) {
  { shape.scaled(factor) } -> std::same_as<T>;
};

}  // namespace moreau
