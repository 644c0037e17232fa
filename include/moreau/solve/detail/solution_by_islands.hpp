// SPDX-License-Identifier: MIT
// The order of sweeps and direct method in a contact problem with small islands:
//
//  1. The direct method solves the islands that the warm start nearly solves. If these have all contacts, no sweep is
//     made.
//  2. Sweeps over all contacts, to the tolerance of the residual.
//  3. The direct method solves other islands from the impulses of the sweeps.
//  4. Where the residual is larger than before, sweeps go on from there, or the impulses of step 2 are kept.
//  5. Where islands are not solved, further sweeps, and the direct method again; up to three times, with twice as many sweeps
//     each time.
//
// After each of the steps 1, 3 and 5 all impulses are judged together.
#pragma once

#include <algorithm>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/stop_test.hpp"

namespace moreau::detail {

/// Solves one contact problem; the head of this file has the order.
/// @tparam Solver ColouredGaussSeidel, of which this class is a friend
template <class Solver, class Operator, class Law>
class SolutionByIslands {
 public:
  using Problem = ContactProblem<Operator, Law>;
  using Impulses = std::span<typename Operator::Vector>;
  using Workspace = typename Solver::template Workspace<Operator, Law>;

  /// Arguments of Solver::solve().
  SolutionByIslands(const Solver& solver, Problem& problem, Impulses impulses, Workspace& workspace)
      : solver_(solver), problem_(problem), impulses_(impulses), workspace_(workspace) {}

  SolveReport solve() {
    solve_once();
    if (has_failed()) solve_failed();
    return report_;
  }

 private:
  /// The steps 1 to 4.
  MOREAU_INLINED void solve_once() {
    auto& islands = workspace_.islands;
    islands.start(problem_, impulses_, options_.velocity_tolerance);
    if (islands.empty()) return sweep();
    bool solved = islands.all_meet_tolerance();
    if (solved) judge(true);
    if (solved && report_.converged) return;
    solved = solved && islands.all_meet_tolerance();  // not where bodies are squeezed
    islands.save(impulses_);
    sweep();
    if (solved && report_.converged)  // the sweeps have refined a solution
      return islands.write(report_);
    const bool sweeps_converged = report_.converged;
    const double residual = report_.residual;
    workspace_.first.assign(impulses_.begin(), impulses_.end());
    islands.finish(problem_, impulses_, report_.sweeps, sweeps_converged);
    if (!islands.attempted()) return;
    judge(sweeps_converged);
    // The direct method ends at velocity_tolerance, which leaves a larger residual than tolerances near rounding allow.
    if (report_.residual > std::max(residual, options_.tolerance)) lower_residual(sweeps_converged);
  }
  /// After sweeps that had a smaller residual. If they converged, sweeps go on from pressures that the direct method has made
  /// even, and keep them; other impulses become those of the first sweeps again. If not, sweeps go on from a solution of
  /// all islands, which they have not reached from elsewhere.
  MOREAU_COLD void lower_residual(bool sweeps_converged) {
    auto& islands = workspace_.islands;
    const bool refines = sweeps_converged
                             ? islands.made_even()
                             : islands.have_all_contacts() && report_.unsolved_islands == 0;
    if (refines) {
      if (sweeps_converged) islands.roll_back();
      const int before = report_.sweeps;
      sweep();
      report_.sweeps += before;
      islands.write(report_);
      // The errors after roll_back() are those before judge(): bodies can be squeezed.
      if (report_.converged && sweeps_converged) judge(true);
    }
    // Of even pressures that stay above a tolerance near rounding the report says that they are not solved. Those of the sweeps
    // are solved, but can turn a body.
    const bool rounded =
        report_.residual > options_.tolerance && report_.residual <= islands.even_enough;
    if (sweeps_converged && !(refines && (report_.converged || rounded))) use_sweeps();
  }
  /// Whether the sweeps have met their tolerance, and the direct method has failed to solve islands.
  bool has_failed() const {
    return report_.unsolved_islands > 0 && report_.residual <= options_.tolerance &&
           is_closed(report_);
  }
  /// After solve_once(): makes further sweeps where islands are not solved, and solves these from there. Impulses that
  /// meet the tolerance of the sweeps can be so far from the solution that the lifts of the direct method (island_newton.hpp)
  /// would need hundreds of steps, or do not converge. The sweeps of the first round take no more work than the attempts that
  /// have failed, those of the last round four times as much; all rounds together have the cap of one attempt of sweeps. Not where
  /// bodies still approach each other: without a solution impulses would only grow.
  MOREAU_COLD void solve_failed() {
    constexpr double further = 1e-3;  // of the tolerance
    constexpr int rounds = 3;
    auto& islands = workspace_.islands;
    double most = islands.visits_for_failed() / double(problem_.size());
    int left = options_.max_sweeps;
    for (int k = 0; k < rounds && has_failed(); ++k, most *= 2) {
      const int sweeps = int(std::min(most, double(left)));
      if (sweeps < options_.check_interval) return;
      islands.save(impulses_);
      const int before = report_.sweeps;
      const double residual = report_.residual;
      report_ = solver_.attempt(problem_, impulses_, workspace_.sweeps, sweeps, options_.accelerate,
                                further * options_.tolerance);
      left -= report_.sweeps;
      report_.sweeps += before;
      const bool leads_off = !is_closed(report_);
      if (leads_off) islands.restore(impulses_);
      workspace_.first.assign(impulses_.begin(), impulses_.end());
      if (!leads_off) islands.finish_failed(problem_, impulses_);
      judge(true);
      if (report_.residual > std::max(residual, options_.tolerance) || !is_closed(report_))
        use_sweeps();
      if (leads_off) return;
    }
  }
  /// Takes the impulses of the sweeps, Workspace::first: those of islands that are not solved are worse.
  MOREAU_INLINED void use_sweeps() {
    std::copy(workspace_.first.begin(), workspace_.first.end(), impulses_.begin());
    workspace_.islands.roll_back();
    judge(true);
  }

  /// Measures impulses of which some are those of islands.
  /// @param sweeps_converged whether sweeps, if there were any, met their stopping test
  void judge(bool sweeps_converged) {
    auto& [sweeps, first, islands] = workspace_;
    const std::span<const typename Operator::Vector> known = impulses_;
    if (sweeps.is_started())
      sweeps.take(problem_.delassus, known, solver_.team_);
    else
      set_impulses<Operator>(problem_.delassus, known);
    islands.move(problem_.delassus);
    islands.add_approach(problem_);
    if (sweeps.is_started()) {
      sweeps.take_velocities(problem_.delassus);
      sweeps.measure_residual(problem_, known, report_, solver_.team_);
    } else {
      measure_residual(problem_, known, report_, solver_.team_);
    }
    islands.write(report_);
    const bool by_changes = options_.stop_test == StopTest::qm16 && sweeps_converged;
    // The remaining approach is relative to that without impulses, which may be rounding. Errors of islands are relative
    // to the load.
    const bool closed = is_closed(report_) || islands.all_solved();
    report_.converged = closed && (by_changes || report_.residual <= options_.tolerance) &&
                        report_.unsolved_islands == 0;
    report_.capped = !report_.converged;
  }
  MOREAU_INLINED void sweep() { report_ = solver_.sweep(problem_, impulses_, workspace_); }

  const Solver& solver_;
  const typename Solver::Options& options_ = solver_.options();
  Problem& problem_;
  Impulses impulses_;
  Workspace& workspace_;
  SolveReport report_;
};

}  // namespace moreau::detail
