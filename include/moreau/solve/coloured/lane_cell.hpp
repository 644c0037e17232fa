// SPDX-License-Identifier: MIT
// A periodic cell that moves by its stress in coloured sweeps: BodyDelassus::add_cell(). All contacts of a sweep see
// the velocity Lambda of the cell that the impulses before the sweep give, extrapolated like these: acceleration,
// active set and stopping tests are those of a problem with one more body.
//
// All contact points of a pair of bodies have the same d = l_a - l_b (contact/detail/operator_cell.hpp). So a visit to a
// group of pairs adds Lambda d to the velocities of the bodies b while it lasts. After the sweep
//
//     Lambda_ij += R_ij times the sum of P_i d_j over all pairs,     P = m_b (v_b after the visit - v_b before it),
//
// P being the change of the impulses of a pair in its visit, which moves the body b. Where the body b of a group cannot move,
// or moves along some axes only, P is the difference of the impulses of the points of the group. Rounding errors accumulate in
// Lambda as in the velocities of the bodies; both are computed anew from the impulses at the same time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// The velocity of the cell at the pairs of bodies of the sweeps.
template <class Operator, class Points>
class LaneCell {
 public:
  using S = typename Operator::Space;
  using T = typename S::Scalar;
  using Lanes = typename Points::Block::Number;
  using Values = typename Points::Values;
  using Matrix = typename S::Matrix;

