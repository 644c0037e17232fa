// SPDX-License-Identifier: MIT
// Fast non-linear Gauss-Seidel. Fixed point and local solutions are those of NonlinearGaussSeidel;
// what makes it fast is
//
//  - colouring: contacts are coloured by body, so that a SIMD instruction and the members of a team
//    work on independent contacts. The bits of the result do not depend on the size of the team;
//  - Nesterov's momentum: a sweep starts from r + beta (r - r of the sweep before) and from the
//    velocities of the bodies for these impulses. Velocities are linear in r: both are extrapolated
//    with the same beta;
//  - Anderson's mixing where Nesterov's momentum stagnates. With friction a solution can be an unstable fixed
//    point of the sweeps, and the iteration then cycles around it for thousands of sweeps. Not where impulses drift
//    (coloured/acceleration.hpp);
//  - jumps where impulses move along a line by the same amount in each sweep, under laws with couples or an attraction
//    (detail/line_jumps.hpp);
//  - an active set: sweeps between two stopping tests visit only contacts with an impulse. Every
//    stopping test visits all contacts and updates the set, and so do sweeps 1, 2, 4, 8, .. of the first interval.
//
// Small islands, sets of up to 200 bodies that contacts connect, are solved to a tolerance on the velocities of their
// bodies by a direct method, if the law is Coulomb's or that of RollingResistance and no body of them has a bond
// (detail/solution_by_islands.hpp, detail/island_solver.hpp, island_newton.hpp). Sweeps
// do not reach this tolerance in chains of contacts: the residual is relative to the largest impulses, and small errors of many contacts add up.
//
// coloured/group_kernel.hpp, visit(), computes the impulse of a contact point: it calls the local
// solution of the law, for Coulomb's law that of law/detail/coulomb_lanes.hpp.
//
// A periodic cell that moves by its stress is one more body, that all contacts touch: coloured/lane_cell.hpp. It has no
// islands.
//
// The stopping tests are those of NonlinearGaussSeidel: the changes of a plain sweep (QM/16), or
// the residual of the impulses with velocities computed from them alone. The acceleration does not
// enter.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/coloured/coloured_sweeps.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/island_solver.hpp"
#include "moreau/solve/detail/line_jumps.hpp"
#include "moreau/solve/detail/solution_by_islands.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/stop_test.hpp"

namespace moreau {

/// Options of ColouredGaussSeidel.
struct ColouredOptions {
  double tolerance = 1e-4;                     ///< on the quantity that stop_test names, > 0 [-]
  StopTest stop_test = StopTest::natural_map;  ///< what ends the sweeps
  /// Cap of an attempt, >= 1; if it ends the sweeps, SolveReport::capped is set. Where the first attempt has
  /// diverged (SolveReport::relative_approach > 1), a second one begins with zero impulses, without
  /// acceleration; its result is kept.
  int max_sweeps = 2000;
  /// Cap of a second attempt, from zero impulses, where the first attempt has reached its cap and has not
  /// diverged: a warm start can lie far from every solution. The result with the smaller residual is kept.
  /// 0: no such attempt. Without acceleration there is no second attempt at all.
  int cold_sweeps = 0;
  /// Sweeps from one stopping test to the next, >= 1. From 4 on there is one more test after the first
  /// quarter of them, which ends the sweeps at a tenth of the tolerance.
  int check_interval = 20;
  bool accelerate = true;  ///< false: plain sweeps
  /// Whether small structures at rest are solved to velocity_tolerance, see SolveReport::velocity_error; false: by
  /// sweeps, like all others.
  bool islands = true;
  /// Aim of the direct method for SolveReport::velocity_error, > 0 [-]. A step counts as converged up to a hundred
  /// times of it.
  double velocity_tolerance = 1e-5;
};

/// The default solver of contact problems, for every set-valued law.
class ColouredGaussSeidel {
 public:
  using Options = ColouredOptions;
  /// In place of the islands of a law that the direct method does not solve.
  struct NoIslands {};
  /// Buffers, kept from step to step.
  template <class Operator, class Law>
  requires SetValuedLaw<Law, typename Operator::Space>
  struct Workspace {
    detail::ColouredSweeps<Operator, Law> sweeps;  ///< packed contacts and their impulses
    List<typename Operator::Vector> first;         ///< result of sweeps [N s]
    /// Small islands; contacts with other laws are solved by sweeps alone.
    std::conditional_t<detail::HasIslands<Law, typename Operator::Space>,
                       detail::IslandSolver<Operator, Law>, NoIslands>
        islands;
  };

  ColouredGaussSeidel() = default;  ///< with the default options
  /// @throws std::invalid_argument for a tolerance that is not finite and positive, or a cap or an
  ///         interval below 1
  explicit ColouredGaussSeidel(const Options& options) : options_(options) {
    detail::require_stopping(options, "ColouredGaussSeidel");
    require_positive(options.velocity_tolerance, "ColouredGaussSeidel", "velocity_tolerance");
    require(options.cold_sweeps >= 0, "ColouredGaussSeidel", "cold_sweeps", options.cold_sweeps,
            "must be >= 0");
  }

