// SPDX-License-Identifier: MIT
// Whether a point projects onto a face of a polytope: whether its orthogonal projection onto the
// plane of the face lies inside the face. The faces of a polygon are its edges.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "moreau/detect/placed.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// Whether the projection of a point onto the line of an edge lies inside the edge.
/// @param x           relative to the shape's centre, world axes [m]
/// @param clearance2  square of the smallest allowed distance of the projection from both ends
///                    [m^2]
template <std::floating_point T>
bool projects_within(const Placed<Polygon<T>>& shape, std::size_t edge,
                     const typename Space<2, T>::Vector& x, T clearance2) {
  using Vector = typename Space<2, T>::Vector;
  const std::size_t next = edge + 1 < shape.vertices().size() ? edge + 1 : 0;
  const Vector from = shape.vertices()[edge];
  const Vector along = shape.vertices()[next] - from;
  const T t = along.dot(x - from), length2 = along.squaredNorm();
  const T inside =
      std::min(t, length2 - t);  // distance from the nearer end times the length of the edge [m^2]
  return inside >= T(0) && inside * inside >= clearance2 * length2;
}

/// Whether the projection of a point onto the plane of a face lies inside the face.
/// @param x           relative to the shape's centre, world axes [m]
/// @param clearance2  square of the smallest allowed distance of the projection from the rim of the
///                    face [m^2]
template <std::floating_point T>
bool projects_within(const Placed<Polyhedron<T>>& shape, std::size_t face,
                     const typename Space<3, T>::Vector& x, T clearance2) {
  using Vector = typename Space<3, T>::Vector;
  const auto loop = shape.shape().face(face);
  const Vector normal = shape.normals()[face];
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector from = shape.vertices()[loop[k]];
    const Vector along = shape.vertices()[loop[k + 1 < loop.size() ? k + 1 : 0]] - from;
    const T inside = normal.cross(along).dot(x - from);  // distance of the projection from the edge
                                                         // times the edge's length
    if (inside < T(0) || inside * inside < clearance2 * along.squaredNorm()) return false;
  }
  return true;
}

/// The square of the distance of the projection of a point onto a face from the rim of the face [m^2]; -1 if the
/// projection lies outside.
/// @param x  relative to the shape's centre, world axes [m]
template <std::floating_point T>
T rim_distance2(const Placed<Polygon<T>>& shape, std::size_t edge,
                const typename Space<2, T>::Vector& x) {
  using Vector = typename Space<2, T>::Vector;
  const std::size_t next = edge + 1 < shape.vertices().size() ? edge + 1 : 0;
  const Vector from = shape.vertices()[edge];
  const Vector along = shape.vertices()[next] - from;
  const T t = along.dot(x - from), length2 = along.squaredNorm();
  const T inside = std::min(t, length2 - t);
  return inside < T(0) ? T(-1) : inside * inside / length2;
}
template <std::floating_point T>
T rim_distance2(const Placed<Polyhedron<T>>& shape, std::size_t face,
                const typename Space<3, T>::Vector& x) {
  using Vector = typename Space<3, T>::Vector;
  const auto loop = shape.shape().face(face);
  const Vector normal = shape.normals()[face];
  T least = std::numeric_limits<T>::infinity();
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector from = shape.vertices()[loop[k]];
    const Vector along = shape.vertices()[loop[k + 1 < loop.size() ? k + 1 : 0]] - from;
    const T inside = normal.cross(along).dot(x - from);
    if (inside < T(0)) return T(-1);
    least = std::min(least, inside * inside / along.squaredNorm());
  }
  return least;
}

/// Whether the projection of a point lies inside a face, at least `clearance` [m] from its rim.
/// @param x  relative to the shape's centre, world axes [m]
template <class ShapeT>
bool projects_onto(const Placed<ShapeT>& shape, std::size_t face,
                   const typename Placed<ShapeT>::Vector& x,
                   typename Placed<ShapeT>::Scalar clearance = 0) {
  return projects_within(shape, face, x, clearance * clearance);
}

}  // namespace moreau::detail
