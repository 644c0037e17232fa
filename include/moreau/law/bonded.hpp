// SPDX-License-Identifier: MIT
// Bonds between bodies that break. A bond is one contact point, fixed to both bodies, with a couple beside the force.
// Let T be its tensile strength [N], h the step, p_n = r_n + h T. While it holds,
//
//     0 <= u_n  _|_  p_n >= 0,     |r_t| <= (S / T) p_n,     |m| <= (B / T) p_n,
//
// with u_t opposed to r_t and w opposed to m at the limits, u and w zero inside (rolling_resistance.hpp has w and m,
// R times a relative spin and couple / R). This is a cone with its apex at the tension T: without a normal force the
// shear strength is S, and the couple that bends or twists the bond is at most B R; compression makes both larger
// (Mohr-Coulomb). Compression alone does not break a bond. R is the effective radius of the contact,
// 1 / (1/R_a + 1/R_b), R_a and R_b being the distances from the centres of mass to the bond; a wall counts as plane.
//
// A brittle bond breaks in the step in which its impulse reaches the cone. With a fracture energy G > 0 it yields
// instead, with a strength s T, s S, s B that falls with the velocities (u_n, u_t, w) at which it yields,
//
//     ds/dt = -(T max(0, u_n) + S |u_t| + B |w|) / (2 G),
//
// and breaks at s = 0. In tension, shear, bending or twisting alone this is linear softening, and the bond dissipates
// G: in tension s = 1 - (opening) T / (2 G). Under compression friction dissipates more. The strength of a step is the
// mean over the opening of the step, of which the velocity at the end of the step is a part: softening is implicit, and
// a bond dissipates G whatever the step (BondList::find_strengths()).
//
// The pair of a broken bond is a contact with friction and resistance to rolling.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/limit_rounding.hpp"
#include "moreau/law/rolling_resistance.hpp"

namespace moreau {

/// The strength of a bond; the head of bonded.hpp has the equations.
template <std::floating_point T = double>
struct BondStrength {
  T tension;  ///< T > 0 [N]
  T shear;    ///< S > 0, without normal force [N]
  T bending;  ///< B > 0: largest couple over the effective radius, without normal force [N]
  T fracture_energy = 0;  ///< G >= 0 of a bond [J]; 0: brittle
};

/// Friction and rolling resistance between bodies, and bonds between those that were bonded
/// (Simulation::bond(), Simulation::bond_touching()). The head of this file has the equations. Model of BondingLaw.
template <std::floating_point T = double>
class Bonded : public RollingResistance<T> {
 public:
  /// See the concept of this name: of pairs without a bond. Bonds have their contacts without detection.
  using ActsWhereGapsClose = Bonded;
  /// @param strength of the bonds of the pair of materials
  /// @param friction mu >= 0 of bodies without bond [-]
  /// @param rolling  eta >= 0, resistance to rolling of bodies without bond [-]
  /// @throws std::invalid_argument outside these ranges
  explicit Bonded(const BondStrength<T>& strength, T friction = T(0), T rolling = T(0))
      : RollingResistance<T>(friction, rolling), strength_(strength) {
    constexpr const char* self = "Bonded";
    require_positive(strength.tension, self, "tension");
    require_positive(strength.shear, self, "shear");
    require_positive(strength.bending, self, "bending");
    require(std::isfinite(strength.shear / strength.tension), self, "shear / tension",
            strength.shear / strength.tension, "must be finite");
    require(std::isfinite(strength.bending / strength.tension), self, "bending / tension",
            strength.bending / strength.tension, "m must be finite");
    require(std::isfinite(strength.fracture_energy) && strength.fracture_energy >= 0, self,
            "fracture_energy", strength.fracture_energy, "must be finite and >= 0");
  }

  const BondStrength<T>& strength() const { return strength_; }  ///< of a bond

  static constexpr std::size_t variants = 2;  ///< see StatefulLaw: without bond, with a bond
  /// Whether variant k has a bond.
  static constexpr bool is_bonded(std::size_t k) { return k == 1; }
  /// See StatefulLaw: the law of contacts without bond, or that of p and m of bonds.
  Bonded variant(std::size_t k) const {
    if (!is_bonded(k)) return *this;
    return Bonded(strength_, strength_.shear / strength_.tension,
                  strength_.bending / strength_.tension);
  }
  /// See StatefulLaw. A step changes no variant: bonds break in the list of the simulation.
  template <class Vector>
  std::size_t variant_after(std::size_t k, const Vector&) const {
    return k;
  }
  /// See BondingLaw: whether the impulse of a bond lies on the cone.
  /// @param p (p_n, r_t, m) [N s]
  template <class Row>
  bool yields(const Row& p) const {
    return opens(p) || slips(p) || bends(p);
  }
  /// See BondingLaw: the part of a velocity in which a bond yields: opening, slip or rotation where the impulse is at the
  /// limit of each.
  /// @param w (u_n, u_t, w) [m/s]
  template <class Row>
  Row yielding(const Row& p, Row w) const {
    using S = SpaceOfTwist<Row>;
    if (!opens(p)) w[0] = 0;
    if (!slips(p)) w.template segment<S::dim - 1>(1).setZero();
    if (!bends(p)) angular<S>(w).setZero();
    return w;
  }
  /// See BondingLaw: how fast a bond that yields loses its strength; infinite if it is brittle [1/s].
  /// @param w (u_n, u_t, w), the velocity at which it yields [m/s]
  template <class Row>
  T softening(const Row& w) const {
    using S = SpaceOfTwist<Row>;
    if (!(strength_.fracture_energy > 0)) return std::numeric_limits<T>::infinity();
    return (strength_.tension * std::max(T(0), w[0]) +
            strength_.shear * w.template segment<S::dim - 1>(1).norm() +
            strength_.bending * angular<S>(w).norm()) /
           (2 * strength_.fracture_energy);
  }

 protected:
  Bonded() = default;  ///< to be read from a snapshot

 private:
  /// Whether the normal impulse of a bond is that of its tensile strength, its impulse that of its strength in shear, its couple
  /// that in bending. Without a push against the strength there is no other limit.
  template <class Row>
  static bool opens(const Row& p) {
    return !(p[0] > 0);
  }
  template <class Row>
  bool slips(const Row& p) const {
    using S = SpaceOfTwist<Row>;
    return strength_.tension * p.template segment<S::dim - 1>(1).norm() >=
           strength_.shear * within(p);
  }
  template <class Row>
  bool bends(const Row& p) const {
    return strength_.tension * angular<SpaceOfTwist<Row>>(p).norm() >=
           strength_.bending * within(p);
  }
  template <class Row>
  static T within(const Row& p) {
    return p[0] * (1 - detail::limit_rounding<T>);
  }

  friend struct SerializationAccess;
  auto serialized_members() {
    return std::tie(static_cast<RollingResistance<T>&>(*this), strength_);
  }

  BondStrength<T> strength_{1, 1, 1, 0};
};

}  // namespace moreau
