// SPDX-License-Identifier: MIT
// Elastic springs in series with a set-valued law, integrated implicitly.
//
// The contact problem of rigid grains in a jammed packing has no unique impulses: W is singular, and
// the number of sweeps that a tolerance takes grows as 1 / tolerance. Real contacts are elastic. With
// one normal and one tangential spring per contact point, of stiffness k_n and k_t [N/m], the matrix
// of the problem is well conditioned: its condition number is bounded by the number of contacts of a
// body over
//
//     eps = C_n / (h^2 W_nn),        C_n = 1 / k_n,    h the time step,
//
// whatever the number of grains. Without friction the impulses are then unique; with friction they
// need not be, because Coulomb's law is not associated (tests/solve/compliant.cpp has examples).
//
// Derivation. Let f = r / h be the mean force of the step. The normal spring is compressed by C_n f_n;
// the surfaces touch when the gap g of the rigid shapes equals minus that compression. With the gap
// at the next detection, g + h u_n, Signorini's condition reads
//
//     0 <= g + h u_n + C_n f_n   _|_   f_n >= 0.
//
// The tangential spring is stretched by -C_t f_t. The sliding velocity is the relative velocity less
// the rate at which the spring is stretched; over a step (implicit Euler)
//
//     slip = u_t + C_t (f_t - f_t of the step before) / h.
//
// Divided by h, with c = C / h^2 [1/kg], s = (h / h of the step before) times the impulse of the step
// before, of which the tangential part is turned into the frame of this one:
//
//     normal      0 <= u_n + g / h + c_n r_n   _|_   r_n >= 0,
//     tangential  u_t + c_t (r_t - s_t) = -lambda r_t / |r_t|  or  0,      |r_t| <= mu r_n:
//
// the law below, with W + D in place of W, D = diag(c_n, c_t[, c_t]), and a free velocity to which
// (g / h, -c_t s_t) is added. An error of the solver in one step acts as a force in the next, because the memory of
// the springs is the impulses and the gap; errors do not add up.
//
// If the step changes, from h' to h, the springs must follow the motion of the bodies. With the parameter theta of the
// integrator (motion/moreau_jean.hpp) contacts are detected where the bodies are the time a = (1 - theta) h after the start of
// the step. If u' is the velocity after the step before, and u that before this one (the same, unless it was set), the contact
// moves between the two detections by (h' - a') u' + a u, and its springs have followed h' u'. The difference
//
//     d = a u - a' u'
//
// is in the gap, and springs whose memory is the impulse get d / h added to their sliding velocity. Without it these
// differences would add up: a block on its tangential springs would stay displaced from where its load holds it.
//
// The step from one detection to the next is implicit Euler, which takes energy from a spring whatever h is, but for d = (a - a') v,
// a step of explicit Euler. With the stretch y that the step before has found, the stiffness k, the mass m and x = h' omega,
// omega^2 = k / m, the energy of the spring and its body changes in both by
//
//     -x^2 (k y^2 + m v^2) / 2 + k y d + k d^2 / 2.
//
// If |a - a'| is at most h' / 2, this is not positive for any y and v if x >= 1 / sqrt(3); steps with a smaller x resolve the
// oscillation of the spring. The library therefore requires a <= a' + h' / 2. If h is more than twice h', theta is larger in this one
// step so that the condition is satisfied. A step that shrinks satisfies it, because a' is at most h' / 2. Bodies that no impulse moves get
// the position that belongs to the theta of the user, so that free flight keeps its order.
//
// With restitution e > 0 a contact acts only where g <= 0 and the memory of the normal spring is the
// impulse, like that of the tangential one:
//
//     0 <= u_n + e min(0, u_n before) + c_n (r_n - s_n)   _|_   r_n >= 0.
//
// An impact then has the restitution e + O(eps). With e = 0 the springs return at most a share eps of
// an impact's velocity, because implicit Euler damps what the step does not resolve.
//
// If the number of contact points of the pair changes, and with it C, all entries of s are multiplied by
// sqrt(C before / C), so that the springs keep their energy. With e = 0 the tangential springs keep their force.
//
// Under a law that attracts with the force T, p = r + h T n takes the place of r, and s is that of p
// (world/detail/pushes.hpp): the springs carry the push against the attraction. The spring force of a bond follows from the
// stretch of the bond (world/detail/bonds/bond_list.hpp), not from an impulse of the step before. When the bond breaks, the energy of
// its springs is dissipated, and the contact of its pair starts without load.
//
// Source of springs as a regularization with one diagonal matrix for stiffness and step: C.
// Lacoursiere, Ghosts and Machines: Regularized Variational Methods for Interactive Simulations of
// Multibodies with Dry Frictional Contacts, PhD thesis, Umea University, 2007.
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/signorini_coulomb.hpp"

