// SPDX-License-Identifier: MIT
// How a bond yields in a step, and its strength meanwhile (bond_list.hpp). The velocity at which it yields is that of its
// bodies, less that of its springs, without the correction of a rigid bond, which counts the motion up to detection as an
// error. Where the bond does not yield, the correction goes on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/core/twist.hpp"
#include "moreau/law/limit_rounding.hpp"
#include "moreau/solve/concepts.hpp"

namespace moreau::detail {

/// A bond in the solution of the contact problem of a step.
template <class S, class Law>
struct LoadedBond {
  using Scalar = typename S::Scalar;
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;

  const Law& law;
  const Operator& op;   ///< with the velocities of the impulses
  std::size_t contact;  ///< of the bond
  const Row& push;      ///< p of the contact, see pushes.hpp [N s]
  const Row& drift;     ///< the correction in the offset of a rigid bond [m/s]
  Scalar step;          ///< h [s]

  /// p without what is rounding beside the strength of the bond.
  Row load() const {
    Row p = push;
    if (p[0] <= limit_rounding<Scalar> * step * law.strength().tension) p[0] = 0;
    return p;
  }
  /// The velocity between its bodies, less that of its springs.
  Row velocity() const { return op.velocity(contact) - drift; }
  /// The velocity at which the bond yields under the load p.
  Row yielding(const Row& p) const { return law.yielding(p, velocity()); }
  /// The strength in the step of a bond that had the strength s before. Let x be the share that it loses by its velocity. It
  /// is the mean over the opening, s - x / 2, or s^2 / (2 x) if the bond breaks: so it dissipates the area under the line of
  /// softening, whatever the step.
  Scalar strength_in_step(Scalar s) const {
    const Row p = load();
    if (!law.yields(p)) return s;
    const Scalar x = step * law.softening(yielding(p));
    return !std::isfinite(x) ? s : x < s ? s - x / 2 : s * s / (2 * x);
  }
};

/// How a bond yields in a step: a step that is repeated with more contacts must not have changed the bond.
template <class S>
struct BondYield {
  typename S::Scalar loss = 0;                    ///< of its strength [-]
  typename S::Vector slip = S::Vector::Zero();    ///< in the frame of the bond [m]
  typename S::Angular bend = S::Angular::Zero();  ///< the same [rad]
  /// Velocity between the bodies of a bond that does not yield: the correction and what the solver leaves, in the frame of the bond [m/s].
  typename S::Vector opening = S::Vector::Zero();
  typename S::Angular turning = S::Angular::Zero();  ///< the same [rad/s]
};
/// @param frame of the bond, world axes
template <class S, class Law>
BondYield<S> yield_of(const LoadedBond<S, Law>& bond, const typename S::Matrix& frame) {
  using Vector = typename S::Vector;
  BondYield<S> yield;
  const auto p = bond.load();
  const auto& of_contact = bond.op.frame(bond.contact);
  const typename S::Matrix turned = frame.transpose() * of_contact;
  const auto opening_of = [&](const auto& w) { return Vector(turned * linear<S>(w)); };
  const auto turning_of = [&](const auto& w) {
    return typename S::Angular(S::angular_frame(frame).transpose() *
                               (S::angular_frame(of_contact) * angular<S>(w)) /
                               bond.op.radius(bond.contact));
  };
  if (!bond.law.yields(p)) {
    const auto w = bond.velocity();
    yield.opening = opening_of(w);
    yield.turning = turning_of(w);
    return yield;
  }
  const auto w = bond.yielding(p);
  yield.loss = bond.step * bond.law.softening(w);
  yield.slip = bond.step * opening_of(w);
  yield.bend = bond.step * turning_of(w);
  return yield;
}

/// The search for the strength in the step for which the problem is solved. A secant step makes that for one bond end
/// after two solutions.
template <class Scalar>
struct Softening {
  Scalar now = -1,
         found =
             -1;  ///< the strength in the last solution, and that which belongs to it; < 0: none
  Scalar change = 0;  ///< of the impulse of the attraction, for the next solution [N s]

  /// @param pull impulse of the attraction in the solution [N s]
  /// @param full the same of a bond with its whole strength [N s]
  /// @param belongs strength in the step that belongs to the solution
  /// @param most strength before the step
  /// @returns the impulse that the solution lacks [N s]
  Scalar go_on(Scalar pull, Scalar full, Scalar belongs, Scalar most) {
    const Scalar share = pull / full;
    // Equal to rounding: T h s, divided by T h, is not s to the last bit.
    if (std::abs(belongs - share) <= 4 * std::numeric_limits<Scalar>::epsilon() * most)
      belongs = share;
    const Scalar slope = found < 0 || share == now ? Scalar(0) : (belongs - found) / (share - now);
    const Scalar next = share + (belongs - share) / (1 - std::clamp(slope, Scalar(0), Scalar(0.9)));
    const Scalar kept = std::clamp(next, Scalar(0), most);
    now = share;
    found = belongs;
    change = found == now ? Scalar(0) : full * (kept - now);
    return full * (found - now);
  }
};

}  // namespace moreau::detail
