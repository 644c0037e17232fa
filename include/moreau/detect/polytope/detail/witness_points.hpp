// SPDX-License-Identifier: MIT
// The nearest or deepest points of two polytopes, computed from their separating axis.
#pragma once

#include <algorithm>

#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/polytope/detail/feature_axis.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

/// The nearest points of two edges along their common normal. If the edges are so parallel that
/// rounding hides where their lines cross, a point of one edge that lies opposite the other edge.
template <std::floating_point T>
WitnessPoints<Space<3, T>> witness_of_edges(const PolytopePair<Polyhedron<T>>& pair,
                                            const Axis<Space<3, T>>& axis) {
  using Vector = typename Space<3, T>::Vector;
  const auto& edge_a = pair.a.shape().edges()[axis.a];
  const auto& edge_b = pair.b.shape().edges()[axis.b];
  const Vector p = pair.a.vertices()[edge_a.vertex[0]];
  const Vector q = pair.b.vertices()[edge_b.vertex[0]] + pair.offset;
  const Vector u = pair.a.vertices()[edge_a.vertex[1]] - p;
  const Vector v = pair.b.vertices()[edge_b.vertex[1]] + pair.offset - q;
  // At this t, the point p + t u of a's edge lies opposite the line of b's edge: both have the same
  // coordinate along `across`, which is perpendicular to the normal and to b's edge.
  const Vector across = v.cross(axis.normal);
  const T slope = u.dot(across);
  T t = slope == T(0) ? T(0.5) : std::clamp(across.dot(q - p) / slope, T(0), T(1));
  const Vector from_q = along(p, t, u) - q;
  const T beside = from_q.dot(v) / v.squaredNorm();
  if (!(beside >= T(0) && beside <= T(1))) {
    const Vector end = beside > T(0) ? Vector(q + v) : q;
    t = std::clamp(u.dot(end - p) / u.squaredNorm(), T(0), T(1));
  }
  const Vector on_a = along(p, t, u);
  return {on_a, along(on_a, axis.gap, axis.normal),
          FeatureKey(FeatureKey::Kind::edge_edge, axis.a, axis.b)};
}

/// For an axis of a face: the deepest vertex and its projection onto the plane of the face.
template <std::floating_point T>
WitnessPoints<Space<3, T>> witness_of_face(const PolytopePair<Polyhedron<T>>& pair,
                                           const Axis<Space<3, T>>& axis) {
  using Vector = typename Space<3, T>::Vector;
  const Vector across = axis.gap * axis.normal;
  if (axis.kind == AxisKind::face_a) {
    const Vector on_b = pair.b.vertices()[axis.b] + pair.offset;
    return {on_b - across, on_b, FeatureKey(FeatureKey::Kind::face_vertex, axis.a, axis.b)};
  }
  const Vector on_a = pair.a.vertices()[axis.a];
  return {on_a, on_a + across, FeatureKey(FeatureKey::Kind::vertex_face, axis.a, axis.b)};
}

/// For an axis of two vertices, or of a vertex and an edge.
template <std::floating_point T>
WitnessPoints<Space<3, T>> witness_of_vertex(const PolytopePair<Polyhedron<T>>& pair,
                                             const Axis<Space<3, T>>& axis) {
  using Kind = FeatureKey::Kind;
  const auto [on_a, on_b] = nearest_points_of(pair, axis.kind, axis.a, axis.b);
  const Kind kind = axis.kind == AxisKind::vertices      ? Kind::vertex_vertex
                    : axis.kind == AxisKind::vertex_edge ? Kind::vertex_edge
                                                         : Kind::edge_vertex;
  return {on_a, on_b, FeatureKey(kind, axis.a, axis.b)};
}

/// The nearest or deepest points of two polyhedra along the axis.
template <std::floating_point T>
WitnessPoints<Space<3, T>> witness_of(const PolytopePair<Polyhedron<T>>& pair,
                                      const FoundAxis<Space<3, T>>& found) {
  switch (found.axis.kind) {
    case AxisKind::face_a:
    case AxisKind::face_b:
      return witness_of_face(pair, found.axis);
    case AxisKind::edges:
      return witness_of_edges(pair, found.axis);
    case AxisKind::nearest_points:
      return *found.nearest;
    default:
      return witness_of_vertex(pair, found.axis);
  }
}

/// The contact point: the point midway between the witness points.
template <std::floating_point T>
ManifoldPoint<Space<3, T>> witness_point(const PolytopePair<Polyhedron<T>>& pair,
                                         const FoundAxis<Space<3, T>>& found) {
  const auto witness = witness_of(pair, found);
  return {along(pair.a.center(), T(0.5), witness.on_a + witness.on_b), found.axis.gap,
          witness.feature};
}
/// The same in the plane.
template <std::floating_point T>
ManifoldPoint<Space<2, T>> witness_point(const PolytopePair<Polygon<T>>& pair,
                                         const FoundAxis<Space<2, T>>& found) {
  using Vector = typename Space<2, T>::Vector;
  using Kind = FeatureKey::Kind;
  const Axis<Space<2, T>>& axis = found.axis;
  const Vector half = T(0.5) * axis.gap * axis.normal;
  if (axis.kind == AxisKind::face_a)
    return {pair.b.center() + (pair.b.vertices()[axis.b] - half), axis.gap,
            FeatureKey(Kind::edge_vertex, axis.a, axis.b)};
  const Kind kind = axis.kind == AxisKind::face_b ? Kind::vertex_edge : Kind::vertex_vertex;
  return {pair.a.center() + (pair.a.vertices()[axis.a] + half), axis.gap,
          FeatureKey(kind, axis.a, axis.b)};
}

/// The point midway between the witness points, relative to the centre of a, world axes [m].
template <std::floating_point T>
typename Space<3, T>::Vector witness_middle(const PolytopePair<Polyhedron<T>>& pair,
                                            const FoundAxis<Space<3, T>>& found) {
  const auto witness = witness_of(pair, found);
  return T(0.5) * (witness.on_a + witness.on_b);
}
/// The same in the plane.
template <std::floating_point T>
typename Space<2, T>::Vector witness_middle(const PolytopePair<Polygon<T>>& pair,
                                            const FoundAxis<Space<2, T>>& found) {
  return witness_point(pair, found).position - pair.a.center();
}

/// Whether the witness points lie on both features that make the axis. A witness point beside a
/// feature is not a contact point. This happens if several vertices are equally deep, so that the
/// one found need not lie above the face, or if two edges are so parallel that the separation is
/// the same for points beyond their ends.
template <class ShapeT>
bool witness_is_on_both(const PolytopePair<ShapeT>& pair, const FoundAxis<SpaceOf<ShapeT>>& found) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Axis<S>& axis = found.axis;
  if (axis.kind == AxisKind::face_a)
    return projects_onto(pair.a, axis.a, Vector(pair.b.vertices()[axis.b] + pair.offset));
  if (axis.kind == AxisKind::face_b)
    return projects_onto(pair.b, axis.b, Vector(pair.a.vertices()[axis.a] - pair.offset));
  if constexpr (S::dim == 3) {
    if (axis.kind != AxisKind::edges) return true;
    const Vector on_b = witness_of_edges(pair, axis).on_b - pair.offset;
    const T near = pair.size * DetectionTolerance<T>::coincident;
    const T along = std::clamp(fraction_along(pair.b, axis.b, on_b), T(0), T(1));
    return (point_along(pair.b, axis.b, along) - on_b).squaredNorm() <= near * near;
  }
  return true;
}

}  // namespace moreau::detail
