// SPDX-License-Identifier: MIT
// The axis of a pair of polyhedra from the features that made it the step before, if they can be
// proved to make it still. local_proof.hpp says why this is a proof.
#pragma once

#include <algorithm>
#include <cmath>

#include "moreau/detect/polytope/detail/edge_search.hpp"
#include "moreau/detect/polytope/detail/local_proof.hpp"
#include "moreau/detect/polytope/detail/nearest_axis.hpp"
#include "moreau/detect/polytope/polyhedron_pair.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

template <std::floating_point T>
class PolyhedronRecall {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polyhedron<T>>;

  explicit PolyhedronRecall(const PolyhedronPair<T>& pair) : pair_(pair) {}

  /// Whether the features are proved to be those that the full search would find; `axis()` then is
  /// its axis, to the bit. They may be any numbers.
  bool prove(const PairCache<S>& features) {
    switch (features.kind) {
      case AxisKind::face_a:
        return features.a < pair_.a.normals().size() && prove_face_a(features.a);
      case AxisKind::face_b:
        return features.b < pair_.b.normals().size() && prove_face_b(features.b);
      case AxisKind::edges:
        return features.a < pair_.a.shape().edge_count() &&
               features.b < pair_.b.shape().edge_count() && prove_edges(features.a, features.b);
      case AxisKind::vertices:
        return features.a < pair_.a.vertices().size() && features.b < pair_.b.vertices().size() &&
               prove_nearest(features.kind, features.a, features.b);
      case AxisKind::vertex_edge:
        return features.a < pair_.a.vertices().size() &&
               features.b < pair_.b.shape().edge_count() &&
               prove_nearest(features.kind, features.a, features.b);
      case AxisKind::edge_vertex:
        return features.a < pair_.a.shape().edge_count() &&
               features.b < pair_.b.vertices().size() &&
               prove_nearest(features.kind, features.a, features.b);
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
  /// How many vertices lie within an angle of the top one: the only ones that can have a face or an
  /// edge that is perpendicular to a direction less than that angle away.
  static std::ptrdiff_t count_top(const Shape& shape, const Vector& direction, T top, T angle) {
    return shape.vertices().count_above(direction, top - T(2) * angle * shape.radius());
  }

  // The search takes a's face unless another axis is better by more than rounding. So it is enough
  // that no other face of a is parallel.
  bool prove_face_a(std::uint32_t face) {
    if (pair_.a.shape().normal_spacing() < T(2) * distinct) return false;
    const auto found = measure_face(pair_.a, face, pair_.b, pair_.offset);
    axis_ = {pair_.a.normals()[face], found.separation, AxisKind::face_a, face, found.vertex};
    return projects_onto(pair_.a, face, Vector(pair_.b.vertices()[found.vertex] + pair_.offset),
                         clearance());
  }
  // Here no face of a may be parallel: a face has three vertices.
  bool prove_face_b(std::uint32_t face) {
    if (pair_.b.shape().normal_spacing() < T(2) * distinct) return false;
    const auto found = measure_face(pair_.b, face, pair_.a, Vector(-pair_.offset));
    axis_ = {-pair_.b.normals()[face], found.separation, AxisKind::face_b, found.vertex, face};
    const Vector deepest = pair_.a.vertices()[found.vertex];
    return projects_onto(pair_.b, face, Vector(deepest - pair_.offset), clearance()) &&
           count_top(pair_.a, axis_.normal, axis_.normal.dot(deepest), distinct) <= 2;
  }

  // No face and no other edge may be parallel: the two ends are the only vertices on top.
  bool prove_edges(std::uint32_t id_a, std::uint32_t id_b) {
    const EdgeView<T> a(pair_.a, id_a), b(pair_.b, id_b);
    axis_.kind = AxisKind::edges;
    axis_.a = id_a;
    axis_.b = id_b;
    if (!measure_edges(a, b, pair_.offset, axis_)) return false;
    return crosses_inside(a, b, clearance()) &&
           edge_is_top(pair_.a, id_a, axis_.normal, distinct) &&
           edge_is_top(pair_.b, id_b, -axis_.normal, distinct);
  }
  /// Whether the crossing of the edges, seen along the normal, is at least the clearance from the
  /// rim of the parallelogram that they span; they must not be nearly parallel.
  bool crosses_inside(const EdgeView<T>& a, const EdgeView<T>& b, T clearance) const {
    const Vector apart = b.from + pair_.offset - a.from;
    const Vector across_a = axis_.normal.cross(a.direction);
    const Vector across_b = axis_.normal.cross(b.direction);
    const T turn = a.direction.dot(across_b), area = std::abs(turn);
    const T length2_a = a.direction.squaredNorm(), length2_b = b.direction.squaredNorm();
    if (!(area * area > T(1e-4) * length2_a * length2_b)) return false;
    const T sign = std::copysign(T(1), turn);
    const auto is_inside = [&](T along, T length2) {
      const T inside = std::min(along, area - along);
      return inside >= T(0) && inside * inside >= clearance * clearance * length2;
    };
    return is_inside(sign * apart.dot(across_b), length2_b) &&
           is_inside(sign * apart.dot(across_a), length2_a);
  }
  static bool edge_is_top(const Shape& shape, std::uint32_t edge, const Vector& direction,
                          T angle) {
    const auto& ends = shape.shape().edges()[edge].vertex;
    const T first = direction.dot(shape.vertices()[ends[0]]);
    const T second = direction.dot(shape.vertices()[ends[1]]);
    const T top = std::max(first, second);
    return std::abs(first - second) < T(2) * angle * shape.radius() &&
           count_top(shape, direction, top, angle) == 2;
  }
  static bool vertex_is_top(const Shape& shape, std::uint32_t vertex, const Vector& direction,
                            T angle) {
    return count_top(shape, direction, direction.dot(shape.vertices()[vertex]), angle) == 1;
  }

  // C lies beyond the plane through gap * n, so an axis at the angle theta from n separates by no
  // more than gap cos theta: there the angle that tells axes apart is larger.
  bool prove_nearest(AxisKind kind, std::uint32_t a, std::uint32_t b) {
    constexpr T aligned = DetectionTolerance<T>::aligned;
    if (kind == AxisKind::edge_vertex &&
        !is_within(fraction_along(pair_.a, a, Vector(pair_.b.vertices()[b] + pair_.offset))))
      return false;
    if (kind == AxisKind::vertex_edge &&
        !is_within(fraction_along(pair_.b, b, Vector(pair_.a.vertices()[a] - pair_.offset))))
      return false;
    measure_nearest(pair_, kind, a, b, axis_);
    if (!(axis_.gap * aligned * aligned > T(8) * pair_.rounding())) return false;
    const Vector& n = axis_.normal;
    const bool is_top_a = kind == AxisKind::edge_vertex ? edge_is_top(pair_.a, a, n, aligned)
                                                        : vertex_is_top(pair_.a, a, n, aligned);
    return is_top_a && (kind == AxisKind::vertex_edge ? edge_is_top(pair_.b, b, -n, aligned)
                                                      : vertex_is_top(pair_.b, b, -n, aligned));
  }
  static bool is_within(T fraction) { return fraction > aligned_end && fraction < 1 - aligned_end; }
  static constexpr T aligned_end = DetectionTolerance<T>::aligned;

  const PolyhedronPair<T>& pair_;
  Axis<S> axis_;
};

}  // namespace moreau::detail
