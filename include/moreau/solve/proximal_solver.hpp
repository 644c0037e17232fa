// SPDX-License-Identifier: MIT
// Solves a friction problem given by its matrices, even if it is ill-conditioned.
//
//  1. Gauss-Seidel with Nesterov's momentum. For most problems this is enough.
//  2. If it stalls, the proximal point method: the problem with W + epsilon I, centred at the last
//     result, is well conditioned and has a solution near by. Gauss-Seidel and Newton's method in
//     turn find it to rounding. epsilon is reduced if they succeed and raised if they fail.
//
// Siconos has solvers of this kind (V. Acary, M. Bremond and O. Huber, in Advanced Topics in
// Nonsmooth Dynamics, Springer 2018, 375).
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "moreau/core/error.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/solve/detail/block_system.hpp"
#include "moreau/solve/detail/coulomb_newton.hpp"
#include "moreau/solve/friction_problem.hpp"
#include "moreau/solve/nesterov_momentum.hpp"

namespace moreau {

/// Options of ProximalSolver.
struct ProximalOptions {
  double tolerance = 1e-10;  ///< on natural_map_residual(), > 0 [-]
  int max_sweeps = 1000000;  ///< of Gauss-Seidel, over all contacts, >= 1
  /// Time after which the best result so far is returned, > 0 [s]; it is tested between steps of
  /// Newton's method. Results that are found earlier do not depend on it.
  double max_seconds = std::numeric_limits<double>::infinity();
};

/// How well a problem was solved. A solver that does not converge is no error.
struct ProblemReport {
  int sweeps = 0;          ///< of Gauss-Seidel
  int newton_steps = 0;    ///< each with a factorization
  int proximal_steps = 0;  ///< 0 if Gauss-Seidel was enough
  double residual = 0;     ///< natural_map_residual() of the result [-]
  /// The residual is below the tolerance; the map relative to the velocities alone and the
  /// remaining approach velocity are below the root of the tolerance. The second condition fails
  /// for a problem without solution, where impulses grow without bound.
  bool converged = false;
};

/// Solves a friction problem, if possible to rounding; the head of this file has the method.
class ProximalSolver {
 public:
  using Options = ProximalOptions;

  /// @throws std::invalid_argument for a tolerance that is not finite and positive, a cap below 1
  ///         or a time that is not positive
  explicit ProximalSolver(const Options& options = {}) : options_(options) {
    constexpr const char* self = "ProximalSolver";
    require_positive(options.tolerance, self, "tolerance");
    require(options.max_sweeps >= 1, self, "max_sweeps", options.max_sweeps, "must be at least 1");
    require(options.max_seconds > 0, self, "max_seconds", options.max_seconds, "must be > 0");
  }

  /// Solves u = W r + b with Signorini's condition and Coulomb's law.
  /// @param problem  of n contacts
  /// @param impulses in: the start, D n, or empty for zero; out: the best result, in the units of
  ///                 the problem, normal first in every contact [N s]
  /// @returns how well the problem was solved
  /// @throws std::invalid_argument for a problem that is not valid, or a start of another size or
  ///         that is not finite
  template <class S>
  ProblemReport solve(const FrictionProblem<S>& problem, Eigen::VectorXd& impulses) const;

 private:
  struct Best {
    Eigen::VectorXd r;
    double residual;
    void offer(const Eigen::VectorXd& candidate, double its_residual) {
      if (!(its_residual < residual)) return;
      r = candidate;
      residual = its_residual;
    }
  };

  template <class S>
  struct Run {
    Run(const FrictionProblem<S>& problem, const Options& asked, const Eigen::VectorXd& r)
        : options(asked),
          system(problem, std::sqrt(asked.tolerance)),
          newton(system),
          best{r, system.residual(r)} {}

    /// Gauss-Seidel while the residual falls fast.
    void start() {
      constexpr int sweeps = 200;
      constexpr double progress = 0.3;
      double before = std::numeric_limits<double>::infinity();
      Eigen::VectorXd r = best.r;
      while (!over() && best.residual < progress * before) {
        before = best.residual;
        sweep(r, best, options.tolerance, sweeps);
      }
    }

