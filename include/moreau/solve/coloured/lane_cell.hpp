// SPDX-License-Identifier: MIT
// A periodic cell that moves by its stress in coloured sweeps: BodyDelassus::add_cell(). All contacts of a sweep see
// the velocity of the cell before the sweep. It is computed from the impulses, extrapolated like these, so that
// acceleration, active set and stopping tests are those of a problem with one more body.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// The velocities of the cell at the contact points of the sweeps.
template <class Operator, class Points>
class LaneCell {
 public:
  using S = typename Operator::Space;
  using T = typename S::Scalar;
  using Lanes = typename Points::Block::Number;
  using Values = typename Points::Values;

  /// Before points have the free velocities of the operator.
  void start(const Operator& op) {
    moves_ = op.has_cell();
    response_ = op.cell_response();
    rate_.setZero();
  }
  /// Gives the free velocities of the points those of the cell.
  /// @param beta the impulses are r + beta (r - r of the visit before)
  void move(std::vector<Points>& points, T beta, const Team& team) {
    if (moves_) set_free(points, beta, team);
  }

 private:
  using Matrix = typename S::Matrix;
  /// D x D, column after column, one contact per lane.
  using LaneMatrix = std::array<Values, std::size_t{S::dim * S::dim}>;

  MOREAU_COLD void set_free(std::vector<Points>& points, T beta, const Team& team) {
    // The sums do not depend on the team: as many as there are parts, which the number of points gives.
    constexpr std::size_t most = 16;
    const std::size_t parts = points.size() < 256 ? 1 : most;
    const Values factor = Lanes::broadcast(beta);
    std::array<LaneMatrix, most> sums{};
    bool adds = true;
    const auto pass = [&](std::size_t part) {
      const Share share(points.size(), int(part), int(parts));
      for (std::size_t p = share.begin; p < share.end; ++p)
        visit(points[p], adds, factor, sums[adds ? part : 0]);
    };
    team.share_each(parts, 1, pass);
    for (std::size_t k = 0; k < sums[0].size(); ++k) {
      for (std::size_t part = 1; part < parts; ++part) sums[0][k] += sums[part][k];
      const T rate = response_.data()[k] * Lanes::sum(sums[0][k]);
      sums[0][k] = Lanes::broadcast(rate - rate_.data()[k]);
      rate_.data()[k] = rate;
    }
    adds = false;
    team.share_each(parts, 1, pass);
  }
  /// add() or offset().
  MOREAU_COLD static void visit(Points& point, bool adds, const Values& beta, LaneMatrix& matrix) {
    if (adds)
      add(point, beta, matrix);
    else
      offset(point, matrix);
  }
  /// Adds p d^T of the impulses.
  MOREAU_INLINED static void add(const Points& point, const Values& beta, LaneMatrix& sum) {
    for (std::size_t d = 0; d < S::dim; ++d) {
      const Values guess = point.impulse[d] + beta * (point.impulse[d] - point.before[d]);
      for (std::size_t j = 0; j < S::dim; ++j) {
        const Values moment = guess * (point.lever_a[j] - point.lever_b[j]);
        for (std::size_t i = 0; i < S::dim; ++i) sum[j * S::dim + i] += point.frame[i][d] * moment;
      }
    }
  }
  /// Adds F^T change d to the free velocity.
  MOREAU_INLINED static void offset(Points& point, const LaneMatrix& change) {
    for (std::size_t j = 0; j < S::dim; ++j) {
      const Values branch = point.lever_a[j] - point.lever_b[j];
      for (std::size_t i = 0; i < S::dim; ++i) {
        const Values velocity = change[j * S::dim + i] * branch;
        for (std::size_t d = 0; d < S::dim; ++d) point.free[d] += point.frame[i][d] * velocity;
      }
    }
  }

  bool moves_ = false;
  Matrix response_ = Matrix::Zero();
  Matrix rate_ = Matrix::Zero();  // Lambda in the free velocities of the points [1/s]
};

}  // namespace moreau::detail
