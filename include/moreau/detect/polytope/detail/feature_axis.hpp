// SPDX-License-Identifier: MIT
// The axis that a given pair of features makes. There are four cases:
//   1. a face of a and a vertex of b
//   2. a vertex of a and a face of b
//   3. two edges
//   4. a vertex, and a vertex or an edge of the other shape
// The search (find_axis.hpp) and the proof of remembered features (prove_axis.hpp) both call these
// functions. The functions are not inlined, so that both callers get the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/polytope_pair.hpp"

namespace moreau::detail {

/// The height of a point above the plane of a face [m].
/// @param point  relative to the shape's centre, world axes [m]
template <class ShapeT>
typename SpaceOf<ShapeT>::Scalar height_above(const Placed<ShapeT>& shape, std::size_t face,
                                              const typename SpaceOf<ShapeT>::Vector& point) {
  return shape.normals()[face].dot(point) - shape.offset(face);
}

/// The separation of two shapes along the normal of a face.
template <std::floating_point T>
struct FaceSeparation {
  T separation;                ///< [m]
  std::uint32_t face, vertex;  ///< index of the face, and of the vertex of the other shape that is
                               ///< deepest below it
  bool is_found;               ///< whether a search found a separation larger than its lower limit
};

/// In place of the index of a vertex: there is none.
inline constexpr std::uint32_t no_guess = std::numeric_limits<std::uint32_t>::max();

/// The vertex farthest along a direction. The guess is returned if both its neighbours are lower by
/// more than rounding: along a convex outline all other vertices are then lower, too.
/// @param guess  index of any vertex, or no_guess
template <std::floating_point T>
std::uint32_t farthest_vertex(const Placed<Polygon<T>>& shape,
                              const typename Space<2, T>::Vector& direction, std::uint32_t guess) {
  if (guess != no_guess) {
    const auto height = [&](std::uint32_t v) { return direction.dot(shape.vertices()[v]); };
    const auto [before, after] = neighbours(shape, guess);
    const T least =
        std::max(height(before), height(after)) + DetectionTolerance<T>::rounding * shape.radius();
    if (height(guess) > least) return guess;
  }
  return shape.vertices().farthest(direction).index;
}
/// For polyhedra the guess is not used: all vertices take no longer than the neighbours of one.
template <std::floating_point T>
std::uint32_t farthest_vertex(const Placed<Polyhedron<T>>& shape,
                              const typename Space<3, T>::Vector& direction, std::uint32_t) {
  return shape.vertices().farthest(direction).index;
}

/// The separation of two shapes along the normal of a face of one of them.
/// @param offset  centre of other minus centre of own, world axes [m]
/// @param guess   index of a vertex of other that may be the deepest, or no_guess
template <class ShapeT>
[[gnu::noinline]] FaceSeparation<typename SpaceOf<ShapeT>::Scalar> measure_face(
    const Placed<ShapeT>& own, std::uint32_t face, const Placed<ShapeT>& other,
    const typename SpaceOf<ShapeT>::Vector& offset, std::uint32_t guess = no_guess) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const Vector normal = own.normals()[face];
  const std::uint32_t vertex = farthest_vertex(other, Vector(-normal), guess);
  return {height_above(own, face, other.vertices()[vertex] + offset), face, vertex, true};
}

/// The axis of a face of a and the vertex of b that is deepest below it.
/// @param guess  index of a vertex of b that may be the deepest, or no_guess
template <class ShapeT>
Axis<SpaceOf<ShapeT>> axis_of_face_a(const PolytopePair<ShapeT>& pair, std::uint32_t face,
                                     std::uint32_t guess = no_guess) {
  const auto found = measure_face(pair.a, face, pair.b, pair.offset, guess);
  return {pair.a.normals()[face], found.separation, AxisKind::face_a, face, found.vertex};
}
/// The axis of a face of b and the vertex of a that is deepest below it.
/// @param guess  index of a vertex of a that may be the deepest, or no_guess
template <class ShapeT>
Axis<SpaceOf<ShapeT>> axis_of_face_b(const PolytopePair<ShapeT>& pair, std::uint32_t face,
                                     std::uint32_t guess = no_guess) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const auto found = measure_face(pair.b, face, pair.a, Vector(-pair.offset), guess);
  return {-pair.b.normals()[face], found.separation, AxisKind::face_b, found.vertex, face};
}