  const Options& options() const { return options_; }  ///< as given
  /// Sets the threads that share the work, for a solver that is used by itself: that of a simulation
  /// has the team of the simulation.
  void set_team(const Team& team) { team_ = team; }
  /// Makes the problem one part of a problem that several processes solve together; null: none.
  void share_bodies(std::shared_ptr<SharedBodies> shared) { shared_ = std::move(shared); }

  /// Solves the contact problem; the arguments are those of NonlinearGaussSeidel::solve. Sizes are
  /// not checked.
  /// @param again whether the problem differs from the last one by its free velocities alone
  template <class Operator, class Law>
  SolveReport solve(ContactProblem<Operator, Law>& problem,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, Law>& workspace, bool again = false) const {
    workspace.sweeps.renew(again);
    detail::drop_if_not_finite(impulses);
    if constexpr (detail::HasIslands<Law, typename Operator::Space>)
      if (options_.islands && !shared_ && !problem.delassus.has_cell())
        return detail::SolutionByIslands<ColouredGaussSeidel, Operator, Law>(*this, problem,
                                                                             impulses, workspace)
            .solve();
    return sweep(problem, impulses, workspace);
  }

 private:
  friend struct SerializationAccess;
  template <class, class, class>
  friend class detail::SolutionByIslands;
  auto serialized_members() { return std::tie(options_); }

  /// Sweeps over all contacts, in at most two attempts.
  template <class Operator, class Law>
  MOREAU_COMPILED_ONCE SolveReport sweep(ContactProblem<Operator, Law>& problem,
                                         std::span<typename Operator::Vector> impulses,
                                         Workspace<Operator, Law>& workspace) const {
    const SolveReport first = attempt(problem, impulses, workspace.sweeps, options_.max_sweeps,
                                      options_.accelerate, options_.tolerance);
    // The result is worse than without impulses: the warm start or the acceleration made the sweeps diverge.
    const bool diverged = first.relative_approach > 1;
    const int cap = diverged ? options_.max_sweeps : options_.cold_sweeps;
    if (!options_.accelerate || first.converged || cap == 0) return first;
    workspace.first.assign(impulses.begin(), impulses.end());
    detail::clear_impulses(problem, impulses);
    SolveReport second =
        attempt(problem, impulses, workspace.sweeps, cap, !diverged, options_.tolerance);
    second.sweeps += first.sweeps;
    if (diverged || second.converged || second.residual < first.residual) return second;
    std::copy(workspace.first.begin(), workspace.first.end(), impulses.begin());
    detail::set_impulses<Operator>(problem.delassus, impulses, shared_.get());
    SolveReport report = first;
    report.sweeps = second.sweeps;
    return report;
  }

  /// @param aim the tolerance
  template <class Operator, class Law>
  SolveReport attempt(ContactProblem<Operator, Law>& problem,
                      std::span<typename Operator::Vector> impulses,
                      detail::ColouredSweeps<Operator, Law>& sweeps, int max_sweeps,
                      bool accelerate, double aim) const {
    SolveReport report;
    if (detail::sum_over(shared_.get(), double(problem.size())) == 0) return report;
    report.converged = false;
    sweeps.start(problem, impulses, accelerate, team_, shared_.get());
    // The residual takes a pass over all contacts. It is measured once the change per sweep is
    // below the change at which the residual is expected to meet the tolerance.
    double expected_change = 3 * aim;
    double least = std::numeric_limits<double>::infinity();
    int skipped = 0, saved_at = 0;
    bool is_plain = !accelerate;  // of the sweeps that come next
    [[maybe_unused]] detail::LineJumps line;
    const bool always = measures_always(problem);
    while (!report.converged && report.sweeps < max_sweeps) {
      sweep_to_check(sweeps, max_sweeps, report);
      const double change = std::max(report.quad_dv, report.quad_dvr);
      const bool early = report.sweeps < std::min(options_.check_interval, max_sweeps);
      const double share = early ? early_share : 1;
      const double tolerance = share * aim;
      if (options_.stop_test == StopTest::qm16) {
        report.converged = passes_qm16(report, tolerance);
        if (report.converged) certify(problem, impulses, sweeps, report);
        report.converged = report.converged && detail::is_closed(report);
      } else if (always || report.quad_dv <= share * expected_change || ++skipped == max_skipped) {
        skipped = 0;
        certify(problem, impulses, sweeps, report);
        report.converged = report.residual <= tolerance && detail::is_closed(report);
        expected_change = report.quad_dv * aim / report.residual;
      }
      if (report.converged) break;
      if constexpr (HasLines<Law, typename Operator::Space>)
        if (accelerate && !early && follow_line(line, change, problem, impulses, sweeps, report)) {
          least = std::min(least, change);
          continue;
        }
      if (change < improvement * least) {
        least = change;
        saved_at = report.sweeps;
        sweeps.save(team_);
      } else if (!(change < divergence * least) && !(least == 0 && std::isfinite(change))) {
        sweeps.restore(team_);
      } else if (accelerate && report.sweeps - saved_at >= most_stalled) {
        saved_at = report.sweeps;
        is_plain = !is_plain;
        if (change < least) {  // slow, but better
          least = change;
          sweeps.save(team_);
        } else {
          sweeps.restore(team_);
        }
        sweeps.accelerate(!is_plain);
      }
    }
    if (!report.converged && std::max(report.quad_dv, report.quad_dvr) > least)
      sweeps.restore(team_);
    if (!report.converged) certify(problem, impulses, sweeps, report);
    if (options_.stop_test == StopTest::natural_map)
      report.converged = report.residual <= aim && detail::is_closed(report);
    report.capped = !report.converged;
    return report;
  }

