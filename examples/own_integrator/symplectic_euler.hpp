// SPDX-License-Identifier: MIT
// An integrator of one's own: symplectic Euler, for laws that give forces.
#pragma once

#include <Eigen/LU>

#include <cstddef>
#include <span>

#include "moreau/core/twist.hpp"
#include "moreau/motion/concepts.hpp"

/// v += h M^-1 f, then q += h v; the angular momentum L += h torque is the same about all axes.
struct SymplecticEuler {
  template <class S>
  void predict_configuration(moreau::Bodies<S>& bodies, std::span<const typename S::Twist> loads,
                             const typename S::Vector& gravity, typename S::Scalar step) const {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      typename S::Twist& v = bodies.velocity[i];
      const typename S::Twist load = loads[i] + bodies.force[i];
      const typename S::Vector force = moreau::linear<S>(load) + bodies.grain_mass[i] * gravity;
      const typename S::Matrix axes = bodies.axes(i);  // a wall with mass moves along one of them
      moreau::linear<S>(v) +=
          step * (axes * bodies.inverse_mass[i].cwiseProduct(axes.transpose() * force));
      bodies.pose[i].position += step * moreau::linear<S>(v);
      auto& rotation = bodies.pose[i].rotation;
      auto spin = moreau::angular<S>(v);
      if (!bodies.rotates(i)) {
        rotation = S::normalized(S::exp(step * spin) * rotation);
        continue;
      }
      const typename S::Angular momentum =
          bodies.inertia(i, rotation) * spin + step * moreau::angular<S>(load);
      spin = bodies.inertia(i, rotation).inverse() * momentum;
      rotation = S::normalized(S::exp(step * spin) * rotation);
      spin = bodies.inertia(i, rotation).inverse() * momentum;
    }
  }
  template <class S>
  void advance_configuration(moreau::Bodies<S>&, std::span<const typename S::Twist>,
                             const typename S::Vector&, typename S::Scalar) const {}
};

static_assert(moreau::ForceIntegrator<SymplecticEuler, moreau::Space<3>>);  // says what is missing
