// SPDX-License-Identifier: MIT
// The axis of a pair of polygons from the features that made it the step before, if they can be
// proved to make it still. local_proof.hpp says why this is a proof.
#pragma once

#include "moreau/detect/polytope/detail/local_proof.hpp"
#include "moreau/detect/polytope/polygon_axis.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

template <std::floating_point T>
class PolygonRecall {
 public:
  using S = Space<2, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polygon<T>>;

  explicit PolygonRecall(const PolygonPair<T>& pair) : pair_(pair) {}

  /// Whether the features are proved to be those that the full search would find; `axis()` then is
  /// its axis, to the bit. They may be any numbers.
  bool prove(const PairCache<S>& features) {
    if (features.a >= pair_.a.vertices().size() || features.b >= pair_.b.vertices().size())
      return false;
    switch (features.kind) {
      case AxisKind::face_a:
        return prove_edge_of_a(features.a);
      case AxisKind::face_b:
        return prove_edge_of_b(features.b);
      case AxisKind::vertices:
        return prove_vertices(features.a, features.b);
      default:
        return false;
    }
  }
  const Axis<S>& axis() const { return axis_; }

 private:
  static constexpr T distinct = DetectionTolerance<T>::distinct;

  T clearance() const {
    return needed_clearance(axis_.gap, axis_.normal.dot(pair_.offset), pair_.offset.squaredNorm(),
                            pair_.a.shape().inradius() + pair_.b.shape().inradius(), pair_.size);
  }
  /// Whether no other vertex is so high that an edge there is perpendicular to a direction less
  /// than the angle away.
  static bool stands_out(const Shape& shape, std::uint32_t vertex, const Vector& direction,
                         T angle) {
    const T top = direction.dot(shape.vertices()[vertex]);
    return shape.vertices().count_above(direction, top - T(2) * angle * shape.radius()) == 1;
  }

  // The search takes a's edge unless one of b is better by more than rounding. So it is enough that
  // no other edge of a is parallel.
  bool prove_edge_of_a(std::uint32_t edge) {
    if (pair_.a.shape().normal_spacing() < T(2) * distinct) return false;
    axis_ = pair_.of_edge_of_a(edge);
    return projects_onto(pair_.a, edge, Vector(pair_.b.vertices()[axis_.b] + pair_.offset),
                         clearance());
  }
  // Here no edge of a may be parallel.
  bool prove_edge_of_b(std::uint32_t edge) {
    if (pair_.b.shape().normal_spacing() < T(2) * distinct) return false;
    axis_ = pair_.of_edge_of_b(edge);
    return projects_onto(pair_.b, edge, Vector(pair_.a.vertices()[axis_.a] - pair_.offset),
                         clearance()) &&
           stands_out(pair_.a, axis_.a, axis_.normal, distinct);
  }
  // C lies beyond the line through gap * n, so an axis at the angle theta from n separates by no
  // more than gap cos theta: there the angle that tells axes apart is larger.
  bool prove_vertices(std::uint32_t a, std::uint32_t b) {
    constexpr T aligned = DetectionTolerance<T>::aligned;
    axis_ = pair_.of_vertices(a, b);
    return axis_.gap * aligned * aligned > T(8) * pair_.rounding() &&
           stands_out(pair_.a, a, axis_.normal, aligned) &&
           stands_out(pair_.b, b, Vector(-axis_.normal), aligned);
  }

  const PolygonPair<T>& pair_;
  Axis<S> axis_;
};

}  // namespace moreau::detail
