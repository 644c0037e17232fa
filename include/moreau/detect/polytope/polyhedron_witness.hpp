// SPDX-License-Identifier: MIT
// The points of two polyhedra that are nearest to each other, or deepest, once the axis is known.
#pragma once

#include <algorithm>
#include <array>

#include "moreau/detect/convex/simplex.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/polytope/detail/nearest_axis.hpp"
#include "moreau/detect/polytope/polyhedron_pair.hpp"

namespace moreau::detail {

/// The points of the surfaces nearest to each other along the axis, relative to the centre of a.
template <class Vector>
struct Witness {
  Vector a, b;
  FeatureKey feature;
};

/// Nearest points of two edges that lie across their common normal. Where they are so parallel that
/// the crossing of their lines is lost in rounding, some point of each beside the other.
template <std::floating_point T>
Witness<typename Space<3, T>::Vector> witness_of_edges(const PolyhedronPair<T>& pair,
                                                       const Axis<Space<3, T>>& axis) {
  using Vector = typename Space<3, T>::Vector;
  const auto& edge_a = pair.a.shape().edges()[axis.a];
  const auto& edge_b = pair.b.shape().edges()[axis.b];
  const Vector p = pair.a.vertices()[edge_a.vertex[0]];
  const Vector q = pair.b.vertices()[edge_b.vertex[0]] + pair.offset;
  const Vector u = pair.a.vertices()[edge_a.vertex[1]] - p;
  const Vector v = pair.b.vertices()[edge_b.vertex[1]] + pair.offset - q;
  // Both lines in the plane perpendicular to v: p + t u meets q there.
  const Vector across = v.cross(axis.normal);
  const T slope = u.dot(across);
  T t = slope == T(0) ? T(0.5) : std::clamp((q - p).dot(across) / slope, T(0), T(1));
  const T beside = (p + t * u - q).dot(v) / v.squaredNorm();
  if (!(beside >= T(0) && beside <= T(1))) {
    const Vector end = beside > T(0) ? Vector(q + v) : q;
    t = std::clamp((end - p).dot(u) / u.squaredNorm(), T(0), T(1));
  }
  const Vector on_a = p + t * u;
  return {on_a, on_a + axis.gap * axis.normal,
          FeatureKey(FeatureKey::Kind::edge_edge, axis.a, axis.b)};
}

/// The nearest points of the hull of the simplex, each with its weights there.
template <std::floating_point T>
Witness<typename Space<3, T>::Vector> witness_of_simplex(const PolyhedronPair<T>& pair,
                                                         const Simplex<T>& simplex) {
  using Vector = typename Space<3, T>::Vector;
  const std::array<T, 3> weight = weights_of(simplex);
  Witness<Vector> witness{Vector::Zero(), Vector::Zero(), FeatureKey()};
  for (int i = 0; i < simplex.size(); ++i) {
    const T w = weight[static_cast<std::size_t>(i)];
    witness.a += w * pair.a.vertices()[simplex[i].a];
    witness.b += w * (pair.b.vertices()[simplex[i].b] + pair.offset);
  }
  witness.feature = FeatureKey(FeatureKey::Kind::vertex_vertex, simplex[0].a, simplex[0].b);
  return witness;
}

/// For a face axis: the deepest vertex and its foot on the face's plane.
template <std::floating_point T>
Witness<typename Space<3, T>::Vector> witness_of_face(const PolyhedronPair<T>& pair,
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

/// Of a vertex and a vertex or edge.
template <std::floating_point T>
Witness<typename Space<3, T>::Vector> witness_of_vertex(const PolyhedronPair<T>& pair,
                                                        const Axis<Space<3, T>>& axis) {
  using Kind = FeatureKey::Kind;
  const auto [on_a, on_b] = nearest_of(pair, axis.kind, axis.a, axis.b);
  const Kind kind = axis.kind == AxisKind::vertices      ? Kind::vertex_vertex
                    : axis.kind == AxisKind::vertex_edge ? Kind::vertex_edge
                                                         : Kind::edge_vertex;
  return {on_a, on_b, FeatureKey(kind, axis.a, axis.b)};
}

/// The nearest points of a pair whose axis is known.
/// @param simplex  of the distance algorithm; read only for an axis of kind nearest_points
template <std::floating_point T>
Witness<typename Space<3, T>::Vector> witness_of(const PolyhedronPair<T>& pair,
                                                 const Axis<Space<3, T>>& axis,
                                                 const Simplex<T>* simplex) {
  switch (axis.kind) {
    case AxisKind::face_a:
    case AxisKind::face_b:
      return witness_of_face(pair, axis);
    case AxisKind::edges:
      return witness_of_edges(pair, axis);
    case AxisKind::nearest_points:
      return witness_of_simplex(pair, *simplex);
    default:
      return witness_of_vertex(pair, axis);
  }
}

}  // namespace moreau::detail
