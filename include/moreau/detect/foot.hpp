// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/detect/placed.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// Whether the foot of the perpendicular from the point, relative to the centre, is within the
/// edge.
template <std::floating_point T>
bool has_foot(const Placed<Polygon<T>>& shape, std::size_t edge,
              const typename Space<2, T>::Vector& x) {
  using Vector = typename Space<2, T>::Vector;
  const std::size_t next = edge + 1 < shape.vertices().size() ? edge + 1 : 0;
  const Vector from = shape.vertices()[edge];
  const Vector along = shape.vertices()[next] - from;
  const T t = along.dot(x - from);
  return t >= T(0) && t <= along.squaredNorm();
}

/// Whether the foot of the perpendicular from the point, relative to the centre, is
/// within the face.
template <std::floating_point T>
bool has_foot(const Placed<Polyhedron<T>>& shape, std::size_t face,
              const typename Space<3, T>::Vector& x) {
  using Vector = typename Space<3, T>::Vector;
  const auto loop = shape.shape().face(face);
  const Vector normal = shape.normals()[face];
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector from = shape.vertices()[loop[k]];
    const Vector along = shape.vertices()[loop[k + 1 < loop.size() ? k + 1 : 0]] - from;
    if (normal.cross(along).dot(x - from) < T(0)) return false;
  }
  return true;
}

}  // namespace moreau::detail
