// SPDX-License-Identifier: MIT
// Gauss-Seidel whose result has the same bits for any number of processes, for tests and audits. It is
// slower than ColouredGaussSeidel: the contacts are solved one by one, and the processes exchange
// velocities after every colour.
//
//  - The colours of the contacts do not depend on who has them. Each pair of bodies has a random
//    priority, a hash of the ids of the bodies. A pair takes the first colour that is free at both
//    bodies, once all neighbouring pairs with a higher priority have theirs (M. T. Jones and
//    P. E. Plassmann, SIAM J. Sci. Comput. 14 (1993) 654). Pairs of one colour share no grain that
//    moves.
//  - A wall that moves under contacts is in many pairs of one colour. They all see its velocity before
//    the colour, and the local blocks make up for the others (solve/hub_share.hpp); n is the number
//    of points of the colour at the wall.
//  - Sums over contacts are exact until they are rounded once (detail/exact_sum.hpp).
//  - The values of a contact or a body are computed by functions that are compiled once
//    (core/compiled_once.hpp), because the place of a contact in a loop depends on the process.
//
// The sweeps have Nesterov's momentum.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/distributed/detail/exact_sum.hpp"
#include "moreau/distributed/detail/ordered_sharing.hpp"
#include "moreau/distributed/detail/priority_colouring.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/hub_share.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/nesterov_momentum.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/stop_test.hpp"

namespace moreau {

/// Options of ReproducibleGaussSeidel.
struct ReproducibleOptions {
  double tolerance = 1e-4;  ///< on SolveReport::residual, > 0 [-]
  int max_sweeps = 2000;    ///< cap, >= 1
  int check_interval = 10;  ///< sweeps from one measurement of the residual to the next, >= 1
};

namespace detail {

/// The sweeps of ReproducibleGaussSeidel over the contacts of one process.
template <class Operator, class Law>
class OrderedSweeps {
 public:
  using Problem = ContactProblem<Operator, Law>;
  using S = typename Operator::Space;
  using T = typename S::Scalar;
  using Vector = typename Operator::Vector;

  OrderedSweeps(Problem& problem, std::span<Vector> impulses, OrderedSharing* sharing)
      : problem_(problem), op_(problem.delassus), impulses_(impulses), sharing_(sharing) {
    colours_.find(op_, sharing);
    before_.assign(impulses.begin(), impulses.end());
    count_points_at_walls();
  }

  /// Computes the velocities of the bodies from the impulses alone, in the order of the colours.
  void load_velocities() {
    op_.clear();
    in_order([&](std::size_t c, T) { apply_impulse(c, impulses_[c]); });
    forget_change();
  }
  /// The velocities are those before the next extrapolation.
  void forget_change() { velocities_before_.assign(velocities().begin(), velocities().end()); }
  /// A sweep that starts from r + beta (r - r of the sweep before).
  /// @returns the squared change of the impulses of all processes
  double sweep(T beta) {
    const std::span<T> now = velocities();
    for (std::size_t i = 0; i < now.size(); i += width)
      extrapolate(&now[i], &velocities_before_[i], beta);
    ExactSum change2;
    in_order([&](std::size_t c, T heavier) { improve(c, beta, heavier, change2); });
    return total(change2);
  }
  /// Leaves the operator with the velocities of the impulses, and measures the residual.
  void measure(SolveReport& report) {
    load_velocities();
    const std::vector<T> ordered(velocities().begin(), velocities().end());
    set_impulses<Operator>(problem_.delassus, impulses_);
    std::copy(ordered.begin(), ordered.end(), velocities().begin());
    ExactSum traces;
    const auto add_trace = [&](ExactSum& sum, std::size_t c) {
      sum.add(double(problem_.delassus.block(c).trace()));
    };
    for (std::size_t c = 0; c < problem_.size(); ++c) call(add_trace, traces, c);
    const double trace = total(traces), rows = count() * double(Vector::RowsAtCompileTime);
    const double scale = trace > 0 ? trace / rows : 1;
    ResidualSums<Operator, Law> all;
    const auto add = [&](ResidualSums<Operator, Law>& one, std::size_t c) {
      one.add(problem_, c, impulses_[c], scale);
    };
    ExactSum sums[5];
    for (std::size_t c = 0; c < problem_.size(); ++c) {
      ResidualSums<Operator, Law> one;
      call(add, one, c);
      const double terms[] = {one.map, one.norm, one.approach, one.closing, one.dissipation};
      for (std::size_t k = 0; k < std::size(terms); ++k) sums[k].add(terms[k]);
      all.add(one);
    }
    double extremes[] = {all.velocity, all.cone, all.complementarity};
    if (sharing_) sharing_->largest(extremes);
    all = {total(sums[0]), total(sums[1]), total(sums[2]), total(sums[3]),
           total(sums[4]), extremes[0],    extremes[1],    extremes[2]};
    all.write(report);
  }
  /// Contacts of all processes.
  double count() const { return sum_over(sharing_, double(problem_.size())); }

