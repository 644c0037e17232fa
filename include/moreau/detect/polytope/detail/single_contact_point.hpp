// SPDX-License-Identifier: MIT
// Pairs of polytopes that touch at a single contact point, recognised without the overlap of two
// faces, which costs more.
//
// Let `slab` be the height up to which surfaces count as in contact, beyond the gap of the point.
//
// A vertex on a face. The shape of the vertex lies in the cone of the edges at the vertex. If these
// edges all rise through the slab, the part of the shape within the slab lies between the points
// where the edges leave it, at a lateral distance from the vertex of at most slab * length / rise.
// If the projection of the vertex is farther than that from the rim of the face, the face and this
// part meet in nothing else.
//
// Two faces. The gap between them is linear over their overlap. So the lowest corner of the overlap
// is the only one within the slab if its two neighbours are not. These lie along the two edges that
// leave the corner: those of a vertex's face, or the two edges that cross. Each edge has to rise
// through the slab before it ends and before it leaves the other face.
#pragma once

#include <algorithm>
#include <limits>

#include "moreau/detect/polytope/detail/feature_axis.hpp"
#include "moreau/detect/polytope/facing_features.hpp"
#include "moreau/detect/polytope/projection.hpp"

namespace moreau::detail {

/// Whether a vertex on a face is the only point of the two shapes within the slab.
/// @param up    unit normal of the face, towards the shape of the vertex, world axes
/// @param apex  the vertex relative to the centre of the face's shape, world axes [m]
/// @param slab  height above the face [m]
/// @param near  length below which two points are one [m]
template <class ShapeT, class Vector, class T>
bool touches_only_at_vertex(const Placed<ShapeT>& shape, std::uint32_t vertex, const Vector& up,
                            const Placed<ShapeT>& ground, std::uint32_t face, const Vector& apex,
                            T slab, T near) {
  const T spread2 = shape.vertices().spread2(shape.vertices()[vertex], up, slab);
  return spread2 < std::numeric_limits<T>::infinity() &&
         projects_within(ground, face, apex, T(2) * (slab * slab * spread2 + near * near));
}

/// The same for the vertex and the face that make an axis; false for other axes.
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

/// Whether a vertex is the only corner within the slab of the overlap of two faces: one at the
/// vertex and one of the other shape. It holds for more pairs than the test above, once the faces
/// are known.
/// @param own   number of the face at the vertex
/// @param face  number of the other shape's face
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
  return projects_within(ground, face, apex, near * near) &&
         leaves(loop[at + 1 < loop.size() ? at + 1 : 0]) &&
         leaves(loop[(at > 0 ? at : loop.size()) - 1]);
}

/// Whether an edge of one shape leaves the slab above a face of the other shape before the edge
/// ends and while it is above that face. Measured along `up`, the edge is level.
/// @param crossing   where the edge crosses the highest edge of the face, on that edge, relative to
///                   the centre of the face's shape, world axes [m]
/// @param part       where that is on the edge: 0 at its start, 1 at its end
/// @param direction  from the start of the edge to its end, world axes [m]
/// @param up         unit, from the face's shape to the shape of the edge, world axes
/// @param near2      square of the length below which two points are one [m^2]
template <std::floating_point T>
bool leaves_slab(const Placed<Polyhedron<T>>& ground, std::uint32_t face,
                 const typename Space<3, T>::Vector& crossing, T part,
                 const typename Space<3, T>::Vector& direction,
                 const typename Space<3, T>::Vector& up, T slab, T near2) {
  using Vector = typename Space<3, T>::Vector;
  const Vector normal = ground.normals()[face];
  // To where the face is lower by the slab.
  const T step = slab * normal.dot(up) / normal.dot(direction);
  const Vector below = crossing + step * direction - slab * up;
  return part + step > T(0) && part + step < T(1) && projects_within(ground, face, below, near2);
}

/// Whether the crossing of two edges is the only corner within the slab of the overlap of two
/// faces, one at each edge.
/// @param axis  of kind edges
/// @param near  length below which two points are one [m]
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

/// Whether the overlap of the facing faces of two polyhedra has one corner within the slab.
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

/// The overlap of two edges of polygons costs no more than such a test.
template <std::floating_point T>
bool touches_at_one_corner(const PolytopePair<Polygon<T>>&, const Axis<Space<2, T>>&,
                           const FacingFeatures&, T, T) {
  return false;
}

}  // namespace moreau::detail
