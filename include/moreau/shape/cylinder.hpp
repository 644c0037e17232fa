// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/detail/vertices.hpp"

namespace moreau {

/// A solid cylinder, a grain in space. Its axis is the x axis of the body, as that of a Capsule; its centre of mass is
/// the origin. Contact detection knows only its support function: two cylinders touch at one point, a cylinder touches
/// a half-space at up to seven. In the plane the same grain is a rectangle, cuboid<Polygon<T>>({half_length, radius}).
/// A cylinder as a wall around grains is Simulation::add_cylinder().
template <std::floating_point T = double>
class Cylinder {
 public:
  using Space = moreau::Space<3, T>;
  using Scalar = T;
  using Vector = typename Space::Vector;

  /// @param half_length half of the length along the axis [m], > 0
  /// @param radius      [m], > 0
  /// @throws std::invalid_argument unless both are finite and > 0
  Cylinder(T half_length, T radius) : half_length_(half_length), radius_(radius) {
    require_positive(half_length, "Cylinder", "half_length");
    require_positive(radius, "Cylinder", "radius");
  }

  T half_length() const { return half_length_; }                        ///< [m]
  T radius() const { return radius_; }                                  ///< [m]
  T circumradius() const { return std::hypot(half_length_, radius_); }  ///< of the rims [m]
  T inradius() const { return std::min(half_length_, radius_); }        ///< of a ball inside [m]
  T volume() const {
    return 2 * half_length_ * std::numbers::pi_v<T> * radius_ * radius_;
  }  ///< [m^3]

  /// The point farthest in the direction, body coordinates [m].
  /// @param direction  body coordinates, of any length but zero
  Vector support(const VectorArgument<Space>& direction) const {
    MOREAU_ASSERT(direction.squaredNorm() > 0);
    const T across = std::hypot(direction.y(), direction.z());
    const T scale = across > 0 ? radius_ / across : T(0);
    return {direction.x() < 0 ? -half_length_ : half_length_, scale * direction.y(),
            scale * direction.z()};
  }

  /// Mass, centre of mass and inertia at a uniform density.
  /// @param density [kg/m^3], > 0
  /// @throws std::invalid_argument unless the density is finite and > 0
  MassProperties<Space> mass_properties(T density) const {
    require_positive(density, "Cylinder::mass_properties", "density");
    MassProperties<Space> properties;
    properties.mass = density * volume();
    const T round = radius_ * radius_ / 4, along = half_length_ * half_length_ / 3;
    properties.inertia.setZero();
    properties.inertia.diagonal() << 2 * round, round + along, round + along;
    properties.inertia *= properties.mass;
    return properties;
  }

  /// The smallest axis-aligned box around the cylinder at a pose, world axes [m].
  Aabb<Space> bounding_box(const Pose<Space>& pose) const {
    const Vector axis = pose.rotation * Vector(Vector::UnitX());
    const Vector half = half_length_ * axis.cwiseAbs() +
                        radius_ * (T(1) - axis.array().square()).max(T(0)).sqrt().matrix();
    return {pose.position - half, pose.position + half};
  }

  /// A cylinder with all lengths multiplied by `factor` [-], > 0.
  /// @throws std::invalid_argument unless the factor and the new lengths are finite and > 0
  [[nodiscard]] Cylinder scaled(T factor) const {
    require_positive(factor, "Cylinder::scaled", "factor");
    return Cylinder(half_length_ * factor, radius_ * factor);
  }

 private:
  friend struct SerializationAccess;
  Cylinder() = default;
  auto serialized_members() { return std::tie(half_length_, radius_); }

  T half_length_ = 0, radius_ = 0;
};

}  // namespace moreau