/// An edge and the normals of its two faces. Points are relative to the centre of the edge's shape,
/// world axes [m].
template <std::floating_point T>
struct EdgeView {
  using Vector = typename Space<3, T>::Vector;
  Vector from, direction, normal_0, normal_1;
  std::uint32_t id;

  EdgeView(const Placed<Polyhedron<T>>& shape, std::uint32_t edge_id) : id(edge_id) {
    const auto& edge = shape.shape().edges()[id];
    from = shape.vertices()[edge.vertex[0]];
    direction = shape.vertices()[edge.vertex[1]] - from;
    normal_0 = shape.normals()[edge.face[0]];
    normal_1 = shape.normals()[edge.face[1]];
  }
};

/// Computes the common normal of two edges, unit, from a to b, if their arcs in the Gauss map
/// cross. The arc of an edge of a leads from the normal of one face at the edge to the normal of
/// the other face. For an edge of b the arc is reversed: it connects the negative normals. The arcs
/// cross if both of these hold:
///   1. For each edge, the plane perpendicular to this edge separates the two ends of the other
///      edge's arc. Of the two unit vectors perpendicular to both edges, one then lies on the arc
///      of a and one on the arc of b.
///   2. These two vectors are the same.
/// @returns whether the arcs cross; if not, `normal` has no meaning
template <std::floating_point T>
bool crossing_normal(const EdgeView<T>& a, const EdgeView<T>& b,
                     typename Space<3, T>::Vector& normal) {
  using Vector = typename Space<3, T>::Vector;
  if (a.direction.dot(b.normal_0) * a.direction.dot(b.normal_1) >= T(0)) return false;
  if (b.direction.dot(a.normal_0) * b.direction.dot(a.normal_1) >= T(0)) return false;
  // The common normal of edges more parallel than this equals the normal of a face to rounding.
  constexpr T parallel = T(16) * std::numeric_limits<T>::epsilon();
  normal = a.direction.cross(b.direction);
  const T length2 = normal.squaredNorm();
  if (!(length2 > parallel * parallel * a.direction.squaredNorm() * b.direction.squaredNorm()))
    return false;
  const T length = std::sqrt(length2);
  normal /= normal.dot(Vector(a.normal_0 + a.normal_1)) < T(0) ? -length : length;
  return normal.dot(Vector(b.normal_0 + b.normal_1)) < T(0);
}

/// Whether two edges are so parallel (sine of their angle at most 0.01) that rounding errors of
/// their common normal are large.
template <std::floating_point T>
bool are_nearly_parallel(const EdgeView<T>& a, const EdgeView<T>& b) {
  return a.direction.cross(b.direction).squaredNorm() <=
         T(1e-4) * a.direction.squaredNorm() * b.direction.squaredNorm();
}

/// The axis of two edges: their common normal, and the separation of their end points along it.
/// @param offset  centre of b minus centre of a, world axes [m]
/// @returns nothing if the arcs of the edges in the Gauss map do not cross
template <std::floating_point T>
[[gnu::noinline]] std::optional<Axis<Space<3, T>>> axis_of_edges(
    const EdgeView<T>& a, const EdgeView<T>& b, const typename Space<3, T>::Vector& offset) {
  Axis<Space<3, T>> axis;
  if (!crossing_normal(a, b, axis.normal)) return std::nullopt;
  using Vector = typename Space<3, T>::Vector;
  const Vector end_a = a.from + a.direction, end_b = b.from + b.direction;
  const T top = std::max(axis.normal.dot(a.from), axis.normal.dot(end_a));
  const T bottom = std::min(axis.normal.dot(b.from), axis.normal.dot(end_b));
  axis.gap = axis.normal.dot(offset) + (bottom - top);
  axis.kind = AxisKind::edges;
  axis.a = a.id;
  axis.b = b.id;
  return axis;
}

