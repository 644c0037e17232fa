// SPDX-License-Identifier: MIT
// The contact problem of one step. At every contact c, in its own frame, normal first,
//
//     u = W r + b,        laws[law_of[c]] between u_c and r_c,
//
// with the relative velocities u [m/s], the impulses r [N s], the Delassus operator W [1/kg] and
// the relative velocities b without any impulse [m/s].
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau {

namespace detail {

/// The attraction in a contact problem (law/cohesive.hpp, law/bonded.hpp). The unknown p = r + h T of a contact that
/// attracts with the force T is the push against it. At a contact without load p is h T. The load r can be much smaller
/// than p: errors are relative to r.
template <class T>
struct ProblemAttraction {
  std::vector<T>
      pulls;  ///< one per contact: h T, 0 of one that does not attract [N s]; empty if none does
  /// Sum over the contacts that attract of u_n^2 with r = 0, of |u|^2 for a bond [m^2/s^2].
  double velocity2 = 0;
  /// The same of the rounding of b: in a closed row of bonds no motion makes up for it [m^2/s^2].
  double rounding2 = 0;
};
/// Of a law without attraction.
struct NoProblemAttraction {};

}  // namespace detail

/// The problem that a ContactSolver solves; the head of this file has the equations. Kept from step to step, so
/// that its memory is used again.
/// @tparam Operator BodyDelassus; with couples for a law with couples
/// @tparam Law      a SetValuedLaw in the space of the operator
template <class Operator, class Law>
struct ContactProblem {
  using Space = typename Operator::Space;
  using Scalar = typename Operator::Scalar;
  using Vector = typename Operator::Vector;  ///< one contact's rows of u, r and b

  Operator delassus;           ///< W and b; carries u under the impulses applied so far
  std::vector<Law> laws;       ///< the table of laws
  List<std::uint32_t> law_of;  ///< one per contact: its entry in the table
  /// Rounding of the velocities of the bodies, one per body, from which b is computed [m/s]; empty: not known. Smaller
  /// errors are neglected: if bodies touch and fall together, b is only rounding.
  List<Scalar> rounding = {};
  /// Velocities that the loads of the step give the bodies, one per body, g h under gravity alone [m/s]; empty: not known.
  List<Scalar> load = {};
  /// Velocities of the bodies without impulses, from which b is computed, one per body, (v, w) in world axes [m/s, rad/s];
  /// in single precision only; empty: not known.
  List<typename Space::Twist> free = {};
  /// What the open gaps add to b_n, gap / h, one per contact, >= 0 [m/s]; under Coulomb's law, with couples or without; empty:
  /// not known.
  List<Scalar> gap_velocity = {};
  /// The attraction of the contacts, if the law is an AttractiveLaw.
  [[no_unique_address]] std::conditional_t<
      AttractiveLaw<Law, Space>, detail::ProblemAttraction<Scalar>, detail::NoProblemAttraction>
      attraction = {};

  /// Errors of a body are relative to at least this share of the velocity that the loads of the step give to it [-].
  static constexpr double least_share = 0.01;

  /// The velocity that the errors of a body are relative to at least: by its loads, and by its rounding over the
  /// tolerance [m/s]; 0 if these are not known.
  /// @param tolerance on the error of the velocities, relative [-]
  MOREAU_INLINED double least_scale(std::uint32_t body, double tolerance) const {
    if (load.empty()) return 0;
    return std::max(double(rounding[body]) / tolerance, least_share * double(load[body]));
  }
  /// Whether a contact closes so fast that loads alone would take several steps to make it: in an impact.
  /// @param closing velocity without contact impulses [m/s]
  /// @param of_load the velocity that loads give to its bodies in the step, see `load` [m/s]
  static constexpr bool is_impact(double closing, double of_load) { return closing > 3 * of_load; }

  std::size_t size() const { return delassus.size(); }  ///< contacts
  /// The law of contact c < size(), which is not checked.
  const Law& law(std::size_t c) const { return laws[law_of[c]]; }
  /// Whether contact c < size(), which is not checked, is a bond: bonds attract, and other contacts of a law with bonds do not.
  bool is_bond([[maybe_unused]] std::size_t c) const {
    if constexpr (BondingLaw<Law, Space>)
      return !attraction.pulls.empty() && attraction.pulls[c] != 0;
    else
      return false;
  }
};

namespace detail {

/// Sets the impulses to those of bodies that no contact moves: zero, and h T where contacts attract.
template <class Operator, class Law>
void clear_impulses(const ContactProblem<Operator, Law>& problem,
                    std::span<typename Operator::Vector> impulses) {
  std::fill(impulses.begin(), impulses.end(), Operator::Vector::Zero());
  if constexpr (AttractiveLaw<Law, typename Operator::Space>)
    for (std::size_t c = 0; c < problem.attraction.pulls.size(); ++c)
      impulses[c][0] = problem.attraction.pulls[c];
}

/// Leaves the operator with the velocities of these impulses alone. Velocities that are made of
/// many small changes carry the rounding of each; these do not.
/// @param shared bodies that contact problems of other processes share; null: none
template <class Operator>
void set_impulses(Operator& delassus, std::span<const typename Operator::Vector> impulses,
                  SharedBodies* shared = nullptr) {
  delassus.clear();
  for (std::size_t c = 0; c < delassus.size(); ++c) {
    if (impulses[c].isZero(0)) continue;
    delassus.push(c, impulses[c]);
  }
  delassus.move();
  if constexpr (requires { delassus.move_cell(impulses); }) delassus.move_cell(impulses);
  if (shared) shared->average(delassus.velocity_changes(), Operator::width);
}

/// Sets impulses to zero whose squares are not finite.
template <class Vector>
void drop_if_not_finite(std::span<Vector> impulses) {
  for (Vector& impulse : impulses)
    if (!std::isfinite(impulse.template cast<double>().squaredNorm())) impulse.setZero();
}

}  // namespace detail

}  // namespace moreau
