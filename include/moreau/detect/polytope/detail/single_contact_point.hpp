// SPDX-License-Identifier: MIT
// Tests whether two polytopes touch at a single contact point. These tests cost less than computing
// the overlap of two faces.
//
// Surfaces count as in contact where the gap is at most the margin. Let `slab` be the margin minus
// the smallest gap. Then only points that lie at most `slab` above the lowest point matter.
//
// A vertex on a face. The shape of the vertex lies in the cone spanned by the edges at the vertex.
// Suppose that each of these edges rises by more than `slab`. An edge of a given length that rises
// by `rise` leaves the slab at a lateral distance of at most slab * length / rise from the vertex.
// The largest of these distances bounds the part of the shape in the slab. For polyhedra the code
// takes the largest over all vertices of the shape, which is a bound as well. If the projection of
// the vertex is farther than that from the rim of the face, this part does not reach the rim, and
// the vertex is the only contact point.
//
// Two faces. The gap between them is a linear function over their overlap, which is a polygon. So
// the lowest corner of the overlap is the only corner in the slab if its two neighbours are not in
// the slab. The neighbours lie along the two edges that leave the corner. If the corner is a
// vertex, they are the edges of the face at this vertex; if it is a crossing, they are the two
// edges that cross. Each of these edges must rise through the slab before it ends and before it
// leaves the other shape's face.
#pragma once

#include <algorithm>
#include <limits>

#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/polytope/detail/feature_axis.hpp"
#include "moreau/detect/polytope/facing_features.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

/// The square of the largest ratio of distance to rise from a vertex along the edges at it, or from
/// it to all other vertices [-]. Infinite if one of them rises by `least` [m] or less.
template <std::floating_point T>
T spread2(const Placed<Polyhedron<T>>& shape, std::uint32_t vertex,
          const typename Space<3, T>::Vector& up, T least) {
  return shape.vertices().spread2(shape.vertices()[vertex], up, least);
}
template <std::floating_point T>
T spread2(const Placed<Polygon<T>>& shape, std::uint32_t vertex,
          const typename Space<2, T>::Vector& up, T least) {
  using Vector = typename Space<2, T>::Vector;
  T widest = 0;
  for (const std::uint32_t w : neighbours(shape, vertex)) {
    const Vector along = shape.vertices()[w] - shape.vertices()[vertex];
    const T rise = up.dot(along);
    if (!(rise > least)) return std::numeric_limits<T>::infinity();
    widest = std::max(widest, along.squaredNorm() / (rise * rise));
  }
  return widest;
}

/// Whether a vertex above a face is the only point of the contact.
/// @param up    unit normal of the face, towards the shape of the vertex, world axes
/// @param apex  the vertex relative to the centre of `ground`, the face's shape, world axes [m]
/// @param slab  height of the slab above the vertex, along `up` [m]
/// @param near  two points closer together than this count as one point [m]
template <class ShapeT, class Vector, class T>
bool touches_only_at_vertex(const Placed<ShapeT>& shape, std::uint32_t vertex, const Vector& up,
                            const Placed<ShapeT>& ground, std::uint32_t face, const Vector& apex,
                            T slab, T near) {
  const T widest2 = spread2(shape, vertex, up, slab);
  return widest2 < std::numeric_limits<T>::infinity() &&
         projects_within(ground, face, apex, T(2) * (slab * slab * widest2 + near * near));
}

/// Whether the vertex and the face that make the axis touch only at the vertex. False if the axis
/// is made by other features.
/// @param pair  of polygons or polyhedra
template <class Pair, class S>
bool touches_only_at_vertex(const Pair& pair, const Axis<S>& axis, typename S::Scalar slab,
                            typename S::Scalar near) {
  using Vector = typename S::Vector;
  if (axis.kind == AxisKind::face_a)
    return touches_only_at_vertex(pair.b, axis.b, axis.normal, pair.a, axis.a,
                                  Vector(pair.b.vertices()[axis.b] + pair.offset), slab, near);
  return axis.kind == AxisKind::face_b &&
         touches_only_at_vertex(pair.a, axis.a, Vector(-axis.normal), pair.b, axis.b,
                                Vector(pair.a.vertices()[axis.a] - pair.offset), slab, near);
}

/// Whether a vertex is the only corner in the slab of the overlap of two faces: face `own`, which
/// has the vertex, and face `face` of the other shape `ground`. If the faces are known, this test
/// succeeds for more pairs than touches_only_at_vertex.
/// @param own   index of the face at the vertex
/// @param face  index of the other shape's face
template <std::floating_point T>
bool touches_only_at_corner(const Placed<Polyhedron<T>>& shape, std::uint32_t vertex,
                            std::uint32_t own, const typename Space<3, T>::Vector& up,
                            const Placed<Polyhedron<T>>& ground, std::uint32_t face,
                            const typename Space<3, T>::Vector& apex, T slab, T near) {
  using Vector = typename Space<3, T>::Vector;
  const auto loop = shape.shape().face(own);
  const auto at =
      static_cast<std::size_t>(std::find(loop.begin(), loop.end(), vertex) - loop.begin());
  if (at == loop.size()) return false;
  const Vector from = shape.vertices()[vertex];
  const auto leaves = [&](std::uint32_t w) {
    const Vector along = shape.vertices()[w] - from;
    const T rise = up.dot(along);
    return rise > slab &&
           projects_within(ground, face, Vector(apex + slab / rise * along), near * near);
  };
  return leaves(loop[at + 1 < loop.size() ? at + 1 : 0]) &&
         leaves(loop[(at > 0 ? at : loop.size()) - 1]) &&
         projects_within(ground, face, apex, near * near);
}

