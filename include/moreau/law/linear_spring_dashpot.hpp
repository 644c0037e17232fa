// SPDX-License-Identifier: MIT
// Linear springs and dashpots with a tangential spring that remembers the slip since the contact
// closed and slides at Coulomb's limit (P. A. Cundall and O. D. L. Strack, Geotechnique 29 (1979)
// 47):
//
//     f_n = max(0, -k_n g - c_n u_n),       f_t = -k_t xi - c_t u_t, cut to |f_t| <= mu f_n,
//
// with xi the integral of u_t over the contact's life, shortened where the contact slides to what
// the limit can hold. The dashpots follow from the restitution of a free impact, c = 2 beta
// sqrt(m k), e = exp(-2 beta acos(beta)/sqrt(1 - beta^2)), m the effective mass of the point
// (ContactMotion): n points of a face bear 1/n each, so that a face that lands flat has the restitution e.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/regularized.hpp"

namespace moreau {

/// Cundall's and Strack's springs and dashpots; the head of this file has their equations and
/// source. One spring per contact point: a contact between faces has several. Model of
/// RegularizedLaw.
template <std::floating_point T = double>
class LinearSpringDashpot {
 public:
  /// @param stiffness            k_n > 0 [N/m]
  /// @param tangential_stiffness k_t >= 0 [N/m]; > 0 where there is friction
  /// @param friction             mu >= 0 [-]
  /// @param restitution          e in [0, 1] of a central impact [-]; at least 0.135
  /// @throws std::invalid_argument outside these ranges
  explicit LinearSpringDashpot(T stiffness = T(1e6), T tangential_stiffness = T(0),
                               T friction = T(0), T restitution = T(1))
      : stiffness_(stiffness),
        tangential_(tangential_stiffness),
        friction_(friction),
        damping_(detail::damping_ratio(restitution, "LinearSpringDashpot")) {
    constexpr const char* self = "LinearSpringDashpot";
    require_positive(stiffness, self, "stiffness");
    require(std::isfinite(tangential_stiffness) && tangential_stiffness >= 0, self,
            "tangential_stiffness", tangential_stiffness, "must be finite and >= 0");
    require(std::isfinite(friction) && friction >= 0, self, "friction", friction,
            "must be finite and >= 0");
    require(friction == 0 || tangential_stiffness > 0, self, "tangential_stiffness",
            tangential_stiffness, "must be > 0 for friction to act");
  }

  T stiffness() const { return stiffness_; }  ///< k_n [N/m]
  T friction() const { return friction_; }    ///< mu [-]
  /// How long a free impact lasts [s]; a twentieth of it is a good step.
  /// @param effective_mass that of a point, see ContactMotion [kg], > 0; not checked. If a face with n
  ///                       points lands flat, 1 / (1/m_a + 1/m_b) / n
  T duration(T effective_mass) const {
    return detail::contact_time(damping_) * std::sqrt(effective_mass / stiffness_);
  }

  /// Force on b in the frame of the contact, normal first, f_n >= 0 [N]; zero if the gap is open.
  /// @param motion of the contact
  /// @param memory in and out: xi in the frame [m], zero if the gap is open
  template <class S>
  typename S::Vector force(const ContactMotion<S>& motion, typename S::Vector& memory) const {
    if (motion.gap >= 0) {
      memory.setZero();
      return S::Vector::Zero();
    }
    const T root = std::sqrt(motion.effective_mass);
    const T normal =
        std::max(T(0), -stiffness_ * motion.gap -
                           2 * damping_ * root * std::sqrt(stiffness_) * motion.velocity[0]);
    return detail::spring_friction<S>(motion, normal, tangential_,
                                      2 * damping_ * root * std::sqrt(tangential_), friction_,
                                      memory);
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(stiffness_, tangential_, friction_, damping_); }

  T stiffness_, tangential_, friction_, damping_;
};

}  // namespace moreau
