// SPDX-License-Identifier: MIT
// The attraction of a cohesive law in a step: an external force on the bodies (stage 2 of impulse_dynamics.hpp).
// The contact problem has the pushes of the contacts, which the law's solve() finds; between steps, contacts have
// the impulses on the bodies, which are the pushes less the attraction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/world/detail/step_context.hpp"

namespace moreau::detail {

/// The attraction between the bodies of each contact of a step, for an AttractiveLaw.
template <class S, class Law>
class Attraction {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;

  /// Applies the attraction to free velocities. It depends on the gaps as detected, although the overlap correction
  /// changes them afterwards.
  /// @param roots M^-1/2, one per body
  /// @param free  in, out: velocities without contacts, one per body [m/s, rad/s]
  void apply(const StepContext<S, Law>& context, std::span<const MobilityRoot<S>> roots,
             std::span<Twist> free) {
    const Contacts<S>& contacts = context.contacts;
    pulls_.resize(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      pulls_[c] = context.step * context.materials.laws()[contact.law].attraction(contact.gap);
      if (pulls_[c] == 0) continue;
      const Vector pull = -pulls_[c] * contact.frame.col(0);
      pull_body(roots[contact.b], contact.lever_b, pull, free[contact.b]);
      pull_body(roots[contact.a], contact.lever_a, -pull, free[contact.a]);
    }
  }
  /// From impulses on b to pushes against the attraction.
  void add_to(auto impulses) const {
    for (std::size_t c = 0; c < pulls_.size(); ++c) impulses[c][0] += pulls_[c];
  }
  /// From pushes to impulses on b.
  void take_from(auto impulses) const {
    for (std::size_t c = 0; c < pulls_.size(); ++c) impulses[c][0] -= pulls_[c];
  }
  /// The contacts of the step before with their pushes against the attraction that they had then.
  /// @param last_step h of the step before [s]
  const Contacts<S>& pushes_before(const StepContext<S, Law>& context, Scalar last_step) {
    pushes_ = context.previous;
    for (std::size_t c = 0; c < pushes_.size(); ++c) {
      const Contact<S>& contact = pushes_.points[c];
      pushes_.impulses[c][0] +=
          last_step * context.materials.laws()[contact.law].attraction(contact.gap);
    }
    return pushes_;
  }

 private:
  static void pull_body(const MobilityRoot<S>& root, const Vector& lever, const Vector& pull,
                        Twist& free) {
    linear<S>(free) += root.linear * (root.linear * pull);
    angular<S>(free) += root.angular * (root.angular * S::moment(lever, pull));
  }

  std::vector<Scalar> pulls_;  // one per contact: impulse of the attraction [N s]
  Contacts<S> pushes_;         // see pushes_before()
};

/// Under a law without attraction: does nothing.
template <class S, class Law>
struct NoAttraction {
  void apply(const auto&, const auto&, const auto&) const {}
  void add_to(const auto&) const {}
  void take_from(const auto&) const {}
  const Contacts<S>& pushes_before(const StepContext<S, Law>& context, const auto&) const {
    return context.previous;
  }
};

}  // namespace moreau::detail
