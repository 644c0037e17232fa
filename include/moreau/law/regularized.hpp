// SPDX-License-Identifier: MIT
// The requirements on a regularized law, and what several of them share.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/law/concepts.hpp"

namespace moreau {

/// One contact point at one time, in its own frame, normal first.
template <class S>
struct ContactMotion {
  typename S::Scalar gap;       ///< [m], < 0 is penetration
  typename S::Vector velocity;  ///< of b against a at the point; u_n > 0 separates [m/s]
  /// Effective mass of the point [kg]. For two balls it is 1 / (1/m_a + 1/m_b), with 1/m = 0 for a wall. At a
  /// vertex of a grain it is smaller, because the grain can turn. n points of a face that lands flat
  /// have 1/n of it each, so that a dashpot 2 beta sqrt(k m) has the damping ratio beta for the face, too.
  /// contact/effective_mass.hpp has the definition.
  typename S::Scalar effective_mass;
  typename S::Scalar effective_radius;  ///< 1 / (1/R_a + 1/R_b) with R from the centre of mass to
                                        ///< the point; a wall has no curvature [m]
  typename S::Scalar step;              ///< since the last call [s]; 0 in the first call
};

/// A law whose force is a function of gap and velocity, and of a memory.
///
/// - force(motion, memory): the force on b [N] in the frame of the contact, D entries, normal
///   first; f_n > 0 pushes. memory is a vector in the frame, in a unit of the law, 0 for a new
///   contact. From step to step its first entry is kept. Its tangential entries turn with the mean rotation of
///   the two bodies and with the normal (SpringTurn). If the key of a contact is gone, the nearest new contact
///   of the pair takes its memory over.
template <class L, class S>
concept RegularizedLaw = std::copyable<L> &&
    requires(const L law, const ContactMotion<S> motion, typename S::Vector memory) {
  { law.force(motion, memory) } -> std::same_as<typename S::Vector>;
};

/// Any law: impulses or forces.
template <class L, class S>
concept ContactLaw = SetValuedLaw<L, S> || RegularizedLaw<L, S>;

namespace detail {

/// Duration of a contact with damping ratio beta <= 1, over sqrt(m/k): until its force would pull.
template <std::floating_point T>
T contact_time(T beta) {
  const T rest = T(1) - beta * beta;
  return rest > T(1e-6) ? 2 * std::acos(beta) / std::sqrt(rest) : T(2);
}

/// The damping ratio beta of a linear oscillator whose impact ends when the force would pull:
/// e = exp(-beta contact_time(beta)) (T. Schwager and T. Poschel, Granular Matter 9 (2007) 465);
/// the same for Hertz's force with its dashpot, which a change of variables makes linear (D.
/// Antypov and J. A. Elliott, EPL 94 (2011) 50004). Critical damping gives e^-2 = 0.135,
/// which is the least restitution.
template <std::floating_point T>
T damping_ratio(T restitution, const char* law) {
  require(restitution >= T(0) && restitution <= T(1), law, "restitution", restitution,
          "must lie in [0, 1]");
  T lower = 0, upper = 1;
  for (int k = 0; k < std::numeric_limits<T>::digits; ++k) {
    const T beta = (lower + upper) / 2;
    (std::exp(-beta * contact_time(beta)) > restitution ? lower : upper) = beta;
  }
  return restitution < T(1) ? upper : T(0);
}

/// The force of a normal force and a tangential spring and dashpot with Coulomb's limit.
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
    const auto uncut = shear.eval();
    shear *= size > 0 ? limit / size : T(0);
    // If the dashpot alone exceeds the limit, the excess is not stored as a stretch: the spring would
    // then push the slip on.
    if (stiffness > 0) stretch = -(shear + damping * slip) / stiffness;
    if (stretch.dot(uncut) > 0) stretch.setZero();
  }
  return force;
}

}  // namespace detail
}  // namespace moreau
