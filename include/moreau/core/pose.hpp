// SPDX-License-Identifier: MIT
// Where a body is: the position of its centre of mass and the rotation of its axes.
#pragma once

#include "moreau/core/space.hpp"

namespace moreau {

/// Maps body to world coordinates: x = position + rotation x_body. Lengths in metres.
template <class S>
struct Pose {
  using Vector = typename S::Vector;

  Vector position = Vector::Zero();               ///< of the centre of mass, world axes [m]
  typename S::Rotation rotation = S::identity();  ///< from body to world axes

  /// World coordinates [m] of a point given in body coordinates [m].
  Vector operator()(const Vector& x_body) const { return position + rotation * x_body; }
  /// Body coordinates [m] of a point given in world coordinates [m].
  Vector to_body(const Vector& x) const { return rotation.inverse() * (x - position); }
  /// Whether no number in it is infinite or none.
  bool is_finite() const { return position.allFinite() && S::is_finite(rotation); }
};

}  // namespace moreau
