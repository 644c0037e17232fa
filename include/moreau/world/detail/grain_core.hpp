// SPDX-License-Identifier: MIT
// The core of a grain that is touched at a point: what is left of the grain without its rounding. It is a point of a ball
// and of the end of a capsule, the axis of the side of a capsule and of a Cylinder, and a polytope itself, which is touched at a
// vertex, an edge or a face.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "moreau/core/compiled_once.hpp"
#include "moreau/detect/shape_kinds.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/cylinder.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau::detail {

/// Radius of the rounding around the core of a grain [m]; < 0 if it is not known.
/// @param outward unit, in which the grain is touched, body axes
template <class ShapeT>
typename SpaceOf<ShapeT>::Scalar core_rounding(const ShapeT&,
                                               const typename SpaceOf<ShapeT>::Vector&) {
  return Polytope<ShapeT> ? 0 : -1;
}
template <class S>
typename S::Scalar core_rounding(const BallIn<S>& ball, const typename S::Vector&) {
  return ball.radius();
}
/// Of the round side, whose core is the axis. What stands on an end, or on a rim, does not roll about its axis.
template <std::floating_point T>
T core_rounding(const Cylinder<T>& cylinder, const typename Cylinder<T>::Vector& outward) {
  return std::abs(outward[0]) < T(0.1) ? cylinder.radius() : T(-1);
}
template <class Core>
typename SpaceOf<Core>::Scalar core_rounding(const Rounded<Core>& shape,
                                             const typename SpaceOf<Core>::Vector& outward) {
  return shape.radius() +
         std::max(typename SpaceOf<Core>::Scalar(0), core_rounding(shape.core(), outward));
}
template <class... Shapes>
auto core_rounding(const OneOf<Shapes...>& shape,
                   const typename SpaceOf<OneOf<Shapes...>>::Vector& outward) {
  return shape.visit([&](const auto& held) { return core_rounding(held, outward); });
}

/// How the core of a grain is touched.
template <class Vector>
struct CoreFeature {
  bool is_known = false;  ///< whether is_face is; otherwise the key of the contact tells
  bool is_face = false;   ///< at a face
  /// Unit, along the straight side or edge that is touched, body axes; zero of others.
  Vector side = Vector::Zero();
};

/// @param is_edge whether the feature that touches is an edge, by the key of the contact; of shapes of which only the
///                support function is known it is not known
/// @param outward unit, in which the grain is touched, body axes
template <class ShapeT>
CoreFeature<typename SpaceOf<ShapeT>::Vector> core_feature(
    const ShapeT&, bool, const typename SpaceOf<ShapeT>::Vector&) {
  return {};
}
template <class S>
CoreFeature<typename S::Vector> core_feature(const Segment<S>&, bool is_edge,
                                             const typename S::Vector&) {
  CoreFeature<typename S::Vector> feature;
  if (is_edge) feature.side = S::Vector::UnitX();
  return feature;
}
template <std::floating_point T>
CoreFeature<typename Cylinder<T>::Vector> core_feature(
    const Cylinder<T>& cylinder, bool, const typename Cylinder<T>::Vector& outward) {
  CoreFeature<typename Cylinder<T>::Vector> feature;
  if (core_rounding(cylinder, outward) > 0) feature.side = Cylinder<T>::Vector::UnitX();
  return feature;
}
/// Of a polyhedron, by the vertices that lie farthest out: also where an edge of a face makes the contact point, or where the
/// key does not name the edge.
template <std::floating_point T>
MOREAU_INLINED inline CoreFeature<typename Polyhedron<T>::Vector> core_feature(
    const Polyhedron<T>& shape, bool, const typename Polyhedron<T>::Vector& outward) {
  CoreFeature<typename Polyhedron<T>::Vector> feature;
  const auto& vertices = shape.vertices();
  const T near = DetectionTolerance<T>::aligned * shape.circumradius();
  T highest = -std::numeric_limits<T>::infinity();
  for (Eigen::Index k = 0; k < vertices.rows(); ++k)
    highest = std::max(highest, vertices.row(k).dot(outward));
  Eigen::Index found[2] = {}, count = 0;
  for (Eigen::Index k = 0; k < vertices.rows(); ++k)
    if (vertices.row(k).dot(outward) > highest - near && ++count <= 2) found[count - 1] = k;
  feature.is_known = true;
  feature.is_face = count > 2;
  if (count == 2)
    feature.side = (vertices.row(found[1]) - vertices.row(found[0])).transpose().normalized();
  return feature;
}
template <class Core>
CoreFeature<typename SpaceOf<Core>::Vector> core_feature(
    const Rounded<Core>& shape, bool is_edge, const typename SpaceOf<Core>::Vector& outward) {
  return core_feature(shape.core(), is_edge, outward);
}
template <class... Shapes>
auto core_feature(const OneOf<Shapes...>& shape, bool is_edge,
                  const typename SpaceOf<OneOf<Shapes...>>::Vector& outward) {
  return shape.visit([&](const auto& held) { return core_feature(held, is_edge, outward); });
}

/// Whether a shape can have a straight side that a rounded one touches. In the plane, where angular velocities are numbers, the
/// side of a capsule is a face. Polyhedra alone touch each other with faces, or as if with faces.
template <class ShapeT>
inline constexpr bool has_straight_sides = false;
template <class S>
requires std::same_as<typename S::Vector, typename S::Angular>
inline constexpr bool has_straight_sides<Segment<S>> = true;
template <class T>
inline constexpr bool has_straight_sides<Cylinder<T>> = true;
template <class Core>
inline constexpr bool has_straight_sides<Rounded<Core>> = has_straight_sides<Core>;
template <class T>
inline constexpr bool has_straight_sides<Rounded<Polyhedron<T>>> = true;
template <class... Shapes>
inline constexpr bool has_straight_sides<OneOf<Shapes...>> =
    sizeof...(Shapes) > 1 && (std::same_as<typename SpaceOf<OneOf<Shapes...>>::Vector,
                                           typename SpaceOf<OneOf<Shapes...>>::Angular> ||
                              (has_straight_sides<Shapes> || ...));

/// Whether a grain is a ball.
template <class ShapeT>
bool core_is_point(const ShapeT&) {
  return moreau::is_ball<ShapeT>;
}
template <class... Shapes>
bool core_is_point(const OneOf<Shapes...>& shape) {
  return shape.visit([](const auto& held) { return core_is_point(held); });
}

}  // namespace moreau::detail
