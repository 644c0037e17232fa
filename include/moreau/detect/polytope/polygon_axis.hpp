// SPDX-License-Identifier: MIT
// Signed gap and axis of a pair of polygons.
//
// For a unit vector n let s(n) = min over B of n.b - max over A of n.a. The gap is at least the
// largest s over the normals of the edges of both; equal to it if the shapes overlap, because the
// edges of B - A are theirs, or if the deepest vertex's foot lies within the edge. What is left are
// pairs apart with two vertices nearest to each other.
#pragma once

#include <limits>

#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/projection.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/polygon.hpp"

namespace moreau::detail {

template <std::floating_point T>
class PolygonPair {
 public:
  using S = Space<2, T>;
  using W = Wide<T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polygon<T>>;

  PolygonPair(const Shape& first, const Shape& second)
      : a(first),
        b(second),
        offset(second.center() - first.center()),
        size(first.radius() + second.radius()) {}

  const Shape& a;
  const Shape& b;
  const Vector offset;  ///< centre of b minus centre of a
  const T size;         ///< the sum of the radii: what tolerances are relative to

  T rounding() const { return size * DetectionTolerance<T>::rounding; }

  /// The separation along a unit vector: a lower bound of the gap, whatever the vector.
  T separation(const Vector& n) const {
    return n.dot(offset) - (a.vertices().reach(n) + b.vertices().reach(-n));
  }

  /// Whether an axis is at hand along which the shapes are farther apart than the margin, by more
  /// than rounding: then every other way to the answer finds the same.
  bool is_apart_at_once(T margin, const PairCache<S>& cache) const {
    const T reach = size + margin + rounding();
    if (offset.squaredNorm() > reach * reach) return true;
    return cache.kind == AxisKind::none && !cache.axis.isZero(0) &&
           separation(cache.axis) > margin + rounding();
  }

  /// The best axis among the edges; exact if it says so.
  struct EdgeAxis {
    Axis<S> axis;
    bool is_exact;
  };
  EdgeAxis edge_axis(T margin) const {
    const Extreme<T> of_a = best_edge(a, b, offset);
    if (of_a.value > margin) return {of_edge_of_a(of_a.index), false};
    const Extreme<T> of_b = best_edge(b, a, -offset);
    const bool take_b = of_b.value > of_a.value + rounding();
    const Axis<S> axis = take_b ? of_edge_of_b(of_b.index) : of_edge_of_a(of_a.index);
    const bool is_exact =
        axis.gap <= T(0) || (take_b ? projects_onto(b, axis.b, a.vertices()[axis.a] - offset)
                                    : projects_onto(a, axis.a, b.vertices()[axis.b] + offset));
    return {axis, is_exact};
  }

  /// Of shapes that are apart: every vertex against every edge.
  Axis<S> nearest_points() const {
    Axis<S> best{Vector::UnitX(), std::numeric_limits<T>::infinity(), AxisKind::vertices, 0, 0};
    for (std::uint32_t i = 0; i < a.vertices().size(); ++i)
      for (std::uint32_t j = 0; j < b.vertices().size(); ++j) {
        try_point(a, i, b.vertices()[j] + offset, T(1), {AxisKind::face_a, i, j}, {i, j}, best);
        try_point(b, j, a.vertices()[i] - offset, T(-1), {AxisKind::face_b, i, j}, {i, j}, best);
      }
    return best.kind == AxisKind::vertices ? of_vertices(best.a, best.b) : best;
  }

  /// The axis of a feature. One function for the search and for what is remembered, so that both
  /// give the same bits.
  [[gnu::noinline]] Axis<S> of_edge_of_a(std::uint32_t edge) const {
    const Vector n = a.normals()[edge];
    const std::uint32_t vertex = b.vertices().farthest(-n).index;
    return {n, n.dot(b.vertices()[vertex] + offset) - a.offset(edge), AxisKind::face_a, edge,
            vertex};
  }
  [[gnu::noinline]] Axis<S> of_edge_of_b(std::uint32_t edge) const {
    const Vector n = b.normals()[edge];
    const std::uint32_t vertex = a.vertices().farthest(-n).index;
    return {-n, n.dot(a.vertices()[vertex] - offset) - b.offset(edge), AxisKind::face_b, vertex,
            edge};
  }
  [[gnu::noinline]] Axis<S> of_vertices(std::uint32_t i, std::uint32_t j) const {
    const Vector apart = b.vertices()[j] + offset - a.vertices()[i];
    const T gap = apart.norm();
    return {apart / gap, gap, AxisKind::vertices, i, j};
  }

  static std::uint32_t next(const Shape& shape, std::uint32_t v) {
    return v + 1 < shape.vertices().size() ? v + 1 : 0;
  }

 private:
  /// The edge of own along whose normal the lowest vertex of other is highest.
  static Extreme<T> best_edge(const Shape& own, const Shape& other, const Vector& offset) {
    WideMaximum<T> best{W::broadcast(-std::numeric_limits<T>::infinity()), W::iota()};
    auto index = W::iota();
    const auto apart = Rows<S>::broadcast(offset);
    for (Eigen::Index i = 0; i < own.normals().padded_size(); i += W::lanes) {
      const auto normals = own.normals().wide(i);
      best.take(other.vertices().lowest(normals) + own.normals().dot(i, apart) -
                    W::load(own.offsets() + i),
                index);
      index += W::lanes;
    }
    return best.reduce();
  }
  struct Feature {
    AxisKind kind;
    std::uint32_t a, b;
  };
  /// One edge (from vertex `edge`) against one point x; sign is 1 if the edge is a's.
  static void try_point(const Shape& shape, std::uint32_t edge, const Vector& x, T sign,
                        const Feature& feature, const std::array<std::uint32_t, 2>& vertices,
                        Axis<S>& best) {
    const Vector from = shape.vertices()[edge];
    const Vector apart = x - from;
    const Vector along = shape.vertices()[next(shape, edge)] - from;
    const T t = along.dot(apart);
    if (t > T(0) && t < along.squaredNorm()) {
      const Vector normal = shape.normals()[edge];
      const T gap = normal.dot(apart);
      if (gap >= T(0) && gap < best.gap)
        best = {sign * normal, gap, feature.kind, feature.a, feature.b};
    } else if (const T gap = apart.norm(); t <= T(0) && gap > T(0) && gap < best.gap) {
      best = {sign / gap * apart, gap, AxisKind::vertices, vertices[0], vertices[1]};
    }
  }
};

}  // namespace moreau::detail
