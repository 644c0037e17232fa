// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/detect/convex/simplex.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// A pair of polyhedra in coordinates relative to their centres.
template <std::floating_point T>
class PolyhedronPair {
 public:
  using Vector = typename Space<3, T>::Vector;
  using Shape = Placed<Polyhedron<T>>;
  using Point = DifferencePoint<Vector>;

  PolyhedronPair(const Shape& first, const Shape& second)
      : a(first),
        b(second),
        offset(second.center() - first.center()),
        size(first.radius() + second.radius()) {}

  const Shape& a;
  const Shape& b;
  const Vector offset;  ///< centre of b minus centre of a
  const T size;         ///< the sum of the radii: what tolerances are relative to

  T rounding() const { return size * DetectionTolerance<T>::rounding; }

  /// The point of B - A with the smallest product with n.
  Point support(const Vector& n) const {
    const std::uint32_t i = a.vertices().farthest(n).index;
    const std::uint32_t j = b.vertices().farthest(-n).index;
    return {offset + (b.vertices()[j] - a.vertices()[i]), i, j};
  }
  /// The separation along a unit vector: a lower bound of the gap, whatever the vector.
  T separation(const Vector& n) const {
    return n.dot(offset) - (a.vertices().reach(n) + b.vertices().reach(-n));
  }
  /// From the centre of a to that of b, or anything if they coincide.
  Vector start() const {
    return offset.squaredNorm() > rounding() * rounding() ? offset : Vector(Vector::UnitX());
  }

  /// Whether an axis is at hand along which the shapes are farther apart than the margin, by more
  /// than rounding: then every other way to the answer finds the same.
  bool is_apart_at_once(T margin, PairCache<Space<3, T>>& cache) const {
    if (cache.kind == AxisKind::none && cache.axis != Vector::Zero() &&
        separation(cache.axis) > margin + rounding())
      return true;
    const T reach = size + margin + rounding();
    if (!(offset.squaredNorm() > reach * reach)) return false;
    cache.axis = offset.normalized();
    cache.kind = AxisKind::none;
    return true;
  }
};

/// The edge between two vertices of a shape, if there is one.
template <std::floating_point T>
bool find_edge(const Placed<Polyhedron<T>>& shape, std::uint32_t v, std::uint32_t w,
               std::uint32_t& edge) {
  if (v == w) return false;
  for (const std::uint32_t e : shape.shape().vertex_edges(v)) {
    const auto& ends = shape.shape().edges()[e].vertex;
    if (ends[0] != w && ends[1] != w) continue;
    edge = e;
    return true;
  }
  return false;
}

}  // namespace moreau::detail
