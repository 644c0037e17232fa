// SPDX-License-Identifier: MIT
// A solver for contact problems on which sweeps stall: slender stacks, walls of many courses,
// wedges. Sweeps come first. If they do not reach the tolerance, the proximal point method goes on
// from their result, on the matrices of the step. It factorizes matrices of all contacts with an
// impulse: use it for hundreds of bodies, not for tens of thousands.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/friction_problem.hpp"
#include "moreau/solve/gathered_problem.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/proximal_solver.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/stop_test.hpp"

namespace moreau {

/// Sweeps, then the proximal point method if they stall.
/// @tparam First solver of the sweeps; its options give tolerance and stopping test
template <class First = ColouredGaussSeidel>
class ProximalFallback {
 public:
  using Options = typename First::Options;
  /// Buffers, kept from step to step.
  template <class Operator, class Law>
  requires CoulombLaw<Law, typename Operator::Space>
  struct Workspace {
    typename First::template Workspace<Operator, Law> first;  ///< of the sweeps
    std::vector<typename Operator::Vector>
        swept;  ///< result of the sweeps, in contact frames [N s]
  };

  ProximalFallback() = default;
  /// @param options     of the sweeps
  /// @param max_seconds time of the proximal point method in one step [s], after which its best
  ///                    result is returned; a finite time makes results depend on the machine
  /// @throws std::invalid_argument as First does, or for a time that is not positive
  explicit ProximalFallback(const Options& options,
                            double max_seconds = ProximalOptions{}.max_seconds)
      : first_(options), max_seconds_(max_seconds) {
    require(max_seconds > 0, "ProximalFallback", "max_seconds", max_seconds, "must be > 0");
  }

  const Options& options() const { return first_.options(); }  ///< of the sweeps, as given
  /// Sets the threads that share the work of the sweeps.
  void set_team(const Team& team) requires requires(First first) { first.set_team(team); }
  { first_.set_team(team); }

  /// Solves the contact problem, with the arguments of NonlinearGaussSeidel::solve. The report
  /// counts the sweeps of both methods. If the second was needed, convergence is that of the
  /// residual, whatever the stopping test.
  template <class Operator, class Law>
  SolveReport solve(ContactProblem<Operator, Law>& problem,
                    std::span<typename Operator::Vector> impulses,
                    Workspace<Operator, Law>& workspace) const {
    SolveReport report = first_.solve(problem, impulses, workspace.first);
    // The matrices of polish() have no cell that moves by its stress.
    if (report.converged || problem.delassus.has_cell()) return report;
    workspace.swept.assign(impulses.begin(), impulses.end());
    SolveReport polished = report;
    polish(problem, impulses, polished);
    if (report.unsolved_islands > 0)
      polished = judge_islands(problem, impulses, workspace, polished);
    if (is_nearer(polished, report)) return polished;
    report.sweeps = polished.sweeps;
    std::copy(workspace.swept.begin(), workspace.swept.end(), impulses.begin());
    detail::set_impulses<Operator>(problem.delassus, impulses);
    return report;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(first_, max_seconds_); }

  template <class Operator, class Law>
  void polish(ContactProblem<Operator, Law>& problem, std::span<typename Operator::Vector> impulses,
              SolveReport& report) const {
    constexpr int rows = Operator::Space::dim;
    using Scalar = typename Operator::Scalar;
    const auto gathered = gather_problem(problem);
    Eigen::VectorXd r(rows * Eigen::Index(gathered.contacts.size()));
    for (std::size_t k = 0; k < gathered.contacts.size(); ++k)
      r.segment<rows>(rows * Eigen::Index(k)) =
          impulses[gathered.contacts[k]].template cast<double>();
    ProximalOptions options;
    options.max_seconds = max_seconds_;
    // The residual of all contacts may be met while an island has velocities that are wrong.
    const double of_islands = report.unsolved_islands > 0 ? 1e-3 : 1;
    options.tolerance = of_islands * tolerance_for(gathered.problem, r);
    const ProblemReport found = ProximalSolver(options).solve(gathered.problem, r);
    std::fill(impulses.begin(), impulses.end(), Operator::Vector::Zero());
    for (std::size_t k = 0; k < gathered.contacts.size(); ++k)
      impulses[gathered.contacts[k]] =
          r.segment<rows>(rows * Eigen::Index(k)).template cast<Scalar>();
    report.sweeps += found.sweeps;
    detail::set_impulses<Operator>(problem.delassus, impulses);
    measure_residual(problem, std::span<const typename Operator::Vector>(impulses), report);
    report.converged = report.residual <= tolerance() && detail::is_closed(report);
    report.capped = !report.converged;
    report.islands = report.unsolved_islands = 0;  // what was said is of other impulses
    report.velocity_error = 0;
  }
  /// Lets the first solver go on from the result of polish(): it alone knows the errors of islands.
  template <class Operator, class Law>
  SolveReport judge_islands(ContactProblem<Operator, Law>& problem,
                            std::span<typename Operator::Vector> impulses,
                            Workspace<Operator, Law>& workspace,
                            const SolveReport& polished) const {
    SolveReport report = first_.solve(problem, impulses, workspace.first);
    report.sweeps += polished.sweeps;
    return report;
  }

  /// Whether the first result is the better one: it has fewer unsolved islands, or as many and a smaller
  /// residual. Two closed results are compared by their residuals, others by their relative approach, because the residual also falls while impulses diverge.
  static bool is_nearer(const SolveReport& one, const SolveReport& other) {
    if (one.unsolved_islands != other.unsolved_islands)
      return one.unsolved_islands < other.unsolved_islands;
    if (detail::is_closed(one) && detail::is_closed(other)) return one.residual < other.residual;
    return one.relative_approach < other.relative_approach;
  }

  double tolerance() const { return first_.options().tolerance; }
  /// SolveReport::residual is relative to |r|, natural_map_residual() to max(|b|, |r|, |u|).
  template <class S>
  double tolerance_for(const FrictionProblem<S>& problem, const Eigen::VectorXd& r) const {
    const double scaled = delassus_scale(problem) * r.norm();
    const double largest = std::max({problem.free_velocity.norm(), scaled,
                                     (problem.delassus * r + problem.free_velocity).norm()});
    const double share = scaled > 0 ? scaled / largest : 1;
    return 0.5 * share * tolerance();
  }

  First first_;
  double max_seconds_ = ProximalOptions{}.max_seconds;
};

}  // namespace moreau
