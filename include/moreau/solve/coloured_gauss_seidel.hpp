// SPDX-License-Identifier: MIT
// Non-linear Gauss-Seidel made fast: the same fixed point and the same local solutions as
// NonlinearGaussSeidel, with
//
//  - contacts coloured by body, so that each wide instruction works on independent contacts;
//  - momentum: a sweep starts from r + beta (r - r a sweep ago) and from the body velocities that
//    belong to it, which are extrapolated alike because they are linear in r;
//  - Anderson's mixing instead, where momentum gets no further: with friction a solution can repel
//    the sweeps, which then circle around it for thousands;
//  - contacts that carry nothing and separate left out of the sweeps between two checks; every
//    check visits all.
//
// Whether the result is good is decided by a plain sweep (QM/16) or by the residual of the impulses
// alone; the acceleration has no say in that.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/solve/anderson_mixing.hpp"
#include "moreau/solve/contact_groups.hpp"
#include "moreau/solve/momentum.hpp"
#include "moreau/solve/nonlinear_gauss_seidel.hpp"
#include "moreau/solve/report.hpp"
#include "moreau/solve/residual.hpp"
#include "moreau/solve/sweep_change.hpp"

namespace moreau {

namespace detail {

/// The state of one solution: groups of contacts, scaled body velocities, acceleration.
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
             std::span<const Impulse> impulses, bool accelerate) {
    groups_.build(op, laws, law_of, impulses);
    load_velocities(op);
    accelerate_ = accelerate;
    momentum_ = Momentum();
    patience_ = Patience();
    mixing_ = false;
    list_awake();
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

  /// A sweep over the contacts that are awake, accelerated.
  void sweep() {
    if (mixing_) {
      mixed_sweep();
      return;
    }
    extrapolate();
    change2_ = Values{};
    for (const std::uint32_t k : awake_) visit<false>(groups_.pairs[k], groups_.pairs[k].awake);
    set_momentum();
  }
  /// The same, over all contacts; wakes those that approach, lets go those that rest.
  void waking_sweep() {
    extrapolate();
    change2_ = Values{};
    visit_all<false>(nullptr);
    set_momentum();
  }
  /// One plain sweep over all contacts; wakes those that approach, lets go those that rest.
  SweepChange plain_sweep() {
    before_ = velocity_;
    beta_ = 0;
    change2_ = Values{};
    SweepChange change;
    visit_all<true>(&change);
    ++mixed_sweeps_;
    if (accelerate_ && patience_.exhausted(std::sqrt(change.dv2))) {
      mixing_ = !mixing_;
      if (mixing_) start_mixing();
    }
    set_momentum();
    return change;
  }

 private:
  static constexpr std::size_t registers = (S::dofs + W::lanes - 1) / W::lanes;
  static constexpr int sweeps_per_mix = 4;
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

  template <bool Measure>
  void visit_all(SweepChange* change) {
    awake_.clear();
    for (std::uint32_t k = 0; k < groups_.pairs.size(); ++k) {
      const Pairs& group = groups_.pairs[k];
      if (group.awake == 0 && !approaches(group)) continue;
      visit<Measure>(group, group.count, change);
      rest_or_wake(k);
    }
  }
  void set_momentum() {
    beta_ = accelerate_ && !mixing_ ? static_cast<T>(momentum_.next(double(W::sum(change2_)))) : 0;
  }

  /// Backward and forward in turn, mixed after every few.
  void mixed_sweep() {
    if (mixed_sweeps_ > 0 && mixed_sweeps_ % sweeps_per_mix == 0) mix();
    before_ = velocity_;
    if (mixed_sweeps_++ % 2 == 0) {
      for (std::size_t i = awake_.size(); i-- > 0;)
        visit<false>(groups_.pairs[awake_[i]], groups_.pairs[awake_[i]].awake);
    } else {
      for (const std::uint32_t k : awake_) visit<false>(groups_.pairs[k], groups_.pairs[k].awake);
    }
  }
  /// The points that are awake now are those that are mixed.
  void start_mixing() {
    mixed_sweeps_ = 0;
    mixed_.clear();
    for (const std::uint32_t k : awake_) {
      const Pairs& group = groups_.pairs[k];
      for (std::uint32_t p = 0; p < group.awake; ++p) mixed_.push_back(group.first + p);
    }
    packed_.resize(Eigen::Index(mixed_.size() * S::dim * std::size_t{W::lanes}));
    pack_mixed();
    anderson_.start(packed_);
  }
  void pack_mixed() {
    T* to = packed_.data();
    for (const std::uint32_t p : mixed_)
      for (std::size_t d = 0; d < S::dim; ++d, to += W::lanes)
        std::memcpy(to, &groups_.points[p].impulse[d], sizeof(Values));
  }
  void mix() {
    pack_mixed();
    anderson_.mix(packed_);
    const T* from = packed_.data();
    for (const std::uint32_t p : mixed_)
      for (std::size_t d = 0; d < S::dim; ++d, from += W::lanes)
        groups_.points[p].impulse[d] = W::load(from);
    std::fill(velocity_.begin(), velocity_.end(), Values{});
    for (const Pairs& group : groups_.pairs) apply(group);
    list_awake();
  }
  /// Adds what the impulses of a group do to its bodies.
  void apply(const Pairs& group) {
    BodyLanes a = gather(group.a), b = gather(group.b);
    for (std::uint32_t p = group.first; p < group.first + group.count; ++p)
      push(groups_.points[p], groups_.points[p].impulse, a, b);
    scatter(group.a, a);
    scatter(group.b, b);
  }
  /// Impulses of a point on the velocities of its bodies.
  static void push(const Points& point, const Vector& impulse, BodyLanes& a, BodyLanes& b) {
    for (std::size_t k = 0; k < S::dofs; ++k)
      for (std::size_t d = 0; d < S::dim; ++d) {
        a[k] -= point.rows_a[k][d] * impulse[d];
        b[k] += point.rows_b[k][d] * impulse[d];
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

  void list_awake() {
    awake_.clear();
    for (std::uint32_t k = 0; k < groups_.pairs.size(); ++k) rest_or_wake(k);
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
      const Vector impulse = point.law.solve(point.block, u, guess, Measure);
      Vector change;
      for (std::size_t d = 0; d < S::dim; ++d) {
        change[d] = impulse[d] - guess[d];
        change2_ += change[d] * change[d];
        point.before[d] = point.impulse[d];
        point.impulse[d] = impulse[d];
      }
      // The rows are read again from memory: kept, they would be spilled and read from there.
      asm volatile("" : : : "memory");
      push(point, change, a, b);
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
  bool accelerate_ = true, mixing_ = false;
  Patience patience_;
  Momentum momentum_;
  T beta_ = 0;
  Values change2_{};
  std::vector<std::uint32_t> mixed_;  // points
  Eigen::Matrix<T, Eigen::Dynamic, 1> packed_;
  AndersonMixing<T> anderson_;
  int mixed_sweeps_ = 0;
};

}  // namespace detail

struct ColouredOptions {
  double tolerance = 1e-4;  ///< on what stop_test names [-]
  StopTest stop_test = StopTest::natural_map;
  int max_sweeps = 2000;    ///< cap; reached without passing, the report says capped
  int check_interval = 20;  ///< sweeps from one stopping test to the next
  bool accelerate = true;   ///< off: plain sweeps
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
    sweeps.start(op, laws, law_of, impulses, options_.accelerate);
    double believed = 3 * options_.tolerance;  // change per sweep at which the residual may be met
    while (!report.converged && report.sweeps < options_.max_sweeps) {
      const int block = std::min(options_.check_interval, options_.max_sweeps - report.sweeps);
      for (int k = 1; k < block; ++k)
        if (report.sweeps == 0 && std::has_single_bit(unsigned(k)))
          sweeps.waking_sweep();
        else
          sweeps.sweep();
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
