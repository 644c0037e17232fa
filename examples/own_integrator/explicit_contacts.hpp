// SPDX-License-Identifier: MIT
// An integrator of one's own for laws that give impulses. Contacts are detected where the bodies are
// at the start of the step; then the bodies move with the new velocities:
//
//   v_free = v_i + h M^-1 f,   v_{i+1} = v_free + M^-1 J^T r,   q_{i+1} = q_i + h v_{i+1}
#pragma once

#include <Eigen/LU>

#include <cstddef>
#include <span>

#include "moreau/core/twist.hpp"
#include "moreau/motion/body_motion.hpp"
#include "moreau/motion/concepts.hpp"

struct ExplicitContacts {
  /// Leaves the bodies where they are, and stores their angular momenta L = I w.
  template <class S>
  void predict_configuration(moreau::Bodies<S>& bodies, std::span<typename S::Angular> momentum,
                             typename S::Scalar) const {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      momentum[i] =
          bodies.inertia(i, bodies.pose[i].rotation) * moreau::angular<S>(bodies.velocity[i]);
  }

  template <class S>
  void free_velocity(const moreau::Bodies<S>& bodies, const typename S::Vector& gravity,
                     std::span<typename S::Angular> momentum, std::span<typename S::Twist> free,
                     typename S::Scalar h) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      free[i] = bodies.velocity[i];
      moreau::linear<S>(free[i]) +=
          moreau::velocity_change<S>(bodies, i, S::Vector::Zero(), gravity, h);
      if (!bodies.rotates(i)) continue;
      momentum[i] += h * moreau::angular<S>(bodies.force[i]);
      moreau::angular<S>(free[i]) =
          bodies.inertia(i, bodies.pose[i].rotation).inverse() * momentum[i];
    }
  }

  /// The angular momentum after the impulses is that at the end of the step, too.
  template <class S>
  void advance_configuration(moreau::Bodies<S>& bodies, std::span<const typename S::Twist> after,
                             typename S::Scalar h) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies.velocity[i] = after[i];
      if (bodies.rotates(i)) {
        const typename S::Angular spin = moreau::angular<S>(after[i]);
        const typename S::Angular momentum = bodies.inertia(i, bodies.pose[i].rotation) * spin;
        moreau::angular<S>(bodies.velocity[i]) =
            moreau::spin_after<S>(bodies, i, momentum, spin, h);
      }
      moreau::advance_pose<S>(bodies.pose[i], bodies.velocity[i], h);
    }
  }
};

static_assert(moreau::ImpulseIntegrator<ExplicitContacts, moreau::Space<3>>);
