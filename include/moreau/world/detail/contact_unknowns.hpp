// SPDX-License-Identifier: MIT
// The unknowns r of the contact problem, from the impulses and couples of the step before to those of this step.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "moreau/contact/warm_start.hpp"
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

/// The rows r of the contact problem, one per contact.
template <class S, class Law>
class ContactUnknowns {
 public:
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;

  /// Warm start.
  /// @returns how many contacts have a predecessor
  std::size_t start([[maybe_unused]] const Operator& op, const Contacts<S>& previous,
                    Contacts<S>& contacts, const SpringTurn<S>& turn, const Team& team) {
    const std::size_t found = detail::start<Law>(previous, contacts, turn, team);
    if constexpr (couples) {
      carry_couples(previous, contacts, previous.couples, contacts.couples,
                    [&](const Contact<S>& before, const Contact<S>& now) -> typename S::Matrix {
                      if constexpr (CompliantLaw<Law, S>)
                        return turn.axes(before, now);
                      else
                        return before.frame;
                    });
      rows_.resize(contacts.size());
      team.share_each(contacts.size(), 256, [&](std::size_t c) {
        linear<S>(rows_[c]) = contacts.impulses[c];
        angular<S>(rows_[c]) = contacts.couples[c] / op.radius(c);
      });
    }
    return found;
  }
  /// r: the impulses of the contacts themselves, or with couples (impulse, couple / R).
  std::span<Row> impulses([[maybe_unused]] Contacts<S>& contacts) {
    if constexpr (couples)
      return rows_;
    else
      return contacts.impulses;
  }
  /// Writes r to the impulses and couples of the contacts.
  void finish([[maybe_unused]] const Operator& op, [[maybe_unused]] Contacts<S>& contacts,
              [[maybe_unused]] const Team& team) const {
    if constexpr (couples)
      team.share_each(contacts.size(), 256, [&](std::size_t c) {
        contacts.impulses[c] = linear<S>(rows_[c]);
        contacts.couples[c] = op.radius(c) * angular<S>(rows_[c]);
      });
  }

 private:
  static constexpr bool couples = RollingLaw<Law, S>;
  struct None {};
  [[no_unique_address]] std::conditional_t<couples, std::vector<Row>, None> rows_;
};

}  // namespace moreau::detail
