// SPDX-License-Identifier: MIT
// A periodic cell that moves by its stress in coloured sweeps: BodyDelassus::add_cell(). All contacts of a sweep see
// the velocity Lambda of the cell that the impulses before the sweep give, extrapolated like these: acceleration,
// active set and stopping tests are those of a problem with one more body.
//
// All contact points of a pair of bodies have the same d = l_a - l_b (contact/detail/operator_cell.hpp). So a visit to a
// group of pairs adds Lambda d to the velocities of the bodies b while it lasts, and leaves behind the sum P of the
// impulses of each pair; the next sweep begins with Lambda_ij = R_ij times the sum of P_i d_j over all pairs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/compiled_once.hpp"
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
  using Vector = std::array<Values, std::size_t{S::dim}>;

  /// @param groups number of groups of pairs
  void start(const Operator& op, std::size_t groups) {
    moves_ = op.has_cell();
    if (!moves_) return;
    response_ = op.cell_response();
    rate_.setZero();
    pairs_.assign(groups, {});
  }
  /// Whether there is such a cell.
  bool moves() const { return moves_; }
  /// Before the first sweep: d of a group.
  void place(std::uint32_t group, const Points& point) {
    for (std::size_t i = 0; i < S::dim; ++i)
      pairs_[group].branch[i] = point.lever_a[i] - point.lever_b[i];
  }
  /// Sums up the impulses of a group after a visit, or before the first one.
  /// @param points of the group; points with an impulse are among them
  /// @returns what begin_visit() has returned
  MOREAU_COMPILED_ONCE const Vector& take(std::uint32_t group, std::span<const Points> points) {
    Pairs& pairs = pairs_[group];
    Vector sum{};
    for (const Points& point : points)
      for (std::size_t i = 0; i < S::dim; ++i)
        for (std::size_t d = 0; d < S::dim; ++d) sum[i] += point.frame[i][d] * point.impulse[d];
    pairs.impulse = sum;
    return pairs.velocity;
  }
  /// Before a sweep: finds Lambda from the impulses that take() has summed up.
  /// @param groups all groups with an impulse
  /// @param beta   the sweep starts from the impulses r + beta (r - r of the sweep before)
  void move(const std::vector<std::uint32_t>& groups, T beta) {
    if (moves_) find_rate(groups, beta);
  }
  /// Lambda d of a group, which take() returns after the visit, world axes [m/s].
  MOREAU_COMPILED_ONCE const Vector& begin_visit(std::uint32_t group) {
    Vector& velocity = pairs_[group].velocity;
    velocity = this->velocity(group);
    return velocity;
  }
  /// Lambda d of a group, world axes [m/s].
  MOREAU_INLINED Vector velocity(std::uint32_t group) const {
    const Vector& branch = pairs_[group].branch;
    Vector velocity{};
    for (std::size_t j = 0; j < S::dim; ++j)
      for (std::size_t i = 0; i < S::dim; ++i) velocity[i] += lanes_[j * S::dim + i] * branch[j];
    return velocity;
  }

 private:
  using Matrix = typename S::Matrix;
  /// One pair of bodies per lane, world axes.
  struct Pairs {
    Vector branch{};    ///< d [m]
    Vector impulse{};   ///< P [N s]
    Vector velocity{};  ///< Lambda d of the present visit [m/s]
  };

  MOREAU_COMPILED_ONCE void find_rate(const std::vector<std::uint32_t>& groups, T beta) {
    std::array<Values, std::size_t{S::dim * S::dim}> sums{};
    for (const std::uint32_t k : groups) {
      const Pairs& pairs = pairs_[k];
      for (std::size_t j = 0; j < S::dim; ++j)
        for (std::size_t i = 0; i < S::dim; ++i)
          sums[j * S::dim + i] += pairs.impulse[i] * pairs.branch[j];
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const T rate = response_.data()[k] * Lanes::sum(sums[k]), before = rate_.data()[k];
      rate_.data()[k] = rate;
      lanes_[k] = Lanes::broadcast(rate + beta * (rate - before));
    }
  }

  bool moves_ = false;
  std::vector<Pairs> pairs_;  // of each group
  Matrix response_ = Matrix::Zero();
  Matrix rate_ = Matrix::Zero();  // Lambda before the sweep [1/s]
  std::array<Values, std::size_t{S::dim * S::dim}>
      lanes_;  // Lambda of the sweep, column after column, in all lanes
};

}  // namespace moreau::detail
