// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/detail/vertices.hpp"

namespace moreau {

/// A segment of the x axis, from -half_length() to half_length(). Vertex 0 is the end at -x, vertex
/// 1 the end at +x. A segment has no volume and no mass, so it is not a Shape. It is the core of a
/// capsule.
template <EuclideanSpace S>
class Segment {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Not explicit, so that CapsuleIn<S>(half_length, radius) can be written.
  /// @param half_length half the length of the segment [m], > 0
  /// @throws std::invalid_argument unless the half length is finite and > 0
  Segment(Scalar half_length) : half_length_(half_length) {
    require_positive(half_length, "Segment", "half_length");
  }

  Scalar half_length() const { return half_length_; }  ///< [m]
  /// distance of the ends from the origin [m]
  Scalar circumradius() const { return half_length_; }
  Scalar inradius() const { return 0; }  ///< 0, because the origin lies on the segment [m]

  /// The end farthest in the direction, body coordinates [m]; vertex 1 if both ends are equally
  /// far.
  /// @param direction  body coordinates, of any length but zero
  Vector support(const VectorArgument<S>& direction) const {
    MOREAU_ASSERT(direction.squaredNorm() > 0);
    return direction.x() < 0 ? -half_length_ * Vector::UnitX() : half_length_ * Vector::UnitX();
  }

  /// The smallest axis-aligned box around the segment at a pose, world axes [m].
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    const Vector half = (pose.rotation * Vector(half_length_ * Vector::UnitX())).cwiseAbs();
    return {pose.position - half, pose.position + half};
  }

  /// A segment with the length multiplied by `factor` [-], > 0.
  /// @throws std::invalid_argument unless the factor and the new half length are finite and greater
  ///                               than zero
  [[nodiscard]] Segment scaled(Scalar factor) const {
    require_positive(factor, "Segment::scaled", "factor");
    return Segment(half_length_ * factor);
  }

 private:
  friend struct SerializationAccess;
  Segment() = default;
  auto serialized_members() { return std::tie(half_length_); }

  Scalar half_length_ = 0;
};

/// Whether a shape is a Segment.
template <class ShapeT>
inline constexpr bool is_segment = false;
template <class S>
inline constexpr bool is_segment<Segment<S>> = true;

}  // namespace moreau
