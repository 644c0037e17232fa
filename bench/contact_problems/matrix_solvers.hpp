// SPDX-License-Identifier: MIT
// Solvers for problems given by matrices. They solve to a residual as SolveReport defines it.
#pragma once

#include <Eigen/Core>

#include "moreau/instances/friction_problems.hpp"
#include "moreau/solve/detail/block_system.hpp"
#include "moreau/solve/friction_problem.hpp"
#include "moreau/solve/proximal_solver.hpp"

namespace contact_problems {

using namespace moreau;

/// The residual of SolveReport for a problem without bodies.
/// @param impulses in the units of the problem, D per contact [N s]
template <class S>
double residual(const FrictionProblem<S>& problem, const Eigen::VectorXd& impulses) {
  const Eigen::VectorXd u = problem.delassus * impulses + problem.free_velocity;
  const auto error = detail::map_error<S>(u, delassus_scale(problem) * impulses,
                                          problem.free_velocity, problem.friction);
  return error.relative(error.impulse);
}

/// Plain sweeps over the blocks of W, like NonlinearGaussSeidel for bodies.
struct BlockGaussSeidel {
  double tolerance;  ///< on residual() [-]
  int max_sweeps;

  template <class S>
  ProblemReport solve(const FrictionProblem<S>& problem, Eigen::VectorXd& impulses) const {
    constexpr int check_interval = 10;
    const double scale = delassus_scale(problem);
    const detail::BlockSystem<S> system(problem, 0);
    Eigen::VectorXd scaled = scale * impulses;
    ProblemReport report;
    do {
      for (int k = 0; k < check_interval; ++k) system.sweep(scaled);
      report.sweeps += check_interval;
      impulses = scaled / scale;
      report.residual = residual(problem, impulses);
      report.converged = report.residual <= tolerance;
    } while (!report.converged && report.sweeps < max_sweeps);
    return report;
  }
};

/// ProximalSolver with a tolerance for residual(). The solver's own residual is relative to the
/// largest of |b|, |r| and |u|. After a first solution the tolerance is converted to |r| alone, and
/// the solver continues from that solution.
struct Proximal {
  double tolerance;  ///< on residual() [-]
  int max_sweeps;
  double max_seconds;  ///< per call of the solver [s]

  template <class S>
  ProblemReport solve(const FrictionProblem<S>& problem, Eigen::VectorXd& impulses) const {
    ProximalOptions options{tolerance, max_sweeps, max_seconds};
    ProblemReport report;
    do {
      const ProblemReport found = ProximalSolver(options).solve(problem, impulses);
      report.sweeps += found.sweeps;
      report.residual = residual(problem, impulses);
      if (!found.converged) break;
      report.converged = report.residual <= tolerance;
      options.tolerance *= 0.5 * tolerance / report.residual;
    } while (!report.converged);
    return report;
  }
};

}  // namespace contact_problems
