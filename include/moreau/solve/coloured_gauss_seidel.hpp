// SPDX-License-Identifier: MIT
// Non-linear Gauss-Seidel made fast: the same fixed point and the same local solutions as
// NonlinearGaussSeidel, with
//
//  - contacts coloured by body, so that each wide instruction works on independent contacts;
//  - momentum: a sweep starts from r + beta (r - r a sweep ago) and from the body velocities that
//    belong to it, which are extrapolated alike because they are linear in r;
//  - contacts that carry nothing and separate left out of the sweeps between two checks; every
//    check visits all.
//
// Whether the result is good is decided by a plain sweep (QM/16) or by the residual of the impulses
// alone; the momentum has no say in that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/solve/contact_groups.hpp"
#include "moreau/solve/momentum.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/solve/report.hpp"
#include "moreau/solve/residual.hpp"
#include "moreau/solve/sweep_change.hpp"

namespace moreau {

namespace detail {

/// The state of one solution: groups of contacts, scaled body velocities, momentum.
template <class Operator, class Law>
class ColouredSweeps {
 public:
  using Groups = ContactGroups<Operator, Law>;
  using S = typename Groups::S;
  using T = typename S::Scalar;
  using W = typename Groups::W;
  using Values = typename W::Values;
  using Vector = typename LaneBlock<S>::Vector;
  using Impulse = typename Operator::Vector;

  /// @param op carries the velocities that the impulses make
  void start(const Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
             std::span<const Impulse> impulses, bool momentum) {
    groups_.build(op, laws, law_of, impulses);
    load_velocities(op);
    momentum_ = Momentum(momentum);
    awake_.clear();
    for (std::uint32_t k = 0; k < groups_.pairs.size(); ++k) rest_or_wake(k);
  }
  /// Body velocities of the operator; what the sweeps rounded off is gone. The next sweep starts
  /// from the impulses as they are, because no earlier velocities belong to these.
  void load_velocities(const Operator& op) {
    velocity_.assign(registers * (op.body_count() + 1), Values{});
    for (std::size_t i = 0; i < op.body_count(); ++i) {
      const auto y = op.scaled_velocity(i);
      for (int k = 0; k < S::dofs; ++k)
        velocity_[registers * i + std::size_t(k / W::lanes)][k % W::lanes] = y[k];
    }
    before_ = velocity_;
    beta_ = 0;
  }
  void unpack(std::span<Impulse> impulses) const { groups_.unpack(impulses); }

  /// Sweeps over the contacts that are awake, each sweep ahead by the momentum.
  void sweep() {
    extrapolate();
    change2_ = Values{};
    for (const std::uint32_t k : awake_) visit<false>(groups_.pairs[k], groups_.pairs[k].awake);
    beta_ = static_cast<T>(momentum_.next(double(W::sum(change2_))));
  }
  /// One plain sweep over all contacts; wakes those that approach, lets go those that rest.
  SweepChange plain_sweep() {
    before_ = velocity_;
    beta_ = 0;
    change2_ = Values{};
    SweepChange change;
    awake_.clear();
    for (std::uint32_t k = 0; k < groups_.pairs.size(); ++k) {
      const auto& group = groups_.pairs[k];
      if (group.awake == 0 && !approaches(group)) continue;
      visit<true>(group, group.count, &change);
      rest_or_wake(k);
    }
    momentum_.check(std::sqrt(change.dv2));
    beta_ = static_cast<T>(momentum_.next(double(W::sum(change2_))));
    return change;
  }

 private:
  static constexpr std::size_t registers = (S::dofs + W::lanes - 1) / W::lanes;
  using BodyLanes = std::array<Values, registers * W::lanes>;
  using Pairs = typename Groups::Pairs;
  using Points = typename Groups::Points;
  using Bodies = std::array<std::uint32_t, std::size_t{W::lanes}>;

