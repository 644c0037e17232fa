// SPDX-License-Identifier: MIT
// Projected Gauss-Seidel sweeps of the overlap correction. Contact c pushes its bodies apart by a multiplier p >= 0
// along its normal: d += M^-1 J^T dp, where J is the change of its gap per shift d of the bodies.
//
//  1. Contacts that are too deep or nearly so are taken, and later those that the shifts so far could close. Each time
//     the new contacts form a batch. A contact that no shift can close would change nothing.
//  2. A contact that is taken gets a row with J and M^-1 J^T: a visit then reads the row and two shifts.
//  3. The rows of a batch are sorted by level: one more than the highest level of the rows before it that share a body
//     with it that moves. The result is that of the order of the contacts, in which shifts go up a stack in one sweep.
//     Rows of one level share no such body, so that a CPU need not end a visit before it begins the next one.
//
// One thread makes the sweeps: a level has so few rows that a barrier would take longer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "moreau/contact/contact.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// The sweeps of the overlap correction.
template <class S>
class OverlapSweeps {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Angular = typename S::Angular;
  using Twist = typename S::Twist;

  /// A contact that is not yet taken.
  struct Candidate {
    Scalar depth;  ///< overlap beyond the slop, < 0 if there is none [m]
    std::uint32_t a, b, contact;
  };

  /// Begins without shifts.
  /// @param masses   of all bodies
  /// @param contacts number of contacts that may take part
  void start(std::span<const InverseMass<S>> masses, std::size_t contacts) {
    shifts_.assign(masses.size() + 1, Twist::Zero());
    moves_.resize(masses.size());
    for (std::size_t i = 0; i < masses.size(); ++i) moves_[i] = masses[i].moves();
    // All memory at once: steps with more deep contacts need no more.
    if (rows_.size() < contacts) {
      rows_.resize(contacts);
      taken_.resize(contacts);
      next_.resize(contacts);
    }
    row_count_ = 0;
  }
  /// Pushes a body at a point, before the sweeps.
  /// @param push  mass times displacement, world axes [kg m]
  /// @param lever from the centre of the body to the point [m]
  void push(const InverseMass<S>& mass, std::uint32_t body, const Vector& push,
            const Vector& lever) {
    mass.add_change(shifts_[body], push, S::moment(lever, push));
  }
  /// Makes sweeps.
  /// @param op         operator of the contacts
  /// @param candidates in: the contacts that may take part; out: those that did not
  /// @param guess      of the shifts: contacts that shifts of this length could close are taken at once [m]
  /// @param longest    bound of the levers of bodies that rotate [m]
  /// @param target     function: depth -> what the change of the gap must not be below [m]
  /// @param shared     bodies that other processes share; null: none
  void run(int sweeps, const auto& op, std::span<const Contact<S>> contacts,
           List<Candidate>& candidates, Scalar guess, Scalar longest, const auto& target,
           const Team& team, SharedBodies* shared) {
    for (int k = 0; k < sweeps; ++k) {
      if (k <= 2 || k == 4 || k == 8 || k == 32) {
        find_reach(longest, k == 0 ? guess : Scalar(0));
        take(op, contacts, candidates, target, team);
      }
      visit_all();
      if (shared)
        shared->average(std::span(shifts_[0].data(), moves_.size() * std::size_t{S::dofs}),
                        S::dofs);
    }
  }

  /// The shifts of the bodies: displacement [m] and rotation vector [rad], world axes.
  std::span<const Twist> shifts() const { return std::span(shifts_).first(moves_.size()); }

 private:
  /// The data that a visit reads. The shift of a body that cannot move is that after the last body; it stays zero.
  struct Row {
    Vector normal;           // world axes
    Angular arm_a, arm_b;    // l x n [m]
    Vector move_a, move_b;   // M^-1 n [1/kg]
    Angular turn_a, turn_b;  // I^-1 (l x n) [1/(kg m)]
    Scalar inverse;          // 1 / (J M^-1 J^T) [kg]
    Scalar target;           // [m]
    Scalar push;             // p [kg m]
    std::uint32_t a, b;
  };

  /// Bounds how far each body has moved a point at a distance up to `longest` from its centre.
  /// @param least of the bounds of bodies that move [m]
  void find_reach(Scalar longest, Scalar least) {
    reach_.resize(moves_.size());
    for (std::size_t i = 0; i < reach_.size(); ++i) {
      const Twist& shift = shifts_[i];
      reach_[i] = std::max(linear<S>(shift).norm() + longest * angular<S>(shift).norm(),
                           moves_[i] ? least : Scalar(0));
    }
  }

