// SPDX-License-Identifier: MIT
// Which pairs of edges of two polyhedra can make the separating axis, and where two edges are
// nearest to each other.
//
// The set B - A of all differences b - a is a polytope. The common normal of two edges is the
// normal of a face of B - A only if the arcs of the two edges in the Gauss map cross
// (crossing_normal in feature_axis.hpp). No other pairs of edges need to be examined.
//
// Most edges are ruled out one by one, before pairs are formed. A unit vector on the arc of an edge
// of A is n = x n1 + y n2, where n1 and n2 are the unit normals of the two faces at the edge, x, y
// >= 0 and, because |n| = 1, x + y >= 1. Let q be any point of B, and u1, u2 its heights above the
// planes of the two faces. Then the separation along n (axis.hpp) is s(n) <= x u1 + y u2. If both
// heights are at most t, and t <= 0, then s(n) <= t. So an edge cannot separate by more than t if
// one point of B lies at least -t deep below both faces at the edge.
#pragma once

#include <algorithm>
#include <array>

#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/polytope/detail/face_search.hpp"

namespace moreau::detail {

/// The edges of a shape that no point of the other shape rules out.
/// @param below  for each face, the points of the other shape whose height above the face is at
///               most t <= 0 [m]. No edge that is ruled out separates the shapes by more than t
template <std::floating_point T>
ShortList edges_left(const Placed<Polyhedron<T>>& shape, const FaceMasks<T>& below) {
  const auto edges = shape.shape().edges();
  ShortList left(edges.size());
  const auto collect = [&](const auto& masks) {
    for (std::size_t e = 0; e < edges.size(); ++e)
      if ((masks[edges[e].face[0]] & masks[edges[e].face[1]]) == 0)
        left.add(static_cast<std::uint32_t>(e));
  };
  if (below.stored() != nullptr)
    collect(below.stored());
  else
    collect(below);
  return left;
}

/// The positions at which the lines of two edges are nearest to each other: {on a, on b}, each as a
/// fraction of its edge [-], 0 at the start and 1 at the end.
/// @param apart   from the start of a's edge to the start of b's edge, world axes [m]
/// @param normal  common normal of the edges, unit, from a to b, world axes
template <std::floating_point T>
std::array<T, 2> nearest_parameters(const EdgeView<T>& a, const EdgeView<T>& b,
                                    const typename Space<3, T>::Vector& apart,
                                    const typename Space<3, T>::Vector& normal) {
  const auto across = normal.cross(b.direction).eval();
  const T scale = a.direction.dot(across);
  return {apart.dot(across) / scale, apart.dot(normal.cross(a.direction)) / scale};
}
/// Whether the nearest points of the two lines lie within both edges.
/// @param beyond  fraction of an edge by which the point may lie outside of the edge [-]
template <std::floating_point T>
bool nearest_points_are_within(const EdgeView<T>& a, const EdgeView<T>& b,
                               const typename Space<3, T>::Vector& apart,
                               const typename Space<3, T>::Vector& normal, T beyond = 0) {
  const auto [t, u] = nearest_parameters(a, b, apart, normal);
  return t >= -beyond && t <= T(1) + beyond && u >= -beyond && u <= T(1) + beyond;
}
/// The height [m] of b's edge above a's edge along the normal, at the points where the edges are
/// nearest to each other. At these points an error of the normal changes the height only in second
/// order; at any other points it would change the height in first order.
template <std::floating_point T>
T height_at_nearest(const EdgeView<T>& a, const EdgeView<T>& b,
                    const typename Space<3, T>::Vector& apart,
                    const typename Space<3, T>::Vector& normal) {
  const auto [t, u] = nearest_parameters(a, b, apart, normal);
  const auto on_b = along(apart, std::clamp(u, T(0), T(1)), b.direction);
  return normal.dot(along(on_b, -std::clamp(t, T(0), T(1)), a.direction));
}

}  // namespace moreau::detail