namespace moreau {
namespace detail {

/// Arguments of which no Made (a law with springs) can be constructed: neither another Made nor a law and one or two
/// stiffnesses.
template <class First, class Made, class Law, class Scalar, class... More>
concept NoLawAndStiffness =
    !std::derived_from<First, Made> && (sizeof...(More) == 0 || sizeof...(More) > 2 ||
                                        !std::conjunction_v<std::is_convertible<First, const Law&>,
                                                            std::is_convertible<More, Scalar>...>);

}  // namespace detail

/// A set-valued law with elastic springs in series; the head of this file has its equations. The
/// stiffness is that of a pair of bodies: if the pair has n contact points, each has 1/n of it, so
/// that the stiffness of a contact between faces does not depend on the number of its points. Open
/// points count in part, from 1 where they touch to 0 at a gap of 2 % of the grain size, or of the
/// margin if the margin is smaller.
/// All points of a contact between faces are used, unless Simulation::set_contact_points() says few.
/// Model of CompliantLaw.
/// @tparam Law    the set-valued law: SignoriniCoulomb, Frictionless, Cohesive, RollingResistance,
///                Bridged, Bonded
/// @tparam Scalar its scalar
template <class Law = SignoriniCoulomb<>,
          std::floating_point Scalar = typename detail::ImpulseScalar<Law>::type>
class Compliant : public Law {
  static_assert(!detail::HasSprings<Law>, "Compliant<Law>: Law has springs of its own");
  static_assert(
      detail::GivesImpulses<Law, Scalar>,
      "Compliant<Law>: Law gives no impulses (velocity_offset) in the scalar of Compliant");
  static_assert(
      RestitutionLaw<Law> || !requires(Law & law) { law.restitution(); },
      "Compliant<Law>: restitution() of Law must be const and return a number");

 public:
  /// @param law                  the law in series with the springs
  /// @param stiffness            k_n > 0, normal [N/m]; in the plane per unit of what the densities
  ///                             are per
  /// @param tangential_stiffness k_t > 0 [N/m]; also of the springs of rolling, k_t R^2 [N m]
  /// @throws std::invalid_argument outside these ranges
  Compliant(const Law& law, Scalar stiffness, Scalar tangential_stiffness)
      : Law(law), stiffness_(stiffness), tangential_(tangential_stiffness) {
    require_positive(stiffness, "Compliant", "stiffness");
    require_positive(tangential_stiffness, "Compliant", "tangential_stiffness");
  }
  /// With k_t = k_n.
  Compliant(const Law& law, Scalar stiffness) : Compliant(law, stiffness, stiffness) {}

  /// Other arguments end in one sentence.
  template <class First, class... More>
  requires detail::NoLawAndStiffness<First, Compliant, Law, Scalar, More...>
  explicit Compliant(const First&, const More&...) {
    static_assert(sizeof...(More) > 99,
                  "Compliant: the arguments are a law and its stiffness k_n, or k_n and k_t [N/m]: "
                  "Compliant<Law>(Law(0.4), 1e6, 5e5)");
  }

  Scalar stiffness() const { return stiffness_; }                   ///< k_n [N/m]
  Scalar tangential_stiffness() const { return tangential_; }       ///< k_t [N/m]
  Scalar normal_compliance() const { return 1 / stiffness_; }       ///< C_n [m/N]
  Scalar tangential_compliance() const { return 1 / tangential_; }  ///< C_t [m/N]
  /// Whether the law has a restitution; see CompliantLaw.
  bool keeps_normal_impulse() const {
    if constexpr (RestitutionLaw<Law>)
      return Law::restitution() > 0;
    else
      return false;
  }

  /// Offset of u_n [m/s]: g / h without restitution, that of the law with restitution.
  /// @param gap    g [m], < 0 is the compression of the normal spring
  /// @param before u_n before the step [m/s], > 0 separates
  /// @param step   h [s], > 0
  Scalar velocity_offset(Scalar gap, Scalar before, Scalar step) const {
    return keeps_normal_impulse() ? Law::velocity_offset(gap, before, step) : gap / step;
  }
  /// See StatefulLaw.
  Compliant variant(std::size_t k) const requires requires(const Law& law) {
    { law.variant(k) } -> std::same_as<Law>;
  }
  { return Compliant(Law::variant(k), stiffness_, tangential_); }

 private:
  friend struct SerializationAccess;
  Compliant() = default;  // to be read from a snapshot
  auto serialized_members() { return std::tie(static_cast<Law&>(*this), stiffness_, tangential_); }

  Scalar stiffness_ = 0, tangential_ = 0;
};

}  // namespace moreau
