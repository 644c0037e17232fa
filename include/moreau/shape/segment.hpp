// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/vertices.hpp"

namespace moreau {

/// The points of the x axis up to half_length() from the origin. Vertex 0 is the end at -x, vertex
/// 1 the end at +x. A segment has no volume and no mass, so it is not a Shape. It is the core of a
/// capsule.
template <EuclideanSpace S>
class Segment {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Not explicit, so that CapsuleIn<S>(half_length, radius) can be written.
  /// @param half_length [m], > 0
  /// @throws std::invalid_argument unless the half length is finite and greater than zero
  Segment(Scalar half_length) : half_length_(half_length) {
    detail::require_positive(half_length, "Segment", "half_length");
  }

  Scalar half_length() const { return half_length_; }   ///< [m]
  Scalar circumradius() const { return half_length_; }  ///< of the ball around the segment [m]
  Scalar inradius() const { return 0; }                 ///< 0: the origin lies on the segment [m]

  /// An end that is farthest in the direction (any length but zero), body coordinates [m].
  Vector support(const VectorArgument<S>& direction) const {
    MOREAU_ASSERT(direction.squaredNorm() > 0);
    return direction.x() < 0 ? -half_length_ * Vector::UnitX() : half_length_ * Vector::UnitX();
  }

  /// The tight box around it at the pose, world axes [m].
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    const Vector half = (pose.rotation * Vector(half_length_ * Vector::UnitX())).cwiseAbs();
    return {pose.position - half, pose.position + half};
  }

  /// A segment of half_length() times the factor [-], > 0.
  /// @throws std::invalid_argument unless the factor, and then the half length, is finite and
  ///         greater than zero
  Segment scaled(Scalar factor) const {
    detail::require_positive(factor, "Segment::scaled", "factor");
    return Segment(half_length_ * factor);
  }

 private:
  friend struct SerializationAccess;
  Segment() = default;
  auto serialized_members() { return std::tie(half_length_); }

  Scalar half_length_ = 0;
};

}  // namespace moreau
