// SPDX-License-Identifier: MIT
// The attraction of a cohesive law in a step: an external force on the bodies (stage 2 of impulse_dynamics.hpp).
// The contact problem has the pushes of the contacts, which the law's solve() finds; between steps, contacts have
// the impulses on the bodies, which are the pushes less the attraction.
//
// The velocities after the step are those without contacts and attraction, changed by the impulses on the bodies
// (stage 9). As the sum of attraction and pushes, they would have the rounding of h T / m, where the attraction T of a
// strong bond is many orders of magnitude larger than the force that the bond transmits. This rounding differs from
// body to body, and the momentum of free bodies would not stay constant.
//
// If several processes share a body, each has a copy with a part of its mass, and applies the attraction of its own contacts to this
// copy. The mean of the copies is the body under the attraction of all contacts (solve/shared_bodies.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/world/detail/attraction_forces.hpp"
#include "moreau/world/detail/step_context.hpp"

namespace moreau::detail {

/// The attraction between the bodies of each contact of a step, for an AttractiveLaw.
template <class S, class Law>
class Attraction {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;
  using Impulse = typename ContactsOf<Law, S>::Impulse;

  /// Applies the attraction to free velocities. It depends on the gaps as detected, although the overlap correction
  /// changes them afterwards.
  /// @param bonds BondList of a law with bonds, which attract with their strength; NoBonds otherwise
  /// @param roots M^-1/2, one per body
  /// @param free  in, out: velocities without contacts, one per body [m/s, rad/s]
  void apply(const StepContext<S, Law>& context, [[maybe_unused]] const auto& bonds,
             std::span<const MobilityRoot<S>> roots, std::span<Twist> free) {
    const ContactsOf<Law, S>& contacts = context.contacts;
    if constexpr (BondingLaw<Law, S>)
      bonds.attractions(context.materials, contacts, pulls_);
    else
      attractions(context.bodies, context.materials, contacts, context.margin, pulls_);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      pulls_[c] *= context.step;
      if (pulls_[c] == 0) continue;
      const Vector pull = -pulls_[c] * contact.frame.col(0);
      pull_body(roots[contact.b], contact.lever_b, pull, free[contact.b]);
      pull_body(roots[contact.a], contact.lever_a, -pull, free[contact.a]);
    }
  }
  /// Sets the reference of the errors of the solver: the impulses h T of the attraction. Without bonds.
  /// @param velocity_of function: contact -> its relative velocity if the impulses on all bodies are 0 [m/s]
  void refer(const auto& velocity_of, ProblemAttraction<Scalar>& attraction) const {
    attraction.pulls.clear();
    attraction.velocity2 = attraction.rounding2 = 0;
    for (std::size_t c = 0; c < pulls_.size(); ++c) {
      if (pulls_[c] == 0) continue;
      if (attraction.pulls.empty()) attraction.pulls.assign(pulls_.begin(), pulls_.end());
      const double normal = double(velocity_of(c)[0]);
      attraction.velocity2 += normal * normal;
    }
  }
  void clear() { pulls_.clear(); }  ///< no contact attracts in this step
  /// Changes the attraction of a contact while the problem is being solved; offset() must follow.
  /// @param change of its impulse [N s]
  /// @param push   in, out: the unknown of the contact, which stays the same impulse on b [N s]
  void change(std::size_t c, Scalar change, const ContactsOf<Law, S>& contacts,
              std::span<const MobilityRoot<S>> roots, auto& push) {
    const Contact<S>& contact = contacts.points[c];
    const Vector pull = -change * contact.frame.col(0);
    changes_.resize(roots.size(), Twist::Zero());
    pull_body(roots[contact.b], contact.lever_b, pull, changes_[contact.b]);
    pull_body(roots[contact.a], contact.lever_a, -pull, changes_[contact.a]);
    pulls_[c] += change;
    push[0] += change;
  }
  /// Adds what change() has changed to the free velocities of bodies and contacts.
  /// @param free   in, out: one per body [m/s, rad/s]
  /// @param op     in, out: operator of contacts with couples
  /// @param shared by several processes, or null
  void offset(const ContactsOf<Law, S>& contacts, std::span<Twist> free, auto& op,
              SharedBodies* shared) {
    if (shared) {
      changes_.resize(free.size(), Twist::Zero());
      average_twists<S>(*shared, std::span<Twist>(changes_));
    }
    for (std::size_t i = 0; i < changes_.size(); ++i) free[i] += changes_[i];
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      const Twist &a = changes_[contact.a], &b = changes_[contact.b];
      if (a.isZero(0) && b.isZero(0)) continue;
      const typename S::Angular spin = angular<S>(b) - angular<S>(a);
      op.offset(c, op.row(c, relative_velocity(contact, a, b), spin));
    }
    changes_.clear();
  }
  /// From impulses on b to pushes against the attraction.
  void add_to(auto rows) const {
    for (std::size_t c = 0; c < pulls_.size(); ++c) rows[c][0] += pulls_[c];
  }
  /// From pushes to impulses on b.
  void take_from(auto impulses) const {
    for (std::size_t c = 0; c < pulls_.size(); ++c) impulses[c][0] -= pulls_[c];
  }
  /// The pushes of the contacts of the step before against the attraction that they had then, in their frames [N s].
  /// @param last_step h of the step before [s]
  const List<Impulse>& pushes_before(const StepContext<S, Law>& context,
                                     [[maybe_unused]] Scalar last_step) {
    if constexpr (BondingLaw<Law, S>) {  // bonds have no memory of impulses
      return context.previous.impulses;
    } else {
      pushes_before_ = context.previous.impulses;
      attractions(context.bodies, replaced_.empty() ? context.materials : replaced_[0],
                  context.previous, context.margin, pulls_before_);
      for (std::size_t c = 0; c < pushes_before_.size(); ++c)
        pushes_before_[c][0] += last_step * pulls_before_[c];
      return pushes_before_;
    }
  }
  /// The materials of the step before, which a user replaces.
  void keep(const Materials<Law>& materials) {
    if (replaced_.empty()) replaced_.push_back(materials);
  }
  void end_step() { replaced_.clear(); }
  /// Finds the changes of velocity by the impulses on b of the contacts, after take_from(). Their sums for a body are
  /// those of double precision: impulses of h T can cancel in these, too, as the forces inside of a cohesive cluster.
  /// @param op     the operator of the contacts, which stays as it is
  /// @param shared bodies that other processes share, or null
  /// @returns whether contacts attract in this step. If not, there are no such changes: the velocities of the operator
  ///          are those of the impulses on b
  bool find_changes(const ContactsOf<Law, S>& contacts, const auto& op, SharedBodies* shared) {
    const auto attracts = [](Scalar pull) { return pull != 0; };
    if (!shared && std::none_of(pulls_.begin(), pulls_.end(), attracts)) return false;
    momenta_.assign(op.body_count(), Sums::Twist::Zero());
    for (std::size_t c = 0; c < contacts.size(); ++c) add_momenta(contacts, c);
    by_impulses_.resize(momenta_.size());
    for (std::size_t i = 0; i < momenta_.size(); ++i) {
      const Twist momentum = momenta_[i].template cast<Scalar>();
      linear<S>(by_impulses_[i]) = op.inverse_mass(i).velocity_of(linear<S>(momentum));
      angular<S>(by_impulses_[i]) = op.inverse_mass(i).spin_of(angular<S>(momentum));
    }
    if (shared) average_twists<S>(*shared, std::span<Twist>(by_impulses_));
    return true;
  }
  /// The change of the velocity of a body, by find_changes() [m/s, rad/s].
  const Twist& change_of(std::size_t body) const { return by_impulses_[body]; }
  /// One per contact: impulse of the attraction; empty after clear() [N s].
  std::span<const Scalar> pulls() const { return pulls_; }

 private:
  using Sums = Space<S::dim>;  // of momenta

  /// Adds the momenta that the impulse of a contact gives both bodies.
  void add_momenta(const ContactsOf<Law, S>& contacts, std::size_t c) {
    const Contact<S>& contact = contacts.points[c];
    const auto& impulse = contacts.impulses[c];
    if (impulse.isZero(0)) return;
    const Vector in_world = contact.frame * linear<S>(impulse);
    const typename Sums::Vector push = in_world.template cast<double>();
    typename Sums::Twist &a = momenta_[contact.a], &b = momenta_[contact.b];
    linear<Sums>(b) += push;
    linear<Sums>(a) -= push;
    angular<Sums>(b) += Sums::moment(contact.lever_b.template cast<double>(), push);
    angular<Sums>(a) -= Sums::moment(contact.lever_a.template cast<double>(), push);
    if constexpr (RollingLaw<Law, S>) {
      const typename S::Angular turn = S::angular_frame(contact.frame) * angular<S>(impulse);
      const typename Sums::Angular couple = turn.template cast<double>();
      angular<Sums>(b) += couple;
      angular<Sums>(a) -= couple;
    }
  }
  static void pull_body(const MobilityRoot<S>& root, const Vector& lever, const Vector& pull,
                        Twist& free) {
    linear<S>(free) += root.linear * (root.linear * pull);
    angular<S>(free) += root.angular * (root.angular * S::moment(lever, pull));
  }

  friend struct moreau::SerializationAccess;
  auto serialized_members() { return std::tie(replaced_); }

  std::vector<Materials<Law>> replaced_;  // those of the step before, if they were replaced since
  List<Scalar> pulls_;                    // one per contact: impulse of the attraction [N s]
  List<Scalar> pulls_before_;             // one per contact of the step before: the attraction [N]
  List<Impulse> pushes_before_;           // one per contact of the step before
  List<Twist> changes_;                   // one per body: by change()
  List<Twist> by_impulses_;               // one per body: by find_changes()
  List<typename Sums::Twist> momenta_;    // one per body: by the impulses
};

/// Under a law without attraction: does nothing.
template <class S, class Law>
struct NoAttraction {
  void apply(const auto&, const auto&, const auto&, const auto&) const {}
  void add_to(const auto&) const {}
  void take_from(const auto&) const {}
  void keep(const auto&) const {}
  void end_step() const {}
  const auto& pushes_before(const StepContext<S, Law>& context, const auto&) const {
    return context.previous.impulses;
  }
  std::span<const typename S::Scalar> pulls() const { return {}; }
};

}  // namespace moreau::detail
