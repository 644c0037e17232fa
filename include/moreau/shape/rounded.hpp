// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <tuple>

#include "moreau/core/serialize.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/shape/detail/vertices.hpp"
#include "moreau/shape/rounded_moments.hpp"

namespace moreau {

/// A core for which a function rounded_moments(core, radius) exists (rounded_moments.hpp).
template <class Core>
concept HasRoundedMoments = requires(const Core core, typename Core::Space::Scalar radius) {
  { rounded_moments(core, radius) } -> std::same_as<Moments<SpaceOf<Core>>>;
};

/// The Minkowski sum of a convex core and a ball: all points whose distance from the core is at
/// most a radius. The core is a Polygon, Polyhedron, Segment or any shape with a support function.
///
/// The body frame has the axes of the core's frame and its origin at the centre of mass of the sum.
/// This is not the centre of mass of the core unless the core is symmetric. core_position() is the
/// position of the core's origin in the body frame. For a core without rounded_moments(), the body
/// frame is the core's frame. The sum then has no mass and is not a Shape.
template <ConvexCore Core>
class Rounded {
 public:
  using Space = SpaceOf<Core>;
  using Scalar = typename Space::Scalar;
  using Vector = typename Space::Vector;

  /// @param core   in its own frame; it is copied
  /// @param radius radius of the ball [m], > 0
  /// @throws std::invalid_argument unless the radius is finite and > 0, and also the
  ///                               volume and the inertia if they are known
  Rounded(const Core& core, Scalar radius) : core_(core), radius_(radius) {
    require_positive(radius, "Rounded", "radius");
    if constexpr (HasRoundedMoments<Core>) {
      const Moments<Space> about_core = rounded_moments(core_, radius_);
      require(std::isfinite(about_core.volume) && about_core.volume > 0, "Rounded", "volume",
              about_core.volume, "m^D must be positive and finite");
      core_position_ = -about_core.first / about_core.volume;
      moments_ = about_core.centered();
      require(moments_.are_regular(), "Rounded", "inertia", moments_.inertia(),
              "m^(D+2) must be positive and finite");
    }
  }

  const Core& core() const { return core_; }  ///< the core in its own frame
  Scalar radius() const { return radius_; }   ///< radius of the ball [m]
  /// Position of the origin of the core's frame in the body frame [m].
  const Vector& core_position() const { return core_position_; }

  /// The volume [m^D]. Exists if rounded_moments() exists for the core.
  Scalar volume() const requires HasRoundedMoments<Core> { return moments_.volume; }
  /// Distance of the farthest point of the shape from the origin [m]. If the core is not a polytope
  /// and core_position() is not zero, it is an upper bound of this distance.
  Scalar circumradius() const requires HasCircumradius<Core> {
    if constexpr (Polytope<Core>) {
      const auto from_origin = core_.vertices().rowwise() + core_position_.transpose();
      return from_origin.rowwise().norm().maxCoeff() + radius_;
    } else {
      return core_.circumradius() + core_position_.norm() + radius_;
    }
  }
  /// Distance of the nearest point of the surface from the origin [m]. If the core is not a
  /// polytope and core_position() is not zero, it is a lower bound of this distance.
  Scalar inradius() const requires HasInradius<Core> {
    if constexpr (Polytope<Core>) {
      const auto heights = (core_.face_normals() * core_position_).array() + core_.face_offsets();
      return heights.minCoeff() + radius_;
    } else {
      return core_.inradius() - core_position_.norm() + radius_;
    }
  }

  /// The point of the shape farthest in the direction, body coordinates [m].
  /// @param direction  body coordinates, of any length but zero
  Vector support(const VectorArgument<Space>& direction) const {
    return core_position_ + core_.support(direction) + radius_ * direction.normalized();
  }

  /// Mass, centre of mass and inertia at a uniform density.
  /// @param density [kg/m^D], > 0
  /// @throws std::invalid_argument unless the density is finite and > 0
  MassProperties<Space> mass_properties(Scalar density) const requires HasRoundedMoments<Core> {
    require_positive(density, "Rounded::mass_properties", "density");
    return {density * moments_.volume, Vector::Zero(), density * moments_.inertia()};
  }

  /// The pose of the core's frame in the world if this shape has the given pose [m].
  Pose<Space> core_pose(const Pose<Space>& pose) const {
    return {pose(core_position_), pose.rotation};
  }
  /// A box around the shape at a pose, world axes [m].
  Aabb<Space> bounding_box(const Pose<Space>& pose) const {
    return core_.bounding_box(core_pose(pose)).inflated(radius_);
  }

  /// The same shape with all lengths multiplied by `factor` [-], > 0.
  /// @throws std::invalid_argument unless the factor is finite and > 0; also the
  ///                               exceptions of the core
  [[nodiscard]] Rounded scaled(Scalar factor) const requires Scalable<Core> {
    require_positive(factor, "Rounded::scaled", "factor");
    return Rounded(core_.scaled(factor), radius_ * factor);
  }

 private:
  friend struct SerializationAccess;
  Rounded() : core_(SerializationAccess::blank<Core>()) {}
  auto serialized_members() { return std::tie(core_, radius_, core_position_, moments_); }

  Core core_;
  Scalar radius_ = 0;
  Vector core_position_ = Vector::Zero();
  Moments<Space> moments_;
};

/// Whether a shape is a Rounded shape.
template <class ShapeT>
inline constexpr bool is_rounded = false;
template <class Core>
inline constexpr bool is_rounded<Rounded<Core>> = true;

}  // namespace moreau
