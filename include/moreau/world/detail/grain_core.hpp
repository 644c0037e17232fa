// SPDX-License-Identifier: MIT
// The core of a grain that is touched at a point: what is left of the grain without its rounding. It is a point of a ball
// and of the end of a capsule, the axis of the side of a capsule and of a Cylinder, and a polytope itself.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "moreau/detect/shape_kinds.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/cylinder.hpp"
#include "moreau/shape/one_of.hpp"
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

/// Unit vector along the core of a grain that is touched at its straight side, body axes; zero of others.
/// @param is_edge whether the feature that touches is an edge; of shapes of which only the support function is known it
///                is not known
/// @param outward unit, in which the grain is touched, body axes
template <class ShapeT>
typename SpaceOf<ShapeT>::Vector straight_side(const ShapeT&, bool,
                                               const typename SpaceOf<ShapeT>::Vector&) {
  return SpaceOf<ShapeT>::Vector::Zero();
}
template <class S>
typename S::Vector straight_side(const Segment<S>&, bool is_edge, const typename S::Vector&) {
  return is_edge ? typename S::Vector(S::Vector::UnitX()) : typename S::Vector(S::Vector::Zero());
}
template <std::floating_point T>
typename Cylinder<T>::Vector straight_side(const Cylinder<T>& cylinder, bool,
                                           const typename Cylinder<T>::Vector& outward) {
  typename Cylinder<T>::Vector along = Cylinder<T>::Vector::Zero();
  if (core_rounding(cylinder, outward) > 0) along = Cylinder<T>::Vector::UnitX();
  return along;
}
template <class Core>
typename SpaceOf<Core>::Vector straight_side(const Rounded<Core>& shape, bool is_edge,
                                             const typename SpaceOf<Core>::Vector& outward) {
  return straight_side(shape.core(), is_edge, outward);
}
template <class... Shapes>
auto straight_side(const OneOf<Shapes...>& shape, bool is_edge,
                   const typename SpaceOf<OneOf<Shapes...>>::Vector& outward) {
  return shape.visit([&](const auto& held) { return straight_side(held, is_edge, outward); });
}

/// Whether a shape can have a straight side. In the plane, where angular velocities are numbers, the side of a capsule is
/// a face.
template <class ShapeT>
inline constexpr bool has_straight_sides = false;
template <class S>
requires std::same_as<typename S::Vector, typename S::Angular>
inline constexpr bool has_straight_sides<Segment<S>> = true;
template <class T>
inline constexpr bool has_straight_sides<Cylinder<T>> = true;
template <class Core>
inline constexpr bool has_straight_sides<Rounded<Core>> = has_straight_sides<Core>;
template <class... Shapes>
inline constexpr bool has_straight_sides<OneOf<Shapes...>> = (has_straight_sides<Shapes> || ...);

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
