// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// A wall: all points on one side of a plane through the body's origin, or of a line in the plane.
/// The solid is { x : normal . x <= 0 }. It has no mass and no bounding box, so it is not a Shape.
template <EuclideanSpace S>
class HalfSpace {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// @param normal outward normal of the solid, body coordinates, of any length but zero
  /// @throws std::invalid_argument if the normal is not finite or its length is zero
  explicit HalfSpace(const VectorArgument<S>& normal) : normal_(normal.stableNormalized()) {
    require(all_finite(normal), "HalfSpace", "normal", normal, "must be finite");
    require(!normal.isZero(0), "HalfSpace", "normal", normal, "must not be zero");
  }

  /// Outward normal of the solid, unit, body coordinates.
  const Vector& normal() const { return normal_; }

 private:
  Vector normal_;
};

}  // namespace moreau