/// Whether an edge of one shape leaves the slab above a face of `ground`, the other shape, before
/// the edge ends and while it is above that face. The edge is perpendicular to `up`. It begins to
/// rise above the face where it crosses, seen along `up`, the highest edge of the face.
/// @param crossing   the point of the face's highest edge at which the edge crosses it, relative to
///                   the centre of `ground`, world axes [m]
/// @param part       position of the crossing on the edge [-]: 0 at its start, 1 at its end
/// @param direction  from the start of the edge to its end, world axes [m]
/// @param up         unit vector from `ground` to the shape of the edge, world axes
/// @param near2      square of the distance below which two points count as one point [m^2]
template <std::floating_point T>
bool leaves_slab(const Placed<Polyhedron<T>>& ground, std::uint32_t face,
                 const typename Space<3, T>::Vector& crossing, T part,
                 const typename Space<3, T>::Vector& direction,
                 const typename Space<3, T>::Vector& up, T slab, T near2) {
  using Vector = typename Space<3, T>::Vector;
  const Vector normal = ground.normals()[face];
  // Signed fraction of the edge over which the gap to the face grows by the slab.
  const T step = slab * normal.dot(up) / normal.dot(direction);
  const Vector below = along(along(crossing, step, direction), -slab, up);
  return part + step > T(0) && part + step < T(1) && projects_within(ground, face, below, near2);
}

/// Whether the crossing of two edges is the only corner in the slab of the overlap of two faces.
/// Each face has one of the edges.
/// @param axis  an axis of kind AxisKind::edges
/// @param near  two points closer together than this count as one point [m]
template <std::floating_point T>
bool touches_only_at_crossing(const PolytopePair<Polyhedron<T>>& pair,
                              const Axis<Space<3, T>>& axis, const FacingFeatures& facing, T slab,
                              T near) {
  using Vector = typename Space<3, T>::Vector;
  const EdgeView<T> a(pair.a, axis.a), b(pair.b, axis.b);
  const Vector apart = b.from + pair.offset - a.from, across_a = a.direction.cross(axis.normal),
               across_b = b.direction.cross(axis.normal);
  const T turn = a.direction.dot(across_b);
  const T on_a = apart.dot(across_b) / turn, on_b = apart.dot(across_a) / turn;
  const T near2 = near * near;
  const auto is_within = [&](T part, const Vector& direction) {
    const T inside = std::min(part, T(1) - part);
    return inside > T(0) && inside * inside * direction.squaredNorm() > near2;
  };
  return is_within(on_a, a.direction) && is_within(on_b, b.direction) &&
         leaves_slab(pair.b, facing.b, Vector(b.from + on_b * b.direction), on_a, a.direction,
                     Vector(-axis.normal), slab, near2) &&
         leaves_slab(pair.a, facing.a, Vector(a.from + on_a * a.direction), on_b, b.direction,
                     axis.normal, slab, near2);
}

/// Whether the overlap of the facing faces of two polyhedra has only one corner in the slab.
template <std::floating_point T>
bool touches_at_one_corner(const PolytopePair<Polyhedron<T>>& pair, const Axis<Space<3, T>>& axis,
                           const FacingFeatures& facing, T slab, T near) {
  using Vector = typename Space<3, T>::Vector;
  switch (axis.kind) {
    case AxisKind::face_a:
      return touches_only_at_corner(pair.b, axis.b, facing.b, axis.normal, pair.a, facing.a,
                                    Vector(pair.b.vertices()[axis.b] + pair.offset), slab, near);
    case AxisKind::face_b:
      return touches_only_at_corner(pair.a, axis.a, facing.a, Vector(-axis.normal), pair.b,
                                    facing.b, Vector(pair.a.vertices()[axis.a] - pair.offset), slab,
                                    near);
    case AxisKind::edges:
      return touches_only_at_crossing(pair, axis, facing, slab, near);
    default:
      return false;
  }
}

/// For polygons the test is omitted: to compute the overlap of two edges costs no more than the
/// test.
template <std::floating_point T>
bool touches_at_one_corner(const PolytopePair<Polygon<T>>&, const Axis<Space<2, T>>&,
                           const FacingFeatures&, T, T) {
  return false;
}

}  // namespace moreau::detail
