// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/aabb.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau {

/// Radius of a ball about the centre of mass that contains the shape in any orientation [m]: the
/// circumradius() of a shape that has one; else the distance of the farthest corner of its bounding
/// box, which is larger.
template <Shape ShapeT>
typename SpaceOf<ShapeT>::Scalar circumradius(const ShapeT& shape) {
  using S = SpaceOf<ShapeT>;
  if constexpr (HasCircumradius<ShapeT>) {
    return shape.circumradius();
  } else {
    const Aabb<S> box = shape.bounding_box(Pose<S>{});
    return box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm();
  }
}

}  // namespace moreau
