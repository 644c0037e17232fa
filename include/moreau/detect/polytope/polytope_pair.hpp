// SPDX-License-Identifier: MIT
// Two placed polygons or two placed polyhedra in coordinates relative to the centre of the first.
//
// All directions are in world axes. Points of a are relative to the centre of a and points of b to
// the centre of b, unless a comment says otherwise; `offset` leads from the one to the other, so
// that a pair far from the world's origin loses no digits.
#pragma once

#include <cstdint>

#include "moreau/detect/convex/simplex.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// A pair of polytopes of one kind.
template <class ShapeT>
class PolytopePair {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Shape = Placed<ShapeT>;
  using Point = DifferencePoint<Vector>;

  PolytopePair(const Shape& first, const Shape& second)
      : a(first),
        b(second),
        offset(second.center() - first.center()),
        size(first.radius() + second.radius()) {}

  const Shape& a;
  const Shape& b;
  const Vector offset;  ///< centre of b minus centre of a, world axes [m]
  const T size;         ///< sum of the circumradii [m]: the length that tolerances are relative to

  /// What rounding may add to a separation [m].
  T rounding() const { return size * DetectionTolerance<T>::rounding; }
  /// The separation along a unit vector [m]: a lower bound of the signed gap for any vector.
  T separation(const Vector& n) const {
    return n.dot(offset) - (a.vertices().reach(n) + b.vertices().reach(-n));
  }
  /// The point of B - A with the smallest product with n, relative to the centre of a [m].
  Point support(const Vector& n) const {
    const std::uint32_t i = a.vertices().farthest(n).index;
    const std::uint32_t j = b.vertices().farthest(-n).index;
    return {offset + (b.vertices()[j] - a.vertices()[i]), i, j};
  }
  /// A first direction for GJK: from the centre of a to that of b; the x axis if they coincide.
  Vector start() const {
    return offset.squaredNorm() > rounding() * rounding() ? offset : Vector(Vector::UnitX());
  }

  /// Whether the balls about the shapes, or the axis that separated the shapes in the step before,
  /// show that the gap exceeds the margin [m] by more than rounding. Every other query of the pair
  /// then finds the same.
  bool is_clearly_apart(T margin, const PairCache<S>& cache) const {
    const T reach = size + margin + rounding();
    if (offset.squaredNorm() > reach * reach) return true;
    return cache.kind == AxisKind::none && !cache.axis.isZero(0) &&
           separation(cache.axis) > margin + rounding();
  }
};

}  // namespace moreau::detail
