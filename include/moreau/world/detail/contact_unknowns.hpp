// SPDX-License-Identifier: MIT
// The unknowns r of the contact problem, one row per contact, and the impulses and couples of
// Contacts, from which they start and to which they return.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "moreau/contact/detail/warm_start.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/concepts.hpp"

namespace moreau::detail {

/// Fills the impulses from those of the step before: the first guess of rigid contacts, the memory of
/// the springs of compliant contacts. Where the features of a pair have changed names, impulses go to the nearest
/// contact.
/// @param turn how springs turn since the step before
/// @param team threads that share the work
/// @returns how many contacts have a predecessor
template <class Law, class S>
std::size_t start(const Contacts<S>& previous, Contacts<S>& contacts,
                  [[maybe_unused]] const SpringTurn<S>& turn, const Team& team) {
  if constexpr (CompliantLaw<Law, S>) {
    const std::size_t found = remember_springs(previous, contacts, turn, team);
    hand_over(previous, contacts, turn);
    return found;
  } else {
    const std::size_t found = warm_start(previous, contacts, team);
    hand_over(previous, contacts, turned<S>);
    return found;
  }
}

/// The unknowns of a law that acts at points: the impulses of the contacts themselves.
template <class S, class Law>
class PointUnknowns {
 public:
  using Operator = OperatorOf<Law, S>;

  static const BodyDelassus<S>& points(const Operator& op) { return op; }
  std::size_t start(const Operator&, const Contacts<S>& previous, Contacts<S>& contacts,
                    const SpringTurn<S>& turn, const Team& team) {
    return detail::start<Law>(previous, contacts, turn, team);
  }
  static std::span<typename S::Vector> impulses(Contacts<S>& contacts) { return contacts.impulses; }
  static void finish(const Operator&, Contacts<S>&) {}
};

/// The unknowns of a law with couples: (impulse, couple / R) of every contact in one vector.
template <class S, class Law>
class RollingUnknowns {
 public:
  using Operator = OperatorOf<Law, S>;

  static const BodyDelassus<S>& points(const Operator& op) { return op.points(); }
  std::size_t start(const Operator& op, const Contacts<S>& previous, Contacts<S>& contacts,
                    const SpringTurn<S>& turn, const Team& team) {
    const std::size_t found = detail::start<Law>(previous, contacts, turn, team);
    carry_couples(previous, contacts, previous.couples, contacts.couples,
                  [&](const Contact<S>& before, const Contact<S>& now) -> typename S::Matrix {
                    if constexpr (CompliantLaw<Law, S>)
                      return turn.axes(before, now);
                    else
                      return before.frame;
                  });
    unknowns_.resize(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      linear<S>(unknowns_[c]) = contacts.impulses[c];
      angular<S>(unknowns_[c]) = contacts.couples[c] / op.radius(c);
    }
    return found;
  }
  std::span<typename Operator::Vector> impulses(Contacts<S>&) { return unknowns_; }
  void finish(const Operator& op, Contacts<S>& contacts) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      contacts.impulses[c] = linear<S>(unknowns_[c]);
      contacts.couples[c] = op.radius(c) * angular<S>(unknowns_[c]);
    }
  }

 private:
  std::vector<typename Operator::Vector> unknowns_;
};

/// The unknowns of a law:
///
/// - points(operator): the part of the operator that acts at points
/// - start(operator, previous, contacts, turn, team): warm start; returns how many contacts have a
///   predecessor
/// - impulses(contacts): the unknowns r, one per contact
/// - finish(operator, contacts): writes r to the impulses and couples of the contacts
template <class S, class Law>
using ContactUnknowns =
    std::conditional_t<RollingLaw<Law, S>, RollingUnknowns<S, Law>, PointUnknowns<S, Law>>;

}  // namespace moreau::detail
