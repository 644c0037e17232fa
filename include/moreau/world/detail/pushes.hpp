// SPDX-License-Identifier: MIT
// The unknowns p of the contact problem of a step (stages 4 to 8 of impulse_dynamics.hpp), one row of the operator per
// contact:
//
//     p = r + h T n,
//
// with the impulse r on body b and the attraction T of the law: p pushes against the attraction. Without attraction it is
// r. A row is in the frame of the operator, which turns the tangents of the contact, and has couple / R in place of the
// couple (BodyDelassus::to_rows()). Contacts::impulses always are r, in the frames of the contacts with couples.
#pragma once

#include <cstddef>
#include <span>

#include "moreau/contact/warm_start.hpp"
#include "moreau/core/list.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/bond.hpp"

namespace moreau::detail {

/// p of the contacts of a step [N s].
template <class S, class Law>
class Pushes {
 public:
  using Operator = OperatorOf<Law, S>;
  using Row = typename Operator::Vector;

  /// Fills the rows from the impulses of the step before: the first guess of rigid contacts, the memory of the springs of
  /// compliant contacts. If the key of a contact is not found, its impulse is added to that of the nearest contact of its
  /// pair, unless it is that of a bond with springs, whose energy was dissipated when the bond broke.
  /// @param before contacts of the step before
  /// @param old    their impulses, or their pushes against the attraction of that step, in their frames [N s]
  /// @param now    in, out: contacts of this step, which get the variants of their laws
  /// @param turn   ImpulseTurn or SpringTurn
  /// @returns how many contacts have a predecessor
  std::size_t carry(const ContactsOf<Law, S>& before, const List<Row>& old, ContactsOf<Law, S>& now,
                    const auto& turn, const Operator& op, const Team& team) {
    const std::size_t found = moreau::carry(before, now, old, rows_, turn, team);
    if (found < before.size()) {
      if constexpr (CompliantLaw<Law, S> && BondingLaw<Law, S>)
        hand_over(before, now, old, rows_, turn,
                  [](const ContactKey& key) { return !is_bond(key); });
      else
        hand_over(before, now, old, rows_, turn);
    }
    op.to_rows(rows_, team);
    return found;
  }
  std::span<Row> rows() { return rows_; }  ///< one per contact [N s]
  /// Makes r of the contacts from p.
  /// @param attraction Attraction of the step, or NoAttraction
  void store(ContactsOf<Law, S>& contacts, const auto& attraction, const Operator& op,
             const Team& team) const {
    op.from_rows(rows_, contacts.impulses, team);
    attraction.take_from(std::span<Row>(contacts.impulses));
  }

 private:
  List<Row> rows_;
};

}  // namespace moreau::detail
