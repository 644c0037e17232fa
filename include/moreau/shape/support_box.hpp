// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/aabb.hpp"
#include "moreau/core/pose.hpp"

namespace moreau {

/// The smallest box in world axes around a convex shape at a pose [m], computed from support()
/// only. A shape defined by a user can return it from bounding_box().
template <class ShapeT>
Aabb<typename ShapeT::Space> support_box(const ShapeT& shape,
                                         const Pose<typename ShapeT::Space>& pose) {
  using S = typename ShapeT::Space;
  using Vector = typename S::Vector;
  Aabb<S> box;
  for (int axis = 0; axis < S::dim; ++axis) {
    const Vector up = pose.rotation.inverse() * Vector::Unit(axis);
    box.upper[axis] = pose.position[axis] + up.dot(shape.support(up));
    box.lower[axis] = pose.position[axis] + up.dot(shape.support(-up));
  }
  return box;
}

}  // namespace moreau