 private:
  static constexpr std::size_t width = Operator::width;
  std::span<T> velocities() { return op_.velocity_changes(); }
  MOREAU_COMPILED_ONCE static void extrapolate(T* now, T* before, T beta) {
    for (std::size_t k = 0; k < width; ++k) {
      const T old = now[k];
      now[k] = old + beta * (old - before[k]);
      before[k] = old;
    }
  }
  /// Finds the impulse of a contact anew, from r + beta (r - r of the sweep before).
  MOREAU_COMPILED_ONCE void improve(std::size_t c, T beta, T heavier, ExactSum& change2) {
    const Vector guess = impulses_[c] + beta * (impulses_[c] - before_[c]);
    before_[c] = impulses_[c];
    impulses_[c] = solved(c, guess, heavier);
    const Vector change = impulses_[c] - guess;
    if (change.isZero(0)) return;
    change2.add(change.template cast<double>().squaredNorm());
    apply_impulse(c, change);
  }
  double total(ExactSum& sum) const {
    if (sharing_) sharing_->add(sum.parts());
    return sum.value();
  }

  /// Calls visit(c, heavier) for the contacts in the order of the colours; W' = heavier W. After each
  /// colour all processes know the new velocities.
  template <class Visit>
  void in_order(const Visit& visit) {
    for (std::size_t colour = 0; colour < colours_.count(); ++colour) {
      wall_changes_.assign(colours_.walls().size() * S::dofs, {});
      for (const ColouredPair& pair : colours_.of(colour)) {
        for (std::uint32_t c = pair.first; c < pair.last; ++c)
          visit(c, pair.wall == ColouredPair::none ? T(1) : heavier(c, pair, colour));
      }
      if (sharing_) sharing_->pass_on(colour, velocities(), width);
      move_walls(colour);
    }
  }
  /// Applies an impulse. Its change of a moving wall is stored until the end of the colour.
  MOREAU_COMPILED_ONCE void apply_impulse(std::size_t c, const Vector& impulse) {
    const std::uint32_t wall = colours_.wall_of(c);
    if (wall == ColouredPair::none) return op_.apply_to_bodies(c, impulse);
    const std::uint32_t body = colours_.walls()[wall];
    T* const now = &velocities()[body * width];
    T saved[S::dofs];
    std::copy_n(now, S::dofs, saved);
    op_.apply_to_bodies(c, impulse);
    for (std::size_t e = 0; e < S::dofs; ++e) {
      wall_changes_[wall * S::dofs + e].add(double(now[e] - saved[e]));
      now[e] = saved[e];
    }
  }
  void move_walls(std::size_t colour) {
    const std::size_t walls = colours_.walls().size();
    std::int64_t points = 0;
    for (std::size_t wall = 0; wall < walls; ++wall)
      points += points_at_walls_[colour * walls + wall];
    if (points == 0) return;
    if (sharing_) sharing_->add(ExactSum::parts_of(wall_changes_));
    for (std::size_t wall = 0; wall < walls; ++wall) {
      T* const now = &velocities()[colours_.walls()[wall] * width];
      for (std::size_t e = 0; e < S::dofs; ++e)
        now[e] += static_cast<T>(wall_changes_[wall * S::dofs + e].value());
    }
  }
  void count_points_at_walls() {
    const std::size_t walls = colours_.walls().size();
    points_at_walls_.assign(colours_.count() * walls, 0);
    for (std::size_t colour = 0; colour < colours_.count(); ++colour)
      for (const ColouredPair& pair : colours_.of(colour))
        if (pair.wall != ColouredPair::none)
          points_at_walls_[colour * walls + pair.wall] += pair.last - pair.first;
    if (sharing_) sharing_->add(points_at_walls_);
  }
  /// The factor of W' for a contact with a moving wall.
  MOREAU_COMPILED_ONCE T heavier(std::uint32_t c, const ColouredPair& pair,
                                 std::size_t colour) const {
    const bool wall_is_a = op_.bodies(c)[0] == colours_.walls()[pair.wall];
    return heavier_by_hub(op_, c, wall_is_a,
                          points_at_walls_[colour * colours_.walls().size() + pair.wall]);
  }
  /// The impulse of a contact whose impulse is `guess`.
  Vector solved(std::size_t c, const Vector& guess, T heavier) const {
    Vector u = op_.velocity_of_bodies(c);
    if constexpr (CompliantLaw<Law, S>) u += op_.compliance(c).cwiseProduct(guess);
    if (guess[0] == 0 && u[0] >= 0) return Vector::Zero();
    BlockOf<Law, S> block = op_.block(c);
    block *= heavier;
    return problem_.law(c).solve(block, Vector(u - block * guess), guess);
  }

