// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// A wall around the grains: all points whose distance from an axis through the body's origin is
/// larger than a radius. In space it is the outside of an infinite cylinder, in the plane the
/// outside of a circle. It has no mass and no bounding box, so it is not a Shape.
template <EuclideanSpace S>
class CylinderWall {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Angular = typename S::Angular;

  /// @param axis   direction of the cylinder's axis, body coordinates, of any length but zero: a
  ///               vector in space; in the plane a single number, because the axis is normal to the
  ///               plane
  /// @param radius radius of the cylinder [m], > 0
  /// @throws std::invalid_argument if the axis is not finite or zero, or if the radius is not
  ///                               finite or not positive
  CylinderWall(const AngularArgument<S>& axis, Scalar radius)
      : axis_(axis.stableNormalized()), radius_(radius) {
    require(all_finite(axis), "CylinderWall", "axis", axis, "must be finite");
    require(!axis.isZero(0), "CylinderWall", "axis", axis, "must not be zero");
    require_positive(radius, "CylinderWall", "radius");
  }

  const Angular& axis() const { return axis_; }  ///< unit, body coordinates
  Scalar radius() const { return radius_; }      ///< [m]
  /// The axis of a wall with a rotation from body to world axes: unit, world axes.
  Angular axis_at(const typename S::Rotation& rotation) const {
    return product(S::adjoint(rotation), axis_);
  }

 private:
  friend struct SerializationAccess;
  CylinderWall() = default;
  auto serialized_members() { return std::tie(axis_, radius_); }

  Angular axis_ = Angular::Zero();
  Scalar radius_ = 0;
};

}  // namespace moreau
