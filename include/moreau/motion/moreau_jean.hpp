// SPDX-License-Identifier: MIT
// Moreau-Jean time stepping. Velocities jump once per step, at a configuration within the step.
// With the generalized coordinates q, velocities v, external forces f and contact impulses r:
//
//   q_m = q_i + h (1 - theta) v_i      detection configuration
//   v_free = v_i + h M^-1 f
//   v_{i+1} = v_free + M^-1 J^T r      r: solution of the contact problem
//   q_{i+1} = q_m + h theta v_{i+1}
//
// Without forces the angular momentum L is conserved to rounding. With I_m = I(q_m) and the torque
// tau, the free angular velocity is w = I_m^-1 (L_i + h tau). Let L_{i+1} be the angular momentum
// after the contact impulses. The new angular velocity w solves I(exp(h theta w) q_m) w = L_{i+1}
// by Newton's method, so that the gyroscopic terms are implicit. In the plane the equation is I w =
// L_{i+1}.
#pragma once

#include <Eigen/LU>

#include <cstddef>
#include <span>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/motion/body_motion.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau {

/// The theta scheme of Moreau and Jean, with the equations at the top of this file. It models
/// ImpulseIntegrator and is used with set-valued contact laws. Source, except for the rotations: M.
/// Jean, Comput. Methods Appl. Mech. Engrg. 177 (1999) 235.
class MoreauJean {
 public:
  /// The scheme with theta = 1/2.
  MoreauJean() = default;
  /// @param theta in [1/2, 1] [-]. With 1/2 the scheme is second order and conserves energy; with 1
  ///              it is fully implicit
  /// @throws std::invalid_argument if theta is outside of [1/2, 1]
  explicit MoreauJean(double theta) : theta_(theta) {
    require(theta >= 0.5 && theta <= 1, "MoreauJean", "theta", theta, "must lie in [0.5, 1]");
  }
  double theta() const { return theta_; }  ///< in [1/2, 1] [-]
  /// The same scheme with another theta. Compliant contacts step with a larger one where the step grows.
  /// @throws std::invalid_argument if theta is outside of [1/2, 1]
  MoreauJean with_theta(double theta) const { return MoreauJean(theta); }

  /// Computes the angular momentum of every body and moves the bodies to the detection
  /// configuration.
  /// @param momentum out: angular momentum L_i of each body about its centre, world axes [kg m^2/s]
  /// @param step     h [s]
  /// @param team     threads that share the work
  template <class S>
  void predict_configuration(Bodies<S>& bodies, std::span<typename S::Angular> momentum,
                             typename S::Scalar step, const Team& team = {}) const {
    const auto h = step * static_cast<typename S::Scalar>(1 - theta_);
    team.share_each(bodies.size(), 128, [&](std::size_t i) {
      momentum[i] =
          product(bodies.inertia(i, bodies.pose[i].rotation), angular<S>(bodies.velocity[i]));
      advance_pose(bodies.pose[i], bodies.velocity[i], h);
    });
  }

  /// Computes the velocities at the end of the step without contacts.
  /// @param gravity  acceleration, world axes [m/s^2]
  /// @param momentum in: L_i, out: L_i + h tau of each body, world axes [kg m^2/s]
  /// @param free     out: twist (v, w) of each body, world axes [m/s, rad/s]
  /// @param step     h [s]
  /// @param team     threads that share the work
  template <class S>
  void free_velocity(const Bodies<S>& bodies, const typename S::Vector& gravity,
                     std::span<typename S::Angular> momentum, std::span<typename S::Twist> free,
                     typename S::Scalar step, const Team& team = {}) const {
    team.share_each(bodies.size(), 128, [&](std::size_t i) {
      free[i] = bodies.velocity[i];
      linear<S>(free[i]) += velocity_change<S>(bodies, i, S::Vector::Zero(), gravity, step);
      if (!bodies.rotates(i)) return;
      momentum[i] += step * angular<S>(bodies.force[i]);
      const typename S::Inertia inverse = inverse_of(bodies.inertia(i, bodies.pose[i].rotation));
      angular<S>(free[i]) = product(inverse, momentum[i]);
    });
  }

  /// Sets the new velocities and moves the bodies to the end of the step.
  /// @param after twist (v, w) of each body after the contact impulses, in the detection
  ///              configuration, world axes [m/s, rad/s]
  /// @param step  h [s]
  /// @param team  threads that share the work
  template <class S>
  void advance_configuration(Bodies<S>& bodies, std::span<const typename S::Twist> after,
                             typename S::Scalar step, const Team& team = {}) const {
    const auto h = step * static_cast<typename S::Scalar>(theta_);
    team.share_each(bodies.size(), 128, [&](std::size_t i) {
      bodies.velocity[i] = after[i];
      if (bodies.rotates(i)) {
        const typename S::Angular spin = angular<S>(after[i]);
        angular<S>(bodies.velocity[i]) = spin_after<S>(
            bodies, i, product(bodies.inertia(i, bodies.pose[i].rotation), spin), spin, h);
      }
      advance_pose(bodies.pose[i], bodies.velocity[i], h);
    });
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(theta_); }

  double theta_ = 0.5;
};

}  // namespace moreau
