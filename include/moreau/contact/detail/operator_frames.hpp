// SPDX-License-Identifier: MIT
// The frames of an operator against those of its contacts. In space the operator turns the tangents so that W_cc is a
// LocalBlock. With couples, its rows are couple / R in place of couples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "moreau/core/list.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/local_block.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// By which the tangents of each contact of a BodyDelassus are turned.
template <class S, bool Couples>
class OperatorFrames {
 public:
  using Scalar = typename S::Scalar;
  using Turn = TangentTurn<S>;

  void resize(std::size_t contacts) {
    if constexpr (Turn::turns) turns_.resize(contacts);
  }
  /// Sets the turn of a contact.
  void set([[maybe_unused]] std::size_t c, [[maybe_unused]] const Turn& turn) {
    if constexpr (Turn::turns) turns_[c] = turn;
  }
  /// A vector in the frame of a Contact, in that of the operator.
  /// @param back the other way round
  typename S::Vector turned([[maybe_unused]] std::size_t c, typename S::Vector vector,
                            [[maybe_unused]] bool back) const {
    if constexpr (Turn::turns) turns_[c].apply(vector, 1, back);
    return vector;
  }
  /// Makes the rows of impulses and couples.
  /// @param rows      in: in the frames of the contacts; out: rows
  /// @param points   of the operator
  template <class Row>
  void to_rows([[maybe_unused]] std::span<Row> rows, [[maybe_unused]] const auto& points,
               [[maybe_unused]] const Team& team) const {
    if constexpr (Couples || Turn::turns)
      team.share_each(rows.size(), 256, [&](std::size_t c) {
        rows[c] = changed(c, rows[c], false);
        if constexpr (Couples)
          if (points[c].radius > 0)
            set_couple(rows[c], angular<S>(std::as_const(rows[c])) / points[c].radius);
      });
  }
  /// Makes impulses and couples of rows.
  /// @param impulses out: in the frames of the contacts
  template <class Row>
  void from_rows(std::span<const Row> rows, std::span<Row> impulses,
                 [[maybe_unused]] const auto& points, [[maybe_unused]] const Team& team) const {
    if constexpr (Couples || Turn::turns)
      team.share_each(rows.size(), 256, [&](std::size_t c) {
        impulses[c] = changed(c, rows[c], true);
        if constexpr (Couples)
          set_couple(impulses[c], angular<S>(std::as_const(impulses[c])) * points[c].radius);
      });
    else
      std::copy(rows.begin(), rows.end(), impulses.begin());
  }

 private:
  template <class Row>
  Row changed([[maybe_unused]] std::size_t c, Row row, [[maybe_unused]] bool back) const {
    if constexpr (Turn::turns) {
      turns_[c].apply(row, 1, back);
      constexpr int couples = S::dim;  // the rows before the couple
      if constexpr (Couples) turns_[c].apply(row, couples + 1, back);
    }
    return row;
  }
  template <class Row>
  static void set_couple(Row& row, const typename S::Angular& couple) {
    angular<S>(row) = couple;
  }

  List<Turn> turns_;  // one per contact; empty in the plane
};

}  // namespace moreau::detail
