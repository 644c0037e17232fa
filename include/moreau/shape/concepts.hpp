// SPDX-License-Identifier: MIT
// Requirements on shapes. A shape is immutable geometry in its own (body) frame, with the centre of
// mass at the origin. It holds no pose: the simulation holds the pose of each body.
#pragma once

#include <concepts>

#include "moreau/core/aabb.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/shape/mass_properties.hpp"

namespace moreau {

/// The space a shape lives in.
template <class Shape>
using SpaceOf = typename Shape::Space;

/// A body with a mass and a bounding box.
///
/// - mass_properties(density): at a uniform density [kg/m^D]; the centre of a grain must be the
///   origin
/// - bounding_box(pose): a box around the whole shape at the pose, world axes [m]
template <class T>
concept Shape = requires(const T shape, typename T::Space::Scalar density, Pose<SpaceOf<T>> pose) {
  { shape.mass_properties(density) } -> std::same_as<MassProperties<SpaceOf<T>>>;
  { shape.bounding_box(pose) } -> std::same_as<Aabb<SpaceOf<T>>>;
};

/// A convex shape. support(direction) returns the farthest point in a direction (any length but
/// zero), in body coordinates [m]. A user's own shape needs no other function.
template <class T>
concept ConvexShape = Shape<T> && requires(const T shape, typename T::Space::Vector direction) {
  { shape.support(direction) } -> std::same_as<typename T::Space::Vector>;
};

/// A convex set with a support function and a bounding box. It may be flat and need not have a
/// mass. Rounded<Core> (rounded.hpp) is the set of points near a core.
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

// Optional members. A shape composed of other shapes has a member if all its parts have it.

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