  void take(const auto& op, std::span<const Contact<S>> contacts, List<Candidate>& candidates,
            const auto& target, const Team& team) {
    level_.assign(moves_.size(), 0);
    levels_ = 0;
    taken_count_ = 0;
    std::size_t left = 0;
    for (const Candidate& candidate : candidates)
      if (candidate.depth + reach_[candidate.a] + reach_[candidate.b] > 0)
        find_level(candidate);
      else
        candidates[left++] = candidate;
    candidates.resize(left);
    for (std::size_t k = 0, end = row_count_; k < levels_; ++k) end += std::exchange(next_[k], end);
    for (Taken& taken : std::span(taken_).first(taken_count_)) taken.row = next_[taken.level]++;
    row_count_ += taken_count_;
    team.share_each(taken_count_, 128, [&](std::size_t k) {
      const Taken& taken = taken_[k];
      fill(rows_[taken.row], op, contacts[taken.contact], taken.contact, target(taken.depth));
    });
  }
  /// Takes a contact.
  void find_level(const Candidate& candidate) {
    const bool a = moves_[candidate.a], b = moves_[candidate.b];
    const std::uint32_t level = std::max(a ? level_[candidate.a] : 0, b ? level_[candidate.b] : 0);
    if (a) level_[candidate.a] = level + 1;
    if (b) level_[candidate.b] = level + 1;
    if (level == levels_) next_[levels_++] = 0;
    ++next_[level];
    taken_[taken_count_++] = {candidate.depth, candidate.contact, level, 0};
  }
  void fill(Row& row, const auto& op, const Contact<S>& contact, std::uint32_t c,
            Scalar target) const {
    const InverseMass<S>&a = op.inverse_mass(contact.a), &b = op.inverse_mass(contact.b);
    const auto still = static_cast<std::uint32_t>(moves_.size());
    row.normal = contact.frame.col(0);
    row.arm_a = S::moment(contact.lever_a, row.normal);
    row.arm_b = S::moment(contact.lever_b, row.normal);
    row.move_a = a.velocity_of(row.normal);
    row.move_b = b.velocity_of(row.normal);
    row.turn_a = a.spin_of(row.arm_a);
    row.turn_b = b.spin_of(row.arm_b);
    row.inverse = op.normal(c) > 0 ? 1 / op.normal(c) : Scalar(0);
    row.target = target;
    row.push = 0;
    row.a = moves_[contact.a] ? contact.a : still;
    row.b = moves_[contact.b] ? contact.b : still;
  }

  /// Visits all rows once.
  void visit_all() {
    const std::size_t still = moves_.size();
    for (Row& row : std::span(rows_).first(row_count_)) {
      Twist &a = shifts_[row.a], &b = shifts_[row.b];
      const Twist &of_a = a, &of_b = b;
      const Scalar opening = row.normal.dot(linear<S>(of_b) - linear<S>(of_a)) +
                             (row.arm_b.dot(angular<S>(of_b)) - row.arm_a.dot(angular<S>(of_a)));
      const Scalar push = std::max(Scalar(0), row.push + (row.target - opening) * row.inverse);
      const Scalar change = push - row.push;
      row.push = push;
      if (row.a != still) {
        linear<S>(a) -= change * row.move_a;
        angular<S>(a) -= change * row.turn_a;
      }
      if (row.b != still) {
        linear<S>(b) += change * row.move_b;
        angular<S>(b) += change * row.turn_b;
      }
    }
  }

  /// A candidate that was taken, and its row.
  struct Taken {
    Scalar depth;
    std::uint32_t contact, level;
    std::size_t row;
  };

  List<unsigned char> moves_;  // one per body: whether impulses move it
  List<Twist> shifts_;         // one per body, and zero
  List<Scalar> reach_;         // one per body [m]
  List<std::uint32_t> level_;  // one per body: above its rows in this batch
  List<std::size_t> next_;     // of each level of a batch: its rows, then the next free row
  std::uint32_t levels_ = 0;   // of this batch
  List<Taken> taken_;          // the first taken_count_: of this batch
  List<Row> rows_;             // the first row_count_
  std::size_t taken_count_ = 0, row_count_ = 0;
};

}  // namespace moreau::detail
