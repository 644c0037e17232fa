// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>
#include <tuple>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/detail/vertices.hpp"

namespace moreau {

/// A solid ball in space or a solid disk in the plane. Its centre is the origin of the body frame.
/// Programs for one dimension write Ball<T> or Disk<T>.
template <EuclideanSpace S>
class BallIn {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// @param radius radius [m], > 0
  /// @throws std::invalid_argument unless the radius is finite and > 0
  explicit BallIn(Scalar radius) : radius_(radius) { require_positive(radius, "Ball", "radius"); }

  Scalar radius() const { return radius_; }  ///< [m]
  /// The radius [m], under the name that all shapes have in common.
  Scalar circumradius() const { return radius_; }
  /// The radius [m], under the name that all shapes have in common.
  Scalar inradius() const { return radius_; }
  /// The volume [m^D]: pi r^2 in the plane, pi r^2 (4 r / 3) in space.
  Scalar volume() const {
    return std::numbers::pi_v<Scalar> * radius_ * radius_ *
           std::pow(Scalar(4) / Scalar(3) * radius_, Scalar(S::dim - 2));
  }

  /// The point of the shape farthest in the direction, body coordinates [m].
  /// @param direction  body coordinates, of any length but zero
  Vector support(const VectorArgument<S>& direction) const {
    MOREAU_ASSERT(direction.squaredNorm() > 0);
    return radius_ * direction.normalized();
  }

  /// Mass, centre of mass and inertia at a uniform density.
  /// @param density [kg/m^D], > 0
  /// @throws std::invalid_argument unless the density is finite and > 0
  MassProperties<S> mass_properties(Scalar density) const {
    require_positive(density, "Ball::mass_properties", "density");
    MassProperties<S> properties;
    properties.mass = density * volume();
    // 2/5 m r^2 in space, 1/2 m r^2 in the plane.
    properties.inertia = Scalar(2) / Scalar(S::dim + 2) * properties.mass * radius_ * radius_ *
                         S::Inertia::Identity();
    return properties;
  }

  /// The smallest axis-aligned box around the shape at a pose, world axes [m].
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    return {pose.position.array() - radius_, pose.position.array() + radius_};
  }

  /// A ball with the radius multiplied by `factor` [-], > 0.
  /// @throws std::invalid_argument unless the factor and the new radius are finite and greater than
  ///                               zero
  [[nodiscard]] BallIn scaled(Scalar factor) const {
    require_positive(factor, "Ball::scaled", "factor");
    return BallIn(radius_ * factor);
  }

 private:
  friend struct SerializationAccess;
  BallIn() = default;
  auto serialized_members() { return std::tie(radius_); }

  Scalar radius_ = 0;
};

/// A disk in the plane.
template <std::floating_point T = double>
using Disk = BallIn<Space<2, T>>;
/// A ball in space.
template <std::floating_point T = double>
using Ball = BallIn<Space<3, T>>;
/// Deprecated name of Ball. A ball is a solid, a sphere is its surface.
template <std::floating_point T = double>
using Sphere [[deprecated("write Ball<T>, in the plane Disk<T>")]] = Ball<T>;

/// Whether a shape is a Ball or a Disk.
template <class ShapeT>
inline constexpr bool is_ball = false;
template <class S>
inline constexpr bool is_ball<BallIn<S>> = true;

}  // namespace moreau
