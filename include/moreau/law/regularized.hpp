// SPDX-License-Identifier: MIT
// What regularized laws see of a contact, and what several of them share.
#pragma once

#include <cmath>
#include <concepts>
#include <numbers>

#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/law/concepts.hpp"

namespace moreau {

/// One contact point at one time, in its own frame, normal first.
template <class S>
struct ContactMotion {
  typename S::Scalar gap;               ///< [m], < 0 is penetration
  typename S::Vector velocity;          ///< of b against a at the point; u_n > 0 separates [m/s]
  typename S::Scalar effective_mass;    ///< 1 / (1/m_a + 1/m_b); a wall weighs nothing in it [kg]
  typename S::Scalar effective_radius;  ///< 1 / (1/R_a + 1/R_b) with R from the centre of mass to
                                        ///< the point; a wall has no curvature [m]
  typename S::Scalar step;              ///< since the last call [s]
};

/// Forces that are a function of gap and velocity, and of a memory that the law keeps.
///
/// - force(motion, memory): the force on b [N] in the contact's frame. memory is a vector of the
///   frame, 0 when the contact is new; it is carried from step to step in world axes.
template <class L, class S>
concept RegularizedLaw = std::copyable<L> &&
    requires(const L law, const ContactMotion<S> motion, typename S::Vector memory) {
  { law.force(motion, memory) } -> std::same_as<typename S::Vector>;
};

/// Any law: impulses or forces.
template <class L, class S>
concept ContactLaw = SetValuedLaw<L, S> || RegularizedLaw<L, S>;

namespace detail {

/// beta = -ln e / sqrt(pi^2 + ln^2 e) of a linear oscillator whose half swing keeps e of its speed.
template <std::floating_point T>
T damping_ratio(T restitution, const char* law) {
  require(restitution >= T(0) && restitution <= T(1), law, "restitution", restitution,
          "must lie in [0, 1]");
  if (restitution == T(0)) return T(1);
  const T log = std::log(restitution);
  return -log / std::sqrt(std::numbers::pi_v<T> * std::numbers::pi_v<T> + log * log);
}

/// A normal force with a tangential spring and dashpot under Coulomb's limit.
/// @param memory in and out: stretch of the spring [m]
template <class S>
typename S::Vector spring_friction(const ContactMotion<S>& motion, typename S::Scalar normal,
                                   typename S::Scalar stiffness, typename S::Scalar damping,
                                   typename S::Scalar friction, typename S::Vector& memory) {
  using T = typename S::Scalar;
  constexpr int tangents = S::dim - 1;
  memory[0] = 0;
  auto stretch = memory.template tail<tangents>();
  const auto slip = motion.velocity.template tail<tangents>();
  stretch += motion.step * slip;
  typename S::Vector force;
  force[0] = normal;
  auto shear = force.template tail<tangents>();
  shear = -stiffness * stretch - damping * slip;
  const T size = shear.norm(), limit = friction * normal;
  if (size > limit) {
    shear *= size > 0 ? limit / size : T(0);
    if (stiffness > 0) stretch = -(shear + damping * slip) / stiffness;
  }
  return force;
}

}  // namespace detail
}  // namespace moreau
