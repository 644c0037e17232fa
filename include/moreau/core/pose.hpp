// SPDX-License-Identifier: MIT
// Pose of a body: position of its centre of mass and rotation of its axes.
#pragma once

#include <tuple>

#include "moreau/core/components.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/value.hpp"

namespace moreau {

/// Maps body coordinates to world coordinates: x = position + rotation x_body. Lengths are in [m].
template <EuclideanSpace S>
struct Pose {
  using Vector = typename S::Vector;
  using Rotation = typename S::Rotation;

  /// Position of the centre of mass, world axes [m]. An assignment of a wrong number of components,
  /// like `position = {0, 0}` in space, does not compile.
  VectorArgument<S> position = Vector::Zero();
  Rotation rotation = S::identity();  ///< from body to world axes

  Pose() = default;  ///< at the world's origin, not rotated
  /// @param origin   position of the centre of mass, world axes [m]
  /// @param to_world rotation from body to world axes; in space a unit quaternion
  Pose(const VectorArgument<S>& origin, const Rotation& to_world = S::identity())
      : position(origin), rotation(to_world) {}

  /// World coordinates [m] of a point given in body coordinates [m].
  Value<Vector> operator()(const VectorArgument<S>& x_body) const {
    return position + rotation * x_body;
  }
  /// Body coordinates [m] of a point given in world coordinates [m].
  Value<Vector> to_body(const VectorArgument<S>& x) const {
    return rotation.inverse() * (x - position);
  }
  /// The pose in the world of a frame whose pose in the frame of the body is `part`.
  Pose operator*(const Pose& part) const {
    return {(*this)(part.position), Rotation(rotation * part.rotation)};
  }
  /// Whether all components are finite.
  bool is_finite() const { return all_finite(position) && S::is_finite(rotation); }

  auto serialized_members() { return std::tie(position, rotation); }  ///< see core/serialize.hpp
};

}  // namespace moreau