  /// Whether the residual is measured at every stopping test. In a closed row of rigid bonds impulses can go on changing without any
  /// effect on the motion. The changes at other contacts with an attraction are relative to the attraction, but the residual is
  /// relative to their load.
  template <class Operator, class Law>
  static bool measures_always([[maybe_unused]] const ContactProblem<Operator, Law>& problem) {
    if constexpr (AttractiveLaw<Law, typename Operator::Space>)
      return !problem.attraction.pulls.empty();
    else
      return false;
  }
  /// Whether detail/line_jumps.hpp is used. Of random problems under Coulomb's law alone it solved no more.
  template <class Law, class S>
  static constexpr bool HasLines = RollingLaw<Law, S> || AttractiveLaw<Law, S>;
  /// A first stopping test comes after a quarter of the first interval, for steps in which little has
  /// changed. It must meet this share of the tolerance: a solution that only just meets the tolerance is
  /// a worse start for the next step, which then takes more sweeps than were saved.
  static constexpr double early_share = 0.1;
  /// Most stopping tests in a row without the residual: the change per sweep says little about it
  /// if a contact is nearly singular.
  static constexpr int max_skipped = 16;
  /// Safeguard against divergence by acceleration: impulses are saved if the change per sweep is
  /// below `improvement` times that of the saved ones, and restored if it is `divergence` times as
  /// large.
  static constexpr double improvement = 0.5, divergence = 1e3;
  /// Sweeps without an improvement after which plain sweeps replace accelerated ones, or accelerated sweeps plain ones: with
  /// couples accelerated sweeps can cycle for 20,000 sweeps around a solution that 8,000 plain sweeps reach.
  static constexpr int most_stalled = 5000;

  /// Follows the line on which impulses move, after a stopping test.
  /// @returns whether it has replaced the impulses
  template <class Operator, class Law>
  MOREAU_COLD bool follow_line(detail::LineJumps& line, double change,
                               ContactProblem<Operator, Law>& problem,
                               std::span<typename Operator::Vector> impulses,
                               detail::ColouredSweeps<Operator, Law>& sweeps,
                               SolveReport& report) const {
    switch (line.after(change, sweeps.is_mixing())) {
      case detail::LineJumps::Next::nothing:
        return false;
      case detail::LineJumps::Next::mark:
        sweeps.mark(team_);
        return false;
      case detail::LineJumps::Next::jump:
        certify(problem, impulses, sweeps, report);
        if (!detail::is_closed(report)) {
          line.refuse();
          return false;
        }
        sweeps.save(team_);
        if (sweeps.jump(line.factor(), team_)) return true;
        line.end();
        return false;
      case detail::LineJumps::Next::undo:
        sweeps.restore(team_);
        return true;
    }
    return false;
  }

  /// The sweeps up to the next stopping test. In the first interval, sweeps 1, 2, 4, 8, .. update
  /// the active set.
  template <class Sweeps>
  void sweep_to_check(Sweeps& sweeps, int max_sweeps, SolveReport& report) const {
    const int early = options_.check_interval / 4;
    const int next = report.sweeps < early
                         ? early
                         : options_.check_interval - report.sweeps % options_.check_interval;
    const int count = std::min(next, max_sweeps - report.sweeps);
    for (int k = 1; k < count; ++k)
      if (report.sweeps < options_.check_interval &&
          std::has_single_bit(unsigned(report.sweeps + k)))
        sweeps.sweep_all(team_);
      else
        sweeps.sweep_active(team_);
    sweeps.plain_sweep(team_).write(report);
    report.sweeps += count;
  }

  /// The residual of the impulses, with velocities computed from them alone.
  template <class Operator, class Law>
  void certify(ContactProblem<Operator, Law>& problem,
               std::span<typename Operator::Vector> impulses,
               detail::ColouredSweeps<Operator, Law>& sweeps, SolveReport& report) const {
    sweeps.finish(problem.delassus, impulses, team_);
    sweeps.measure_residual(problem, std::span<const typename Operator::Vector>(impulses), report,
                            team_);
  }

  Options options_;
  Team team_;
  std::shared_ptr<SharedBodies> shared_;
};

}  // namespace moreau
