// SPDX-License-Identifier: MIT
// Two placed polygons, or two placed polyhedra, in coordinates relative to the centre of the first.
//
// All directions are in world axes. Points of a are relative to the centre of a, and points of b
// are relative to the centre of b, unless a comment says otherwise. `offset` is the vector from the
// centre of a to the centre of b. So a pair far from the world's origin loses no digits.
#pragma once

#include <array>
#include <cstdint>

#include "moreau/detect/convex/simplex.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// The vertices before and after a vertex of a polygon.
template <std::floating_point T>
std::array<std::uint32_t, 2> neighbours(const Placed<Polygon<T>>& shape, std::uint32_t vertex) {
  const auto count = static_cast<std::uint32_t>(shape.vertices().size());
  return {(vertex > 0 ? vertex : count) - 1, vertex + 1 < count ? vertex + 1 : 0};
}

/// A pair of two polygons or of two polyhedra.
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
  const T size;         ///< sum of the circumradii [m]; tolerances are relative to it

  /// Bound of the rounding error of a separation [m].
  T rounding() const { return size * DetectionTolerance<T>::rounding; }
  /// The separation along a unit vector, world axes [m]. Along any vector it is a lower bound of
  /// the signed gap.
  T separation(const Vector& n) const {
    return n.dot(offset) - (a.vertices().reach(n) + b.vertices().reach(-n));
  }
  /// The difference b - a of a vertex of b and a vertex of a with the smallest product with n,
  /// world axes [m].
  Point support(const Vector& n) const {
    const std::uint32_t i = a.vertices().farthest(n).index;
    const std::uint32_t j = b.vertices().farthest(-n).index;
    const Vector apart = b.vertices()[j] - a.vertices()[i];
    return {offset + apart, i, j};
  }
  /// The first search direction of GJK: from the centre of a to the centre of b, or the x axis if
  /// the centres coincide.
  Vector start() const {
    return offset.squaredNorm() > rounding() * rounding() ? offset : Vector(Vector::UnitX());
  }

  /// Whether it is certain, without a search, that the gap exceeds the margin [m] by more than
  /// rounding. This is certain if the circumscribed balls are that far apart, or if the axis that
  /// separated the shapes in the previous step still separates them. The search would return the
  /// same result then.
  bool is_clearly_apart(T margin, const PairCache<S>& cache) const {
    const T reach = size + margin + rounding();
    if (offset.squaredNorm() > reach * reach) return true;
    return cache.kind == AxisKind::none && !cache.axis.isZero(0) &&
           separation(cache.axis) > margin + rounding();
  }
};

}  // namespace moreau::detail