/// The position at which the line of an edge is nearest to a point, as a fraction of the edge [-]:
/// 0 at its start, 1 at its end, below 0 or above 1 outside of the edge.
/// @param x  relative to the shape's centre, world axes [m]
template <std::floating_point T>
T fraction_along(const Placed<Polyhedron<T>>& shape, std::uint32_t edge,
                 const typename Space<3, T>::Vector& x) {
  using Vector = typename Space<3, T>::Vector;
  const auto& ends = shape.shape().edges()[edge].vertex;
  const Vector from = shape.vertices()[ends[0]];
  const Vector along = shape.vertices()[ends[1]] - from;
  return along.dot(x - from) / along.squaredNorm();
}
/// The point at a fraction of an edge, relative to the shape's centre, world axes [m].
template <std::floating_point T>
typename Space<3, T>::Vector point_along(const Placed<Polyhedron<T>>& shape, std::uint32_t edge,
                                         T fraction) {
  using Vector = typename Space<3, T>::Vector;
  const auto& ends = shape.shape().edges()[edge].vertex;
  const Vector from = shape.vertices()[ends[0]];
  return moreau::along(from, fraction, shape.vertices()[ends[1]] - from);
}

/// The positions of a vertex of polygon a and a vertex of polygon b, relative to the centre of a,
/// world axes [m].
template <std::floating_point T>
std::array<typename Space<2, T>::Vector, 2> nearest_points_of(const PolytopePair<Polygon<T>>& pair,
                                                              AxisKind, std::uint32_t a,
                                                              std::uint32_t b) {
  return {pair.a.vertices()[a], pair.b.vertices()[b] + pair.offset};
}
/// The nearest points of two vertices, or of a vertex and an edge, relative to the centre of a,
/// world axes [m].
template <std::floating_point T>
std::array<typename Space<3, T>::Vector, 2> nearest_points_of(
    const PolytopePair<Polyhedron<T>>& pair, AxisKind kind, std::uint32_t a, std::uint32_t b) {
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

/// The vector between the nearest points of a vertex and an edge, without its component along the edge, which is a
/// rounding error if the nearest point lies between the ends of the edge.
template <std::floating_point T>
typename Space<3, T>::Vector without_rounding_along_edge(
    const PolytopePair<Polyhedron<T>>& pair, AxisKind kind, std::uint32_t a, std::uint32_t b,
    const typename Space<3, T>::Vector& apart) {
  using Vector = typename Space<3, T>::Vector;
  if (kind == AxisKind::vertices) return apart;
  const bool edge_is_of_a = kind == AxisKind::edge_vertex;
  const auto& shape = edge_is_of_a ? pair.a : pair.b;
  const std::uint32_t edge = edge_is_of_a ? a : b;
  const T fraction = fraction_along(shape, edge,
                                    edge_is_of_a ? Vector(pair.b.vertices()[b] + pair.offset)
                                                 : Vector(pair.a.vertices()[a] - pair.offset));
  if (!(fraction > T(0) && fraction < T(1))) return apart;
  const Vector along = EdgeView<T>(shape, edge).direction;
  return apart - apart.dot(along) / along.squaredNorm() * along;
}
/// For polygons there is nothing to remove: edges count as faces.
template <std::floating_point T>
typename Space<2, T>::Vector without_rounding_along_edge(
    const PolytopePair<Polygon<T>>&, AxisKind, std::uint32_t, std::uint32_t,
    const typename Space<2, T>::Vector& apart) {
  return apart;
}

/// The axis of two vertices, or of a vertex and an edge, of shapes that are apart. Its normal is
/// the direction from one nearest point to the other, and its gap is their distance.
template <class ShapeT>
[[gnu::noinline]] Axis<SpaceOf<ShapeT>> axis_of_nearest(const PolytopePair<ShapeT>& pair,
                                                        AxisKind kind, std::uint32_t a,
                                                        std::uint32_t b) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  const auto [on_a, on_b] = nearest_points_of(pair, kind, a, b);
  const Vector apart = without_rounding_along_edge(pair, kind, a, b, Vector(on_b - on_a));
  const auto gap = apart.norm();
  return {apart / gap, gap, kind, a, b};
}

}  // namespace moreau::detail
