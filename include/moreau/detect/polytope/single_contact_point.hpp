// SPDX-License-Identifier: MIT
// Contacts of which it can be told without the overlap of two faces that they are one point.
//
// Let `slab` be the height up to which surfaces count as in contact, beyond the gap of the point.
//
// A vertex on a face: the vertex's shape lies in the cone of the edges at the vertex. Where they
// all rise through the slab, what is in it lies within the points where they leave it, at a lateral
// distance from the vertex of at most slab * length / rise. If the foot of the vertex is farther
// than that from the rim of the face, the face and the slab's content meet in nothing else.
//
// Of two faces the distance is linear where they overlap, and so no corner of the overlap but the
// lowest is in the slab if the two next to it are not. These lie along the two edges that leave it:
// of a vertex's face, or the two that cross. Each has to rise through the slab before it ends and
// before it leaves the other face.
#pragma once

#include <algorithm>
#include <limits>

#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/detail/edge_search.hpp"
#include "moreau/detect/polytope/polyhedron_pair.hpp"
#include "moreau/detect/polytope/projection.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// Whether a vertex on a face is the only point of the two shapes within the slab.
/// @param up    unit normal of the face, towards the shape of the vertex
/// @param foot  the vertex relative to the centre of the face's shape [m]
/// @param near  length below which points are one [m]
template <class ShapeT, class Vector, class T>
bool touches_only_at_vertex(const Placed<ShapeT>& shape, std::uint32_t vertex, const Vector& up,
                            const Placed<ShapeT>& ground, std::uint32_t face, const Vector& foot,
                            T slab, T near) {
  const T spread2 = shape.vertices().spread2(shape.vertices()[vertex], up, slab);
  return spread2 < std::numeric_limits<T>::infinity() &&
         projects_within(ground, face, foot, T(2) * (slab * slab * spread2 + near * near));
}

/// The same of the vertex and the face that make an axis; false for other axes.
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

/// The same of a vertex's face and another face; catches more, once the faces are known.
/// @param own  a face at the vertex
template <std::floating_point T>
bool touches_only_at_corner(const Placed<Polyhedron<T>>& shape, std::uint32_t vertex,
                            std::uint32_t own, const typename Space<3, T>::Vector& up,
                            const Placed<Polyhedron<T>>& ground, std::uint32_t face,
                            const typename Space<3, T>::Vector& foot, T slab, T near) {
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
           projects_within(ground, face, Vector(foot + slab / rise * along), near * near);
  };
  return projects_within(ground, face, foot, near * near) &&
         leaves(loop[at + 1 < loop.size() ? at + 1 : 0]) &&
         leaves(loop[(at > 0 ? at : loop.size()) - 1]);
}

/// Whether the edge of one shape, level, leaves the slab above a face of the other before it ends
/// and while it is above that face.
/// @param crossing   where it crosses the face's highest edge, on that edge, relative to the centre
/// of
///                   the face's shape [m]
/// @param part       where that is on the edge: 0 at its start, 1 at its end
/// @param direction  from its start to its end [m]
/// @param up         unit, from the face's shape to that of the edge
template <std::floating_point T>
bool leaves_slab(const Placed<Polyhedron<T>>& ground, std::uint32_t face,
                 const typename Space<3, T>::Vector& crossing, T part,
                 const typename Space<3, T>::Vector& direction,
                 const typename Space<3, T>::Vector& up, T slab, T near2) {
  using Vector = typename Space<3, T>::Vector;
  const Vector normal = ground.normals()[face];
  const T step = slab * normal.dot(up) / normal.dot(direction);  // to where the face is slab lower
  const Vector below = crossing + step * direction - slab * up;
  return part + step > T(0) && part + step < T(1) && projects_within(ground, face, below, near2);
}

/// Whether the crossing of two edges is the only point of two faces beside them within the slab.
/// @param axis  of kind edges
/// @param near  length below which points are one [m]
template <std::floating_point T>
bool touches_only_at_crossing(const PolyhedronPair<T>& pair, const Axis<Space<3, T>>& axis,
                              std::uint32_t face_a, std::uint32_t face_b, T slab, T near) {
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
         leaves_slab(pair.b, face_b, Vector(b.from + on_b * b.direction), on_a, a.direction,
                     Vector(-axis.normal), slab, near2) &&
         leaves_slab(pair.a, face_a, Vector(a.from + on_a * a.direction), on_b, b.direction,
                     axis.normal, slab, near2);
}

}  // namespace moreau::detail
