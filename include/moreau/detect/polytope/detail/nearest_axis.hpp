// SPDX-License-Identifier: MIT
// The axis of two polyhedra that are apart with a vertex of one nearest to a vertex or an edge of
// the other.
#pragma once

#include <algorithm>
#include <array>

#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/polyhedron_pair.hpp"

namespace moreau::detail {

/// Where on the edge, as a fraction of it, its line is nearest to the point, both relative to the
/// shape's centre; within the edge or not.
template <std::floating_point T>
T fraction_along(const Placed<Polyhedron<T>>& shape, std::uint32_t edge,
                 const typename Space<3, T>::Vector& x) {
  using Vector = typename Space<3, T>::Vector;
  const auto& ends = shape.shape().edges()[edge].vertex;
  const Vector from = shape.vertices()[ends[0]];
  const Vector along = shape.vertices()[ends[1]] - from;
  return along.dot(x - from) / along.squaredNorm();
}

template <std::floating_point T>
typename Space<3, T>::Vector point_along(const Placed<Polyhedron<T>>& shape, std::uint32_t edge,
                                         T fraction) {
  using Vector = typename Space<3, T>::Vector;
  const auto& ends = shape.shape().edges()[edge].vertex;
  const Vector from = shape.vertices()[ends[0]];
  return from + fraction * (shape.vertices()[ends[1]] - from);
}

/// The nearest points of the features, relative to the centre of a.
template <std::floating_point T>
std::array<typename Space<3, T>::Vector, 2> nearest_of(const PolyhedronPair<T>& pair, AxisKind kind,
                                                       std::uint32_t a, std::uint32_t b) {
  using Vector = typename Space<3, T>::Vector;
  if (kind == AxisKind::edge_vertex) {
    const Vector on_b = pair.b.vertices()[b] + pair.offset;
    return {point_along(pair.a, a, std::clamp(fraction_along(pair.a, a, on_b), T(0), T(1))), on_b};
  }
  const Vector on_a = pair.a.vertices()[a];
  if (kind == AxisKind::vertices) return {on_a, pair.b.vertices()[b] + pair.offset};
  const T fraction = fraction_along(pair.b, b, Vector(on_a - pair.offset));
  return {on_a, point_along(pair.b, b, std::clamp(fraction, T(0), T(1))) + pair.offset};
}

/// The distance of the features and its direction. One function for the search and for what is
/// remembered, so that both give the same bits.
template <std::floating_point T>
[[gnu::noinline]] void measure_nearest(const PolyhedronPair<T>& pair, AxisKind kind,
                                       std::uint32_t a, std::uint32_t b, Axis<Space<3, T>>& axis) {
  const auto [on_a, on_b] = nearest_of(pair, kind, a, b);
  const typename Space<3, T>::Vector apart = on_b - on_a;
  const T gap = apart.norm();
  axis = {apart / gap, gap, kind, a, b};
}

/// What the nearest points of a simplex lie on; `nearest_points` if not on a vertex and an edge.
/// @param axis  an Axis or a PairCache: what has a kind and the features' numbers
template <std::floating_point T>
void name_features(const PolyhedronPair<T>& pair, const Simplex<T>& simplex, auto& axis) {
  axis.kind = AxisKind::nearest_points;
  axis.a = simplex[0].a;
  axis.b = simplex[0].b;
  if (simplex.size() == 1) {
    axis.kind = AxisKind::vertices;
  } else if (simplex.size() == 2) {
    if (simplex[1].b == axis.b && find_edge(pair.a, axis.a, simplex[1].a, axis.a))
      axis.kind = AxisKind::edge_vertex;
    else if (simplex[1].a == axis.a && find_edge(pair.b, axis.b, simplex[1].b, axis.b))
      axis.kind = AxisKind::vertex_edge;
  }
}

/// The same of the nearest points of three: a face and a vertex, or an edge of each. A guess: the
/// face is the one that is turned most towards the other shape.
template <std::floating_point T>
void name_facet(const PolyhedronPair<T>& pair, const Simplex<T>& simplex,
                PairCache<Space<3, T>>& guess) {
  const auto &p = simplex[0], &q = simplex[1], &r = simplex[2];
  if (p.b == q.b && p.b == r.b) {
    guess.kind = AxisKind::face_a;
    guess.a = pair.a.normals().farthest(simplex.direction()).index;
  } else if (p.a == q.a && p.a == r.a) {
    guess.kind = AxisKind::face_b;
    guess.b = pair.b.normals().farthest(-simplex.direction()).index;
  } else if (find_edge(pair.a, p.a, p.a == q.a ? r.a : q.a, guess.a) &&
             find_edge(pair.b, p.b, p.b == q.b ? r.b : q.b, guess.b)) {
    guess.kind = AxisKind::edges;
  }
}

}  // namespace moreau::detail
