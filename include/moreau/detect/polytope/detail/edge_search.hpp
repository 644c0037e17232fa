// SPDX-License-Identifier: MIT
// Which edges of two polyhedra can make the separating axis, and where two edges are nearest.
//
// A pair of edges counts only if their arcs in the Gauss map cross (crossing_normal in
// feature_axis.hpp): only then is their common normal that of a face of B - A. Most edges are ruled
// out without looking at pairs. A direction on the arc of an edge of A is n = x n1 + y n2, where n1
// and n2 are the normals of the edge's faces, x, y >= 0 and, because |n| = 1, x + y >= 1. For any q
// in B at heights u1, u2 above the planes of the two faces, s(n) <= x u1 + y u2. If both heights
// are at most some t <= 0, then s(n) <= t. So an edge is ruled out as soon as one point of B lies
// that deep below both of its faces.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/polytope/detail/face_search.hpp"

namespace moreau::detail {

/// The edges of a shape that no point of the other shape rules out.
/// @param below  for each face, the points of the other shape that are at most at a level t <= 0
///               above it [m]; the edges that are left out do not separate by more than t
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

/// Where the lines of two edges are nearest to each other, as fractions of the edges: {on a, on b}.
/// @param apart   from the start of a's edge to the start of b's edge, world axes [m]
/// @param normal  common normal of the edges, unit, from a to b
template <std::floating_point T>
std::array<T, 2> nearest_parameters(const EdgeView<T>& a, const EdgeView<T>& b,
                                    const typename Space<3, T>::Vector& apart,
                                    const typename Space<3, T>::Vector& normal) {
  const auto across = normal.cross(b.direction).eval();
  const T scale = a.direction.dot(across);
  return {apart.dot(across) / scale, apart.dot(normal.cross(a.direction)) / scale};
}
/// Whether the nearest points of the two lines lie within both edges.
/// @param beyond  fraction of an edge by which the point may lie beyond the edge's end [-]
template <std::floating_point T>
bool nearest_points_are_within(const EdgeView<T>& a, const EdgeView<T>& b,
                               const typename Space<3, T>::Vector& apart,
                               const typename Space<3, T>::Vector& normal, T beyond = 0) {
  const auto [t, u] = nearest_parameters(a, b, apart, normal);
  return t >= -beyond && t <= T(1) + beyond && u >= -beyond && u <= T(1) + beyond;
}
/// The height [m] of b's edge above a's edge along the normal, where the edges are nearest to each
/// other. There an error of the normal changes the height in second order only, elsewhere in first
/// order.
template <std::floating_point T>
T height_at_nearest(const EdgeView<T>& a, const EdgeView<T>& b,
                    const typename Space<3, T>::Vector& apart,
                    const typename Space<3, T>::Vector& normal) {
  const auto [t, u] = nearest_parameters(a, b, apart, normal);
  const auto on_b = along(apart, std::clamp(u, T(0), T(1)), b.direction);
  return normal.dot(along(on_b, -std::clamp(t, T(0), T(1)), a.direction));
}

}  // namespace moreau::detail