  Problem& problem_;
  Operator& op_;  // its springs are stretched when the residual is measured
  std::span<Vector> impulses_;
  OrderedSharing* sharing_;
  PriorityColouring<Operator> colours_;
  std::vector<Vector> before_;                 // impulses of the sweep before
  std::vector<T> velocities_before_;           // of all bodies
  std::vector<std::int64_t> points_at_walls_;  // of all processes, one per colour and wall
  std::vector<ExactSum> wall_changes_;         // in a colour, D + A per wall
};

}  // namespace detail

/// Solves contact problems with the same bits for any number of processes; the head of this file has
/// the method. The measures quad_dv to maxm_dvr of its report are 0.
class ReproducibleGaussSeidel {
 public:
  using Options = ReproducibleOptions;
  /// Needs no buffers.
  template <class Operator, class Law>
  requires SetValuedLaw<Law, typename Operator::Space>
  struct Workspace {
  };
  /// Bodies are shared by several processes, but not split.
  static constexpr bool splits_bodies = false;

  ReproducibleGaussSeidel() = default;  ///< with the default options
  /// @throws std::invalid_argument for a tolerance that is not finite and positive, or a cap or an
  ///         interval below 1
  explicit ReproducibleGaussSeidel(const Options& options) : options_(options) {
    detail::require_stopping(options, "ReproducibleGaussSeidel");
  }

  const Options& options() const { return options_; }  ///< as given
  /// Makes the problem one part of a problem that several processes solve together; null: none.
  void share_bodies(const std::shared_ptr<SharedBodies>& shared) {
    sharing_ = std::dynamic_pointer_cast<detail::OrderedSharing>(shared);
  }

  /// Solves the contact problem; the arguments are those of NonlinearGaussSeidel::solve.
  template <class Operator, class Law>
  SolveReport solve(ContactProblem<Operator, Law>& problem,
                    std::span<typename Operator::Vector> impulses,
                    const Workspace<Operator, Law>&) const {
    using T = typename Operator::Scalar;
    SolveReport report;
    detail::drop_if_not_finite(impulses);
    detail::OrderedSweeps<Operator, Law> sweeps(problem, impulses, sharing_.get());
    sweeps.load_velocities();
    if (sweeps.count() == 0) return report;
    report.converged = false;
    detail::NesterovMomentum momentum;
    T beta = 0;
    bool accelerates = true;
    double least = std::numeric_limits<double>::infinity();
    while (!report.converged && report.sweeps < options_.max_sweeps) {
      const double change2 = sweeps.sweep(beta);
      ++report.sweeps;
      beta = accelerates ? static_cast<T>(momentum.next(change2)) : T(0);
      if (report.sweeps % options_.check_interval != 0 && report.sweeps < options_.max_sweeps)
        continue;
      sweeps.measure(report);
      report.converged = report.residual <= options_.tolerance && detail::is_closed(report);
      accelerates = accelerates && report.residual <= 1e3 * least;
      least = std::min(least, report.residual);
      beta = 0;  // the velocities are new
    }
    report.capped = !report.converged;
    return report;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(options_); }

  Options options_;
  std::shared_ptr<detail::OrderedSharing> sharing_;
};

}  // namespace moreau