  BodyLanes gather(const Bodies& bodies) const {
    BodyLanes y;
    for (std::size_t k = 0; k < registers; ++k) {
      Values rows[W::lanes];
      for (std::size_t l = 0; l < W::lanes; ++l) rows[l] = velocity_[registers * bodies[l] + k];
      W::transpose(rows);
      for (std::size_t l = 0; l < W::lanes; ++l) y[k * W::lanes + l] = rows[l];
    }
    return y;
  }
  void scatter(const Bodies& bodies, const BodyLanes& y) {
    for (std::size_t k = 0; k < registers; ++k) {
      Values rows[W::lanes];
      for (std::size_t l = 0; l < W::lanes; ++l) rows[l] = y[k * W::lanes + l];
      W::transpose(rows);
      for (std::size_t l = 0; l < W::lanes; ++l) velocity_[registers * bodies[l] + k] = rows[l];
    }
  }

  void extrapolate() {
    const Values beta = W::broadcast(beta_);
    for (std::size_t i = 0; i < velocity_.size(); ++i) {
      const Values now = velocity_[i];
      velocity_[i] = now + beta * (now - before_[i]);
      before_[i] = now;
    }
  }

  /// Notes which points of a group carry an impulse, and the group if any does.
  void rest_or_wake(std::uint32_t k) {
    Pairs& group = groups_.pairs[k];
    group.awake = 0;
    for (std::uint32_t p = 0; p < group.count; ++p) {
      const Points& point = groups_.points[group.first + p];
      typename W::Indices some{};
      for (std::size_t d = 0; d < S::dim; ++d)
        some |= (point.impulse[d] != Values{}) | (point.before[d] != Values{});
      if (W::any(some)) group.awake = p + 1;
    }
    if (group.awake > 0) awake_.push_back(k);
  }
  bool approaches(const Pairs& group) const {
    const BodyLanes a = gather(group.a), b = gather(group.b);
    typename W::Indices some{};
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p) {
      const Points& point = groups_.points[p];
      Values u = point.free[0];
      for (std::size_t k = 0; k < S::dofs; ++k)
        u += point.rows_b[k][0] * b[k] - point.rows_a[k][0] * a[k];
      some |= u < Values{};
    }
    return W::any(some);
  }

  /// Solves the contacts of a group, points of a pair one after the other.
  template <bool Measure>
  void visit(const Pairs& group, std::uint32_t count, SweepChange* measure = nullptr) {
    BodyLanes a = gather(group.a), b = gather(group.b);
    const Values beta = W::broadcast(beta_);
    for (std::uint32_t p = group.first; p < group.first + count; ++p) {
      Points& point = groups_.points[p];
      Vector guess;
      for (std::size_t d = 0; d < S::dim; ++d)
        guess[d] = point.impulse[d] + beta * (point.impulse[d] - point.before[d]);
      // Two sums side by side: half the latency.
      const Vector own = point.block * guess;
      Vector of_a, of_b;
      for (std::size_t d = 0; d < S::dim; ++d) {
        of_a[d] = own[d];
        of_b[d] = point.free[d];
      }
      for (std::size_t k = 0; k < S::dofs; ++k)
        for (std::size_t d = 0; d < S::dim; ++d) {
          of_a[d] += point.rows_a[k][d] * a[k];
          of_b[d] += point.rows_b[k][d] * b[k];
        }
      Vector u;
      for (std::size_t d = 0; d < S::dim; ++d) u[d] = of_b[d] - of_a[d];
      const Vector impulse = point.law.solve(point.block, u, guess);
      Vector change;
      for (std::size_t d = 0; d < S::dim; ++d) {
        change[d] = impulse[d] - guess[d];
        change2_ += change[d] * change[d];
        point.before[d] = point.impulse[d];
        point.impulse[d] = impulse[d];
      }
      // The rows are read again from memory: kept, they would be spilled and read from there.
      asm volatile("" : : : "memory");
      for (std::size_t k = 0; k < S::dofs; ++k)
        for (std::size_t d = 0; d < S::dim; ++d) {
          a[k] -= point.rows_a[k][d] * change[d];
          b[k] += point.rows_b[k][d] * change[d];
        }
      if constexpr (Measure) add(*measure, point.block, change, impulse);
    }
    scatter(group.a, a);
    scatter(group.b, b);
  }

