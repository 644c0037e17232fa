// SPDX-License-Identifier: MIT
// Elastic spheres: Hertz's normal force and Mindlin's tangential stiffness without micro-slip, with
// dashpots that give a restitution that does not depend on the speed (Y. Tsuji, T. Tanaka and
// T. Ishida, Powder Technol. 71 (1992) 239):
//
//     s_n = 2 E sqrt(R d),  s_t = 8 G sqrt(R d),     d = -g the overlap
//     f_n = max(0, 2/3 s_n d - c_n u_n),             f_t = -s_t xi - c_t u_t, |f_t| <= mu f_n
//     c = 2 sqrt(5/6) beta sqrt(s m),                e = exp(-2 beta acos(beta)/sqrt(1 - beta^2))
//
// R and m are the effective radius and mass of the contact (ContactMotion), E and G the effective moduli
// of the two materials. In the plane, and for shapes that are no spheres, the distance of the contact
// point from the centre of mass stands in for the radius.
//
// s_t changes with the overlap. While the overlap grows, the force s_t xi persists: new area of contact is
// free of shear, so xi is scaled by s_t before / s_t. While it shrinks, xi persists. In both cases the energy of
// the spring s_t xi^2/2 does not grow, so that no cycle of shear and compression makes energy (C.
// Thornton, S. J. Cummins and P. W. Cleary, Powder Technol. 233 (2013) 30, section 2).
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/regularized.hpp"

namespace moreau {

/// Hertz's and Mindlin's elastic contact with Coulomb's limit; the head of this file has its
/// equations and their source. Model of RegularizedLaw.
template <std::floating_point T = double>
class HertzMindlin {
 public:
  /// @param young       effective modulus E, 1/E = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b, > 0 [Pa]
  /// @param shear       effective modulus G, 1/G = (2 - nu_a)/G_a + (2 - nu_b)/G_b, >= 0 [Pa];
  ///                    > 0 where there is friction
  /// @param friction    mu >= 0 [-]
  /// @param restitution e in [0, 1] [-]; at least 0.135
  /// @throws std::invalid_argument outside these ranges
  explicit HertzMindlin(T young = T(1e7), T shear = T(0), T friction = T(0), T restitution = T(1))
      : young_(young),
        shear_(shear),
        friction_(friction),
        damping_(detail::damping_ratio(restitution, "HertzMindlin")) {
    constexpr const char* self = "HertzMindlin";
    require_positive(young, self, "young");
    require(std::isfinite(shear) && shear >= 0, self, "shear", shear, "must be finite and >= 0");
    require(std::isfinite(friction) && friction >= 0, self, "friction", friction,
            "must be finite and >= 0");
    require(friction == 0 || shear > 0, self, "shear", shear, "must be > 0 for friction to act");
  }

  /// The law between two pieces of one isotropic material.
  /// @param young       Young's modulus of the material, > 0 [Pa]
  /// @param poisson     Poisson's ratio, in (-1, 1/2] [-]
  /// @param friction    mu >= 0 [-]
  /// @param restitution e in [0, 1] of a central impact [-]; at least 0.135
  /// @returns the law with E = young / (2 (1 - poisson^2)) and G = shear / (2 (2 - poisson)), where
  ///          shear = young / (2 (1 + poisson)) [Pa]
  /// @throws std::invalid_argument outside these ranges, or for a number that is not finite
  static HertzMindlin of_material(T young, T poisson, T friction, T restitution) {
    require_positive(young, "HertzMindlin::of_material", "young");
    require(poisson > T(-1) && poisson <= T(0.5), "HertzMindlin::of_material", "poisson", poisson,
            "must lie in (-1, 0.5]");
    const T shear = young / (2 * (1 + poisson));
    return HertzMindlin(young / (2 * (1 - poisson * poisson)), shear / (2 * (2 - poisson)),
                        friction, restitution);
  }

  T young() const { return young_; }        ///< E, effective [Pa]
  T shear() const { return shear_; }        ///< G, effective [Pa]
  T friction() const { return friction_; }  ///< mu [-]
  /// How long an impact without loss lasts, 2.87 (m^2 / (R E^2 v))^(1/5) [s]; a twentieth of it is a good step. With
  /// loss it is longer, by a quarter with a restitution of 0.3.
  /// @param effective_mass,effective_radius m and R of the point, see ContactMotion [kg; m], > 0; not checked
  /// @param speed                           v of the approach [m/s]; infinite for 0
  T duration(T effective_mass, T effective_radius, T speed) const {
    return T(2.8683) *
           std::pow(effective_mass * effective_mass / (effective_radius * young_ * young_ * speed),
                    T(0.2));
  }

  /// Force on b in the frame of the contact, normal first, f_n >= 0 [N]; zero if the gap is open.
  /// @param motion of the contact; its effective mass and radius are m and R
  /// @param memory in and out: first sqrt(R d) of the call before, then xi in the frame [m]; zero if the
  ///               gap is open
  template <class S>
  typename S::Vector force(const ContactMotion<S>& motion, typename S::Vector& memory) const {
    if (motion.gap >= 0) {
      memory.setZero();
      return S::Vector::Zero();
    }
    const T depth = -motion.gap, width = std::sqrt(motion.effective_radius * depth);
    const T normal_stiffness = 2 * young_ * width, tangential_stiffness = 8 * shear_ * width;
    const T damping = 2 * std::sqrt(T(5) / T(6)) * damping_;
    const T normal =
        std::max(T(0), T(2) / T(3) * normal_stiffness * depth -
                           damping * std::sqrt(normal_stiffness * motion.effective_mass) *
                               motion.velocity[0]);
    if (width > memory[0]) memory.template tail<S::dim - 1>() *= memory[0] / width;
    const typename S::Vector force = detail::spring_friction<S>(
        motion, normal, tangential_stiffness,
        damping * std::sqrt(tangential_stiffness * motion.effective_mass), friction_, memory);
    memory[0] = width;
    return force;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(young_, shear_, friction_, damping_); }

  T young_, shear_, friction_, damping_;
};

}  // namespace moreau
