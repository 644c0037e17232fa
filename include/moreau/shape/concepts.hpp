// SPDX-License-Identifier: MIT
// Requirements on shapes. A shape is immutable geometry in its own (body) frame, with the centre of
// mass at the origin. It has no pose: the simulation stores the pose of each body. A team calls the
// functions of a shape from several threads at once: they must not change the shape.
#pragma once

#include <concepts>

#include "moreau/core/aabb.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/shape/mass_properties.hpp"

namespace moreau {

/// The space of a shape: plane or three-dimensional space, with a scalar type.
template <class Shape>
using SpaceOf = typename Shape::Space;

/// A shape with a mass and a bounding box. Its functions are:
///
/// - mass_properties(density): mass, centre of mass and inertia at a uniform density [kg/m^D]. For
///   a grain the centre of mass must be the origin
/// - bounding_box(pose): a box around the whole shape at the pose, world axes [m]
template <class T>
concept Shape = requires(const T shape, typename T::Space::Scalar density, Pose<SpaceOf<T>> pose) {
  { shape.mass_properties(density) } -> std::same_as<MassProperties<SpaceOf<T>>>;
  { shape.bounding_box(pose) } -> std::same_as<Aabb<SpaceOf<T>>>;
};

/// A convex shape. support(direction) returns the point of the shape farthest in a direction, in
/// body coordinates [m]; the direction has any length but zero. A shape defined by a user needs no
/// functions but these three.
template <class T>
concept ConvexShape = Shape<T> && requires(const T shape, typename T::Space::Vector direction) {
  { shape.support(direction) } -> std::same_as<typename T::Space::Vector>;
};

/// A convex set with a support function and a bounding box. It may have no thickness, and it needs
/// no mass. Rounded<Core> (rounded.hpp) is the set of all points close to such a core.
template <class T>
concept ConvexCore = requires(const T core, typename T::Space::Vector direction,
                              Pose<SpaceOf<T>> pose) {
  { core.support(direction) } -> std::same_as<typename T::Space::Vector>;
  { core.bounding_box(pose) } -> std::same_as<Aabb<SpaceOf<T>>>;
};

/// A convex shape with flat faces, in body coordinates. In the plane the faces are the edges: face
/// i runs from vertex i to vertex i + 1. Its functions are:
/// - vertices(): N x D matrix, one vertex per row [m]
/// - face_normals(): F x D matrix, one unit outward normal per row
/// - face_offsets(): F numbers, normal . x for the points x of each face [m]
template <class T>
concept Polytope = ConvexShape<T> && requires(const T shape) {
  shape.vertices();
  shape.face_normals();
  shape.face_offsets();
};

namespace detail {

template <class T>
struct PartOf {
  using type = T;
};
template <class T>
requires requires {
  typename T::PartShape;
}
struct PartOf<T> {
  using type = typename T::PartShape;
};

}  // namespace detail

/// The shape of the parts of a grain: T::PartShape for a Compound, T itself for any other shape.
template <class T>
using PartOf = typename detail::PartOf<T>::type;

/// A rigid grain of several convex parts, such as Compound<Polyhedron<>> (compound.hpp). Its
/// function parts() returns a list of objects with the members `shape`, a PartShape, and `pose`,
/// from the frame of the part to the frame of the grain.
template <class T>
concept CompoundShape = Shape<T> && requires(const T shape) {
  typename T::PartShape;
  shape.parts();
};

/// The shape of a grain of a simulation: a convex shape, or a compound of convex shapes.
template <class T>
concept GrainShape = Shape<T> && ConvexShape<PartOf<T>>;

// Optional member functions. A shape composed of other shapes has such a function if all its parts
// have it.

/// A shape with volume() [m^D].
template <class T>
concept HasVolume = requires(const T shape) {
  shape.volume();
};
/// A shape with circumradius(): the distance of its farthest point from the origin [m].
template <class T>
concept HasCircumradius = requires(const T shape) {
  shape.circumradius();
};
/// A shape with inradius(): the distance of the nearest point of its surface from the origin [m].
template <class T>
concept HasInradius = requires(const T shape) {
  shape.inradius();
};
/// A shape with scaled(factor): the same shape with all lengths multiplied by `factor` [-], > 0.
template <class T>
concept Scalable = requires(const T shape, typename T::Space::Scalar factor) {
  { shape.scaled(factor) } -> std::same_as<T>;
};

}  // namespace moreau