  static void add(SweepChange& sum, const LaneBlock<S>& block, const Vector& change,
                  const Vector& impulse) {
    const Vector dv = block * change, wr = block * impulse;
    Values dv2{}, r2{}, wr2{}, rwr{};
    for (std::size_t d = 0; d < S::dim; ++d) {
      dv2 += dv[d] * dv[d];
      r2 += impulse[d] * impulse[d];
      wr2 += wr[d] * wr[d];
      rwr += impulse[d] * wr[d];
    }
    for (int l = 0; l < W::lanes; ++l)
      sum.add(double(dv2[l]), double(r2[l]), double(wr2[l]), double(rwr[l]));
  }

  Groups groups_;
  std::vector<Values> velocity_, before_;  // y of every body after the last sweep, and before it
  std::vector<std::uint32_t> awake_;
  Momentum momentum_;
  T beta_ = 0;
  Values change2_{};
};

}  // namespace detail

struct ColouredOptions {
  double tolerance = 1e-4;  ///< on what stop_test names [-]
  StopTest stop_test = StopTest::natural_map;
  int max_sweeps = 2000;    ///< cap; reached without passing, the report says capped
  int check_interval = 20;  ///< sweeps from one stopping test to the next
  bool momentum = true;     ///< off: plain sweeps
};

/// The fast solver of a step's contacts; the header says how it differs from the reference.
class ColouredGaussSeidel {
 public:
  using Options = ColouredOptions;
  /// Buffers, kept from step to step.
  template <class Operator, class Law>
  using Workspace = detail::ColouredSweeps<Operator, Law>;

  /// @throws std::invalid_argument for a tolerance out of range or a count below 1
  explicit ColouredGaussSeidel(const Options& options = {}) : options_(options) {
    detail::require_stopping(options, "ColouredGaussSeidel");
  }

  const Options& options() const { return options_; }

  /// Solves u = W r + b with the law of every contact; see NonlinearGaussSeidel::solve.
  template <class Operator, class Law>
  SolveReport solve(Operator& op, std::span<const Law> laws, std::span<const std::uint32_t> law_of,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, Law>& sweeps) const {
    SolveReport report;
    if (op.size() == 0) return report;
    report.converged = false;
    detail::apply_alone<Operator>(op, impulses);
    sweeps.start(op, laws, law_of, impulses, options_.momentum);
    double believed = 3 * options_.tolerance;  // change per sweep at which the residual may be met
    while (!report.converged && report.sweeps < options_.max_sweeps) {
      const int block = std::min(options_.check_interval, options_.max_sweeps - report.sweeps);
      for (int k = 1; k < block; ++k) sweeps.sweep();
      sweeps.plain_sweep().write(report);
      report.sweeps += block;
      if (options_.stop_test == StopTest::qm16) {
        report.converged = passes_qm16(report, options_.tolerance);
      } else if (report.quad_dv <= believed) {
        certify(op, laws, law_of, impulses, sweeps, report);
        report.converged = report.residual <= options_.tolerance;
        believed = report.quad_dv * options_.tolerance / report.residual;
      }
    }
    report.capped = !report.converged;
    if (report.capped || options_.stop_test == StopTest::qm16)
      certify(op, laws, law_of, impulses, sweeps, report);
    return report;
  }

 private:
  /// The residual of the impulses as they are, with velocities made from them alone.
  template <class Operator, class Law>
  static void certify(Operator& op, std::span<const Law> laws,
                      std::span<const std::uint32_t> law_of,
                      std::span<typename Operator::Vector> impulses,
                      Workspace<Operator, Law>& sweeps, SolveReport& report) {
    sweeps.unpack(impulses);
    detail::apply_alone<Operator>(op, impulses);
    sweeps.load_velocities(op);
    measure_residual(op, laws, law_of, std::span<const typename Operator::Vector>(impulses),
                     report);
  }

  Options options_;
};

}  // namespace moreau
