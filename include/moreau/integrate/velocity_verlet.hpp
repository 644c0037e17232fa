// SPDX-License-Identifier: MIT
// Velocity Verlet for forces that depend smoothly on the configuration (molecular dynamics):
//
//   v_{i+1/2} = v_i + h/2 M^-1 F_i         q_{i+1} = q_i + h v_{i+1/2}
//   F_{i+1} from q_{i+1}, v_{i+1/2}        v_{i+1} = v_{i+1/2} + h/2 M^-1 F_{i+1}
//
// Rotations the same with the angular momentum L in place of v: w at the half step solves
// I(q_{i+1/2}) w = L_{i+1/2}, which keeps L to rounding. Second order in h; stable for
// h < 2 / (largest eigenfrequency) and in practice accurate from a twentieth of a contact's
// duration on (L. Verlet, Phys. Rev. 159 (1967) 98; P. A. Cundall and O. D. L. Strack,
// Geotechnique 29 (1979) 47).
#pragma once

#include <cstddef>
#include <span>

#include "moreau/body/bodies.hpp"
#include "moreau/integrate/spin.hpp"

namespace moreau {

/// Velocity Verlet; the header has its equations and their source. Model of ForceIntegrator, for
/// regularized laws.
class VelocityVerlet {
 public:
  /// Half a kick by the forces at hand, then the move to the end of the step.
  /// @param loads   contact force [N] and torque about the centre [N m] of every body, world axes
  /// @param gravity world axes [m/s^2]
  /// @param step    [s]
  template <class S>
  void predict_configuration(Bodies<S>& bodies, std::span<const typename S::Twist> loads,
                             const typename S::Vector& gravity, typename S::Scalar step) const {
    using Twist = typename S::Twist;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Twist middle = bodies.velocity[i];
      middle.template head<S::dim>() += detail::kick(
          bodies, i, typename S::Vector(loads[i].template head<S::dim>()), gravity, step / 2);
      if (!bodies.rotates(i)) {
        detail::move(bodies.pose[i], middle, step);
        bodies.velocity[i] = middle;
        continue;
      }
      const typename S::Angular spin = middle.template tail<S::angular_dim>();
      const typename S::Angular momentum = bodies.inertia(i, bodies.pose[i].rotation) * spin +
                                           step / 2 * torque(bodies, i, loads[i]);
      middle.template tail<S::angular_dim>() =
          detail::spin_after(bodies, i, momentum, spin, step / 2);
      detail::move(bodies.pose[i], middle, step);
      bodies.velocity[i] = middle;
      const typename S::Inertia inverse = bodies.inertia(i, bodies.pose[i].rotation).inverse();
      bodies.velocity[i].template tail<S::angular_dim>() = inverse * momentum;
    }
  }

  /// The other half of the kick, by the forces of the new configuration.
  /// @param loads   those there, as in predict_configuration()
  /// @param gravity world axes [m/s^2]
  /// @param step    [s]
  template <class S>
  void advance_configuration(Bodies<S>& bodies, std::span<const typename S::Twist> loads,
                             const typename S::Vector& gravity, typename S::Scalar step) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies.velocity[i].template head<S::dim>() += detail::kick(
          bodies, i, typename S::Vector(loads[i].template head<S::dim>()), gravity, step / 2);
      if (bodies.rotates(i))
        bodies.velocity[i].template tail<S::angular_dim>() +=
            step / 2 *
            (bodies.inertia(i, bodies.pose[i].rotation).inverse() * torque(bodies, i, loads[i]));
    }
  }

 private:
  template <class S>
  static typename S::Angular torque(const Bodies<S>& bodies, std::size_t i,
                                    const typename S::Twist& load) {
    return bodies.force[i].template tail<S::angular_dim>() + load.template tail<S::angular_dim>();
  }
};

}  // namespace moreau
