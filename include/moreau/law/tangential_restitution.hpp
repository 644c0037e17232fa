// SPDX-License-Identifier: MIT
// Coulomb friction with a restitution along the normal and one across it, for impacts of grains: Walton's model with
// three constants, the restitution e, the friction mu and the tangential restitution beta0.
//
//   0 <= u_n + e u_n^-  _|_  r_n >= 0,
//   |r_t| <= mu r_n,   u_t + beta0 u_t^- = -alpha r_t with alpha >= 0,  alpha = 0 inside the cone.
//
// u^- is the relative velocity before the step, u that after it. Between two spheres, or a sphere and a wall, W has no
// entry that couples normal and tangent. An impact then ends with u_t = -beta0 u_t^- (the contact sticks and its
// tangential elasticity returns a part), unless that takes more than mu r_n; else with r_t = -mu r_n u_t^- / |u_t^-|
// (it slides). These are the two branches of O. R. Walton (Numerical simulation of inelastic, frictional particle-particle
// interactions, in M. C. Roco, ed., Particulate Two-Phase Flow, 1993), whose constants S. F. Foerster, M. Y. Louge, H.
// Chang and K. Allia measured (Phys. Fluids 6 (1994) 1108).
//
// The local problem is that of Coulomb's law with e u_n^- and beta0 u_t^- added to the velocity without impulse, so
// that its solution is exact.
//
// Where it acts. An impact is a closed gap, g <= 0, whose bodies approach, u_n^- < 0. A contact that rests or slides
// has u_n^- = 0 and obeys Coulomb's law without restitution. Where it slides with u_n^- < 0 by a rounding, the term has
// the direction of the slip and changes nothing.
//
// Polytopes. Each contact point that closes is an impact of its own, with u_t^- of that point: a vertex that hits a
// face is what a sphere is. If several points of a pair close in one step, each asks for its own -beta0 u_t^-, which a
// motion of the rigid body gives to all at once. But a face that lands askew hits with one vertex after the other, and
// beta0 was measured in single impacts of spheres: no publication is known that gives it for faces.
//
// Energy. At a contact with coupling, or where several contacts of a body act at once, the law alone could add energy.
// Simulation limits the impulses so that a step adds none (world/detail/restitution_limit.hpp).
//
// With springs in series the contact would have two tangential restitutions. Compliant<TangentialRestitution> is
// refused.
#pragma once

#include <concepts>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/signorini_coulomb.hpp"

namespace moreau {

/// Signorini's condition with Coulomb friction, restitution and tangential restitution for one pair of materials; the
/// head of this file has its equations. Model of LaneLaw and TangentialRestitutionLaw.
template <std::floating_point T = double>
class TangentialRestitution : public SignoriniCoulomb<T> {
 public:
  /// @param friction    mu >= 0 [-]
  /// @param restitution e in [0, 1] [-]: u_n = -e u_n^- at an impact
  /// @param tangential  beta0 in [0, 1] [-]: u_t = -beta0 u_t^- at an impact that does not slide
  /// @throws std::invalid_argument outside these ranges
  explicit TangentialRestitution(T friction = T(0), T restitution = T(0), T tangential = T(0))
      : SignoriniCoulomb<T>(friction, restitution), tangential_(tangential) {
    require(tangential >= T(0) && tangential <= T(1), "TangentialRestitution", "tangential",
            tangential, "must lie in [0, 1]");
  }

  T tangential_restitution() const { return tangential_; }  ///< beta0 [-]

  /// Offset of u_n [m/s]: e min(0, u_n^-) where the gap is closed. A contact does not anticipate its gap, also if e is
  /// 0: the step in which the gap closes is the impact.
  /// @param gap    g [m], < 0 is penetration
  /// @param before u_n before the step [m/s], > 0 separates
  /// @returns infinity if the contact cannot act in this step
  T velocity_offset(T gap, T before, T) const {
    return detail::impact_offset(this->restitution(), gap, before);
  }
  /// Share of u_t before the step that is added to u_t [-], see TangentialRestitutionLaw.
  /// @param gap    g [m], < 0 is penetration
  /// @param before u_n before the step [m/s], > 0 separates
  T tangential_share(T gap, T before) const {
    return gap <= T(0) && before < T(0) ? tangential_ : T(0);
  }

  /// There is no static friction: the law has no variants.
  TangentialRestitution variant(std::size_t) const = delete;

 private:
  friend struct SerializationAccess;
  auto serialized_members() {
    return std::tie(static_cast<SignoriniCoulomb<T>&>(*this), tangential_);
  }

  T tangential_;
};

}  // namespace moreau