    /// Makes proximal point steps until over(), or until about `most_idle` steps in a row have not
    /// reduced the best residual of the problem without shift (epsilon = 0) by a tenth.
    void proximal_point() {
      constexpr double first = 0.1, least = 1e-9, most = 10, down = 0.3, up = 4, progress = 0.9;
      constexpr int most_idle = 1000;
      double epsilon = first, outer = best.residual, mark = best.residual;
      Eigen::VectorXd centre = best.r;
      for (int idle = 0; idle < most_idle && !over(); ++idle) {
        system.shift(epsilon, centre);
        const Best shifted = solve_shifted(centre, outer);
        system.shift(0, centre);
        const double reached = system.residual(shifted.r);
        ++report.proximal_steps;
        best.offer(shifted.r, reached);
        if (best.residual < progress * mark) {
          mark = best.residual;
          idle = 0;
        }
        const bool solved = shifted.residual < 0.1 * reached;
        if (solved || shifted.residual < outer) {
          centre = shifted.r;
          outer = reached;
        }
        epsilon = std::clamp(epsilon * (solved ? down : up), least, most);
      }
    }

    /// The shifted problem, by Gauss-Seidel and Newton's method in turn, until both stagnate.
    Best solve_shifted(const Eigen::VectorXd& centre, double outer) {
      constexpr int rounds = 8, max_stalls = 2, newton_iterations = 40;
      constexpr double rounding = 1e-14, progress = 0.5;
      const double tolerance = std::max(rounding, std::min(1e-2 * outer, 0.1 * options.tolerance));
      Best found{centre, system.residual(centre)};
      Eigen::VectorXd r = centre;
      double before = found.residual;
      int count = 30;
      for (int round = 0; round < rounds && found.residual > tolerance; ++round) {
        sweep(r, found, tolerance, count);
        if (found.residual <= tolerance || over()) break;
        if (round >= max_stalls && found.residual > progress * before) break;
        if (round % max_stalls == 0) before = found.residual;
        Eigen::VectorXd polished = r;
        found.offer(polished, newton.improve(polished, tolerance, newton_iterations,
                                             [&] { return is_late(); }));
        report.newton_steps = newton.steps();
        count += count / 2;
      }
      return found;
    }

    /// Gauss-Seidel with Nesterov's momentum. r continues even if its residual rises; `found` gets
    /// the best result.
    void sweep(Eigen::VectorXd& r, Best& found, double tolerance, int count) {
      constexpr int check_interval = 10;
      detail::NesterovMomentum nesterov;
      Eigen::VectorXd ahead = r;
      for (int k = 1; k <= count && found.residual > tolerance && !over(); ++k) {
        system.sweep(ahead);
        ++report.sweeps;
        const Eigen::VectorXd change = ahead - r;
        r = ahead;
        if (k % check_interval == 0 || k == count) found.offer(r, system.residual(r));
        ahead += nesterov.next(change.squaredNorm()) * change;
      }
    }

    bool over() const {
      return best.residual <= options.tolerance || report.sweeps >= options.max_sweeps || is_late();
    }
    bool is_late() const {
      return std::chrono::duration<double>(Clock::now() - begin).count() > options.max_seconds;
    }

    using Clock = std::chrono::steady_clock;
    const Options& options;
    detail::BlockSystem<S> system;
    detail::CoulombNewton<S> newton;
    Best best;
    ProblemReport report;
    Clock::time_point begin = Clock::now();
  };

  Options options_;
};

// Outside of its class, and so not inline: instances/friction_problems.hpp has it compiled once.
template <class S>
ProblemReport ProximalSolver::solve(const FrictionProblem<S>& problem,
                                    Eigen::VectorXd& impulses) const {
  constexpr const char* self = "ProximalSolver::solve";
  require_valid(problem, self);
  const Eigen::Index rows = problem.free_velocity.size();
  if (impulses.size() == 0) impulses.setZero(rows);
  require(impulses.size() == rows, self, "impulses.size()", impulses.size(),
          "must be D times the contacts");
  require(all_finite(impulses), self, "impulses", impulses.norm(), "must be finite");
  const double scale = delassus_scale(problem);
  Run<S> run(problem, options_, scale * impulses);
  run.start();
  run.proximal_point();
  impulses = run.best.r / scale;
  run.report.residual = natural_map_residual(problem, impulses);
  run.report.converged = std::max(run.report.residual, run.best.residual) <= options_.tolerance;
  return run.report;
}

}  // namespace moreau