  /// @param contacts the groups of pairs, ContactGroups
  MOREAU_INLINED void start(const Operator& op, const auto& contacts) {
    moves_ = op.has_cell();
    if (!moves_) return;
    response_ = op.cell_response();
    pairs_.assign(contacts.groups.size(), {});
    by_points_.clear();
    for (std::uint32_t k = 0; k < pairs_.size(); ++k) place(k, contacts);
  }
  /// Whether there is such a cell.
  bool moves() const { return moves_; }
  /// Sets Lambda to that of the present impulses; the next sweep extrapolates nothing.
  void set_rate(const Matrix& rate) { rate_ = before_ = rate; }
  /// In place of begin_sweep(), before all impulses are added to bodies without velocity.
  MOREAU_INLINED void begin_from_zero() {
    rate_.setZero();
    before_.setZero();
    guess_.setZero();
    lanes_ = {};
    for (const std::uint32_t k : by_points_) pairs_[k].impulse = {};
  }
  /// Before a sweep.
  /// @param contacts those of start()
  /// @param beta the sweep starts from the impulses r + beta (r - r of the sweep before)
  MOREAU_COLD void begin_sweep(const auto& contacts, T beta) {
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      const T rate = rate_.data()[k], guess = rate + beta * (rate - before_.data()[k]);
      guess_.data()[k] = guess;
      before_.data()[k] = rate;
      lanes_[k] = Lanes::broadcast(guess);
    }
    for (const std::uint32_t k : by_points_) add_impulses(contacts, k, beta, T(-1));
  }
  /// Begins a visit: b gets the velocity relative to the cell.
  MOREAU_INLINED void enter(std::uint32_t group, auto& b) {
    Pairs& pairs = pairs_[group];
    Vector velocity;  // stored number by number: g++ copies an array of registers in pieces
    for (std::size_t i = 0; i < S::dim; ++i) velocity[i] = lanes_[i] * pairs.branch[0];
    for (std::size_t j = 1; j < S::dim; ++j)
      for (std::size_t i = 0; i < S::dim; ++i)
        velocity[i] += lanes_[j * S::dim + i] * pairs.branch[j];
    for (std::size_t i = 0; i < S::dim; ++i) {
      pairs.velocity[i] = velocity[i];
      b[i] += velocity[i];
      pairs.change[i] = b[i];
    }
  }
  /// Ends the visit.
  MOREAU_INLINED void leave(std::uint32_t group, auto& b) {
    Pairs& pairs = pairs_[group];
    for (std::size_t i = 0; i < S::dim; ++i) {
      pairs.change[i] = b[i] - pairs.change[i];
      b[i] -= pairs.velocity[i];
    }
  }
  /// In place of a visit: the impulses stay.
  void skip(std::uint32_t group) { pairs_[group].change = {}; }
  /// Lambda d of a group, world axes [m/s].
  MOREAU_INLINED void add_velocity(std::uint32_t group, auto& b) const {
    const Vector& branch = pairs_[group].branch;
    for (std::size_t j = 0; j < S::dim; ++j)
      for (std::size_t i = 0; i < S::dim; ++i) b[i] += lanes_[j * S::dim + i] * branch[j];
  }
  /// After a sweep: finds Lambda.
  /// @param groups   those that were visited or skipped
  /// @param contacts those of start()
  MOREAU_COMPILED_ONCE void end_sweep(const List<std::uint32_t>& groups, const auto& contacts) {
    for (const std::uint32_t k : by_points_) add_impulses(contacts, k, T(0), T(1));
    std::array<Values, std::size_t{S::dim * S::dim}> sums{};
    const auto add = [&](const Vector& impulse, const Vector& branch) {
      for (std::size_t j = 0; j < S::dim; ++j)
        for (std::size_t i = 0; i < S::dim; ++i) sums[j * S::dim + i] += impulse[i] * branch[j];
    };
    for (const std::uint32_t k : groups) {
      const Pairs& pairs = pairs_[k];
      Vector impulse;
      for (std::size_t i = 0; i < S::dim; ++i) impulse[i] = pairs.mass * pairs.change[i];
      add(impulse, pairs.branch);
    }
    for (const std::uint32_t k : by_points_) add(pairs_[k].impulse, pairs_[k].branch);
    for (std::size_t k = 0; k < sums.size(); ++k)
      rate_.data()[k] = guess_.data()[k] + response_.data()[k] * Lanes::sum(sums[k]);
  }

 private:
  using Vector = std::array<Values, std::size_t{S::dim}>;
  /// One pair of bodies per lane, world axes.
  struct Pairs {
    Vector branch{};    ///< d [m]
    Values mass{};      ///< m_b; 0 if P is not found by it [kg]
    Vector velocity{};  ///< Lambda d of the present visit [m/s]
    Vector change{};    ///< of v_b in the last visit; during a visit v_b at its start [m/s]
    Vector impulse{};   ///< of by_points_: P, during a sweep less the impulses after it [N s]
  };

  MOREAU_INLINED void place(std::uint32_t k, const auto& contacts) {
    const auto& group = contacts.groups[k];
    const Points& point = contacts.points[group.first];
    Pairs& pairs = pairs_[k];
    for (std::size_t i = 0; i < S::dim; ++i) pairs.branch[i] = point.lever_a[i] - point.lever_b[i];
    const auto& of_b = contacts.masses[k][1];
    bool by_mass = group.matrices == group.isotropic;
    for (int l = 0; l < Lanes::lanes; ++l)
      for (std::size_t i = 0; i < S::dim; ++i)
        by_mass = by_mass && (of_b.linear[l] > 0 || pairs.branch[i][l] == 0);
    if (!by_mass) {
      by_points_.push_back(k);
      return;
    }
    for (int l = 0; l < Lanes::lanes; ++l)
      if (of_b.linear[l] > 0) pairs.mass[l] = 1 / of_b.linear[l];
  }
  /// Sets the impulse of a group to the negative sum of r + beta (r - r of the sweep before) over its points, or adds
  /// the sum of r to it.
  /// @param sign -1 before a sweep, 1 after it
  MOREAU_COLD void add_impulses(const auto& contacts, std::uint32_t k, T beta, T sign) {
    const auto& group = contacts.groups[k];
    Vector& sum = pairs_[k].impulse;
    if (sign < 0) sum = {};
    const Values share = Lanes::broadcast(sign), factor = Lanes::broadcast(beta);
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p) {
      const Points& point = contacts.points[p];
      for (std::size_t d = 0; d < S::dim; ++d) {
        const Values impulse =
            share * (point.impulse[d] + factor * (point.impulse[d] - point.before[d]));
        for (std::size_t i = 0; i < S::dim; ++i) sum[i] += point.frame[i][d] * impulse;
      }
    }
  }

  bool moves_ = false;
  List<Pairs> pairs_;  // of each group
  List<std::uint32_t>
      by_points_;  // groups whose P is the difference of the impulses of their points
  Matrix response_ = Matrix::Zero();
  // Lambda [1/s]: of the impulses, before the last extrapolation, and from which the sweep starts.
  Matrix rate_ = Matrix::Zero(), before_ = Matrix::Zero(), guess_ = Matrix::Zero();
  std::array<Values, std::size_t{S::dim * S::dim}>
      lanes_{};  // guess_, column after column, in all lanes
};

}  // namespace moreau::detail
