// SPDX-License-Identifier: MIT
// The pair of edges of two polyhedra that separates them best.
//
// A pair counts if the arcs of the two edges in the Gauss map (from the normal of one face beside
// the edge to that of the other; reversed for B) cross: only then is their common normal one of a
// face of B - A. Few edges can take part. A direction on the arc of an edge of A is n = x n1 + y n2
// with x, y >= 0 and, because |n| = 1, x + y >= 1. For any q in B at heights u1, u2 above the two
// faces, s(n) <= x u1 + y u2. If both heights are at most some t <= 0, then so is s(n): the edge is
// out as soon as one point of B lies that deep below both of its faces.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/detail/face_search.hpp"

namespace moreau::detail {

/// The edges of a shape that no point rules out.
/// @param below  for each face, the points of the other shape at most `level` (<= 0) above it; no
///               other edge can separate by more than that level
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

/// An edge as the crossing test reads it, relative to the centre of its shape.
template <std::floating_point T>
struct EdgeView {
  using Vector = typename Space<3, T>::Vector;
  Vector from, direction, normal_0, normal_1;

  EdgeView(const Placed<Polyhedron<T>>& shape, std::uint32_t id) {
    const auto& edge = shape.shape().edges()[id];
    from = shape.vertices()[edge.vertex[0]];
    direction = shape.vertices()[edge.vertex[1]] - from;
    normal_0 = shape.normals()[edge.face[0]];
    normal_1 = shape.normals()[edge.face[1]];
  }
};

/// The common normal of two edges, from a to b, if their arcs cross. The plane of directions
/// perpendicular to one edge then parts the ends of the other's arc; of the two directions
/// perpendicular to both edges one is on the arc of a and one on the reversed arc of b, and they
/// are the same.
template <std::floating_point T>
bool crossing_normal(const EdgeView<T>& a, const EdgeView<T>& b,
                     typename Space<3, T>::Vector& normal) {
  if (a.direction.dot(b.normal_0) * a.direction.dot(b.normal_1) >= T(0)) return false;
  if (b.direction.dot(a.normal_0) * b.direction.dot(a.normal_1) >= T(0)) return false;
  // Edges more parallel than this differ from a face axis by no more than rounding.
  constexpr T parallel = T(16) * std::numeric_limits<T>::epsilon();
  normal = a.direction.cross(b.direction);
  const T length2 = normal.squaredNorm();
  if (!(length2 > parallel * parallel * a.direction.squaredNorm() * b.direction.squaredNorm()))
    return false;
  const T length = std::sqrt(length2);
  normal /= normal.dot(a.normal_0 + a.normal_1) < T(0) ? -length : length;
  return normal.dot(b.normal_0 + b.normal_1) < T(0);
}

/// Whether edges are so parallel that their common normal has lost digits.
template <std::floating_point T>
bool are_nearly_parallel(const EdgeView<T>& a, const EdgeView<T>& b) {
  return a.direction.cross(b.direction).squaredNorm() <=
         T(1e-4) * a.direction.squaredNorm() * b.direction.squaredNorm();
}

/// Where two lines are nearest to each other, as a fraction of each edge: {on a, on b}.
/// @param apart   from the start of a's edge to that of b's
template <std::floating_point T>
std::array<T, 2> nearest_parameters(const EdgeView<T>& a, const EdgeView<T>& b,
                                    const typename Space<3, T>::Vector& apart,
                                    const typename Space<3, T>::Vector& normal) {
  const auto across = normal.cross(b.direction).eval();
  const T scale = a.direction.dot(across);
  return {apart.dot(across) / scale, apart.dot(normal.cross(a.direction)) / scale};
}
/// Whether the nearest points of the two lines lie within both edges.
template <std::floating_point T>
bool nearest_points_are_within(const EdgeView<T>& a, const EdgeView<T>& b,
                               const typename Space<3, T>::Vector& apart,
                               const typename Space<3, T>::Vector& normal, T beyond = 0) {
  const auto [t, u] = nearest_parameters(a, b, apart, normal);
  return t >= -beyond && t <= T(1) + beyond && u >= -beyond && u <= T(1) + beyond;
}
/// The height of b's edge above a's at their feet: there an error of the normal counts in second
/// order only, elsewhere in first.
template <std::floating_point T>
T height_at_nearest(const EdgeView<T>& a, const EdgeView<T>& b,
                    const typename Space<3, T>::Vector& apart,
                    const typename Space<3, T>::Vector& normal) {
  const auto [t, u] = nearest_parameters(a, b, apart, normal);
  return normal.dot(apart + std::clamp(u, T(0), T(1)) * b.direction -
                    std::clamp(t, T(0), T(1)) * a.direction);
}

/// The common normal of two edges and the separation of their end points along it. One function for
/// the search and for what is remembered, so that both give the same bits.
/// @param offset  centre of b minus centre of a
/// @returns whether the arcs of the edges cross
template <std::floating_point T>
[[gnu::noinline]] bool measure_edges(const EdgeView<T>& a, const EdgeView<T>& b,
                                     const typename Space<3, T>::Vector& offset,
                                     Axis<Space<3, T>>& axis) {
  if (!crossing_normal(a, b, axis.normal)) return false;
  const T top = std::max(axis.normal.dot(a.from), axis.normal.dot(a.from + a.direction));
  const T bottom = std::min(axis.normal.dot(b.from), axis.normal.dot(b.from + b.direction));
  axis.gap = axis.normal.dot(offset) + (bottom - top);
  return true;
}

}  // namespace moreau::detail
