// SPDX-License-Identifier: MIT
// Velocity Verlet for forces that depend smoothly on the configuration, as in molecular dynamics:
//
//   v_{i+1/2} = v_i + h/2 M^-1 f_i         q_{i+1} = q_i + h v_{i+1/2}
//   f_{i+1} from q_{i+1}, v_{i+1/2}        v_{i+1} = v_{i+1/2} + h/2 M^-1 f_{i+1}
//
// Rotations are treated in the same way, with the angular momentum L in place of v. The angular
// velocity w at the half step solves I(q_{i+1/2}) w = L_{i+1/2}. So L is conserved to rounding if
// there are no torques. The scheme is second order in h. It is stable for h < 2 / (largest angular
// eigenfrequency). In practice it is accurate if h is at most a twentieth of the duration of a
// contact (L. Verlet, Phys. Rev. 159 (1967) 98; P. A. Cundall and O. D. L. Strack, Geotechnique 29
// (1979) 47).
#pragma once

#include <cstddef>
#include <span>

#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/motion/body_motion.hpp"

namespace moreau {

/// The velocity Verlet scheme, with the equations and sources at the top of this file. It models
/// ForceIntegrator and is used with regularized contact laws.
class VelocityVerlet {
 public:
  /// Advances the velocities by half a step and moves the bodies to the end of the step.
  /// @param loads   contact force [N] and torque about the centre [N m] on each body, world axes
  /// @param gravity acceleration, world axes [m/s^2]
  /// @param step    h [s]
  template <class S>
  void predict_configuration(Bodies<S>& bodies, std::span<const typename S::Twist> loads,
                             const typename S::Vector& gravity, typename S::Scalar step) const {
    using Twist = typename S::Twist;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Twist middle = bodies.velocity[i];
      linear<S>(middle) +=
          velocity_change(bodies, i, typename S::Vector(linear<S>(loads[i])), gravity, step / 2);
      if (!bodies.rotates(i)) {
        advance_pose(bodies.pose[i], middle, step);
        bodies.velocity[i] = middle;
        continue;
      }
      const typename S::Angular spin = angular<S>(middle);
      const typename S::Angular momentum = bodies.inertia(i, bodies.pose[i].rotation) * spin +
                                           step / 2 * torque(bodies, i, loads[i]);
      angular<S>(middle) = spin_after(bodies, i, momentum, spin, step / 2);
      advance_pose(bodies.pose[i], middle, step);
      bodies.velocity[i] = middle;
      const typename S::Inertia inverse = inverse_of(bodies.inertia(i, bodies.pose[i].rotation));
      angular<S>(bodies.velocity[i]) = inverse * momentum;
    }
  }

  /// Advances the velocities by the second half of the step, with the forces of the new
  /// configuration.
  /// @param loads   contact force [N] and torque about the centre [N m] on each body in the new
  ///                configuration, world axes
  /// @param gravity acceleration, world axes [m/s^2]
  /// @param step    h [s]
  template <class S>
  void advance_configuration(Bodies<S>& bodies, std::span<const typename S::Twist> loads,
                             const typename S::Vector& gravity, typename S::Scalar step) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      linear<S>(bodies.velocity[i]) +=
          velocity_change(bodies, i, typename S::Vector(linear<S>(loads[i])), gravity, step / 2);
      if (bodies.rotates(i))
        angular<S>(bodies.velocity[i]) +=
            step / 2 *
            (inverse_of(bodies.inertia(i, bodies.pose[i].rotation)) * torque(bodies, i, loads[i]));
    }
  }

 private:
  template <class S>
  static typename S::Angular torque(const Bodies<S>& bodies, std::size_t i,
                                    const typename S::Twist& load) {
    return angular<S>(bodies.force[i]) + angular<S>(load);
  }
};

}  // namespace moreau
