// SPDX-License-Identifier: MIT
// Any convex shape, reduced to the functions that a user's shape must have: support, bounding box
// and mass.
#pragma once

#include <utility>

#include "moreau/shape/concepts.hpp"

namespace conformance {

template <moreau::ConvexShape ShapeT>
class SupportOnly {
 public:
  using Space = moreau::SpaceOf<ShapeT>;
  using Vector = typename Space::Vector;

  explicit SupportOnly(ShapeT shape) : shape_(std::move(shape)) {}

  Vector support(const Vector& direction) const { return shape_.support(direction); }
  moreau::Aabb<Space> bounding_box(const moreau::Pose<Space>& pose) const {
    return shape_.bounding_box(pose);
  }
  moreau::MassProperties<Space> mass_properties(typename Space::Scalar density) const {
    return shape_.mass_properties(density);
  }

 private:
  ShapeT shape_;
};

}  // namespace conformance
