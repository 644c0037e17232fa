// SPDX-License-Identifier: MIT
// Solves a friction problem given by its matrices, however ill-conditioned.
//
// Gauss-Seidel with momentum comes first and mostly suffices. Where it stalls, the proximal point
// method takes over: W + epsilon I about the last result is well conditioned and has a solution
// near by, which Gauss-Seidel and Newton's method in turn find to rounding; epsilon falls while
// they do and rises where they fail.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "moreau/core/error.hpp"
#include "moreau/solve/block_system.hpp"
#include "moreau/solve/coulomb_newton.hpp"
#include "moreau/solve/friction_problem.hpp"
#include "moreau/solve/momentum.hpp"

namespace moreau {

struct ProximalOptions {
  double tolerance = 1e-10;  ///< on natural_map_residual()
  int max_sweeps = 1000000;  ///< of Gauss-Seidel, over all contacts
  /// Time after which the best result so far is returned [s]. A result that comes before does not
  /// depend on it.
  double max_seconds = std::numeric_limits<double>::infinity();
};

/// How well a problem was solved; not converging is no error.
struct ProblemReport {
  int sweeps = 0;          ///< of Gauss-Seidel
  int proximal_steps = 0;  ///< 0: Gauss-Seidel sufficed
  double residual = 0;     ///< natural_map_residual() of the result
  bool converged = false;
};

class ProximalSolver {
 public:
  using Options = ProximalOptions;

  /// @throws std::invalid_argument for a tolerance, cap or time that is not positive
  explicit ProximalSolver(const Options& options = {}) : options_(options) {
    constexpr const char* self = "ProximalSolver";
    require(options.tolerance > 0 && std::isfinite(options.tolerance), self, "tolerance",
            options.tolerance, "must be finite and > 0");
    require(options.max_sweeps >= 1, self, "max_sweeps", options.max_sweeps, "must be at least 1");
    require(options.max_seconds > 0, self, "max_seconds", options.max_seconds, "must be > 0");
  }

  /// @param impulses in: the start, D n, or empty for zero; out: the best result, in the units of
  ///                 the problem [N s]
  /// @throws std::invalid_argument for a problem that is not valid or a start of another size
  template <class S>
  ProblemReport solve(const FrictionProblem<S>& problem, Eigen::VectorXd& impulses) const {
    require_valid(problem, "ProximalSolver::solve");
    const Eigen::Index rows = problem.free_velocity.size();
    if (impulses.size() == 0) impulses.setZero(rows);
    require(impulses.size() == rows && impulses.allFinite(), "ProximalSolver::solve",
            "impulses.size()", impulses.size(), "must be D times the contacts, all finite");
    const double scale = delassus_scale(problem);
    detail::BlockSystem<S> system(problem);
    Run run{options_, {}, Clock::now()};
    Eigen::VectorXd r = scale * impulses;
    Best best{r, system.residual(r)};
    for (double before = best.residual; !run.over(best.residual);) {
      best.offer(r, sweeps(system, r, options_.tolerance, start_sweeps, run));
      if (!(best.residual < progress * before)) break;
      before = best.residual;
    }
    proximal_steps(system, best, run);
    impulses = best.r / scale;
    run.report.residual = natural_map_residual(problem, impulses);
    run.report.converged = run.report.residual <= options_.tolerance;
    return run.report;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int start_sweeps = 200, check_interval = 10;
  static constexpr double progress = 0.3;

  struct Run {
    const Options& options;
    ProblemReport report;
    Clock::time_point start;
    bool over(double residual) const {
      return residual <= options.tolerance || report.sweeps >= options.max_sweeps ||
             std::chrono::duration<double>(Clock::now() - start).count() > options.max_seconds;
    }
  };
  struct Best {
    Eigen::VectorXd r;
    double residual;
    void offer(const Eigen::VectorXd& candidate, double its_residual) {
      if (!(its_residual < residual)) return;
      r = candidate;
      residual = its_residual;
    }
  };

  /// Gauss-Seidel with momentum; leaves the best result of its checks in r.
  template <class S>
  static double sweeps(const detail::BlockSystem<S>& system, Eigen::VectorXd& r, double tolerance,
                       int count, Run& run) {
    detail::Momentum momentum;
    Best best{r, system.residual(r)};
    Eigen::VectorXd ahead = r, last = r;
    for (int k = 1; k <= count && best.residual > tolerance; ++k) {
      system.sweep(ahead);
      ++run.report.sweeps;
      const Eigen::VectorXd change = ahead - last;
      last = ahead;
      if (k % check_interval == 0 || k == count) {
        best.offer(last, system.residual(last));
        if (run.over(best.residual)) break;
      }
      ahead += momentum.next(change.squaredNorm()) * change;
    }
    r = best.r;
    return best.residual;
  }

  /// Gauss-Seidel and Newton in turn on the shifted problem.
  template <class S>
  static double inner_solve(const detail::BlockSystem<S>& system, Eigen::VectorXd& r,
                            double tolerance, Run& run) {
    detail::CoulombNewton<S> newton(system);
    double residual = system.residual(r);
    int count = 30;
    for (int round = 0; round < 8 && !(residual <= tolerance); ++round, count += count / 2) {
      residual = sweeps(system, r, tolerance, count, run);
      if (residual <= tolerance || run.over(1)) break;
      residual = newton.improve(r, tolerance, 20);
    }
    return residual;
  }

  template <class S>
  void proximal_steps(detail::BlockSystem<S>& system, Best& best, Run& run) const {
    constexpr double first = 0.1, least = 1e-9, most = 10;
    double epsilon = first, outer = best.residual;
    Eigen::VectorXd r = best.r;
    while (!run.over(best.residual)) {
      system.shift(epsilon, r);
      Eigen::VectorXd next = r;
      const double inner = inner_solve(
          system, next, std::max(1e-14, std::min(1e-2 * outer, 0.1 * options_.tolerance)), run);
      system.shift(0, r);
      const double reached = system.residual(next);
      ++run.report.proximal_steps;
      best.offer(next, reached);
#ifdef MOREAU_TRACE
      printf("  prox %d eps %.1e inner %.1e outer %.2e step %.1e sweeps %d %.2fs\n",
             run.report.proximal_steps, epsilon, inner, reached, (next - r).norm(),
             run.report.sweeps, std::chrono::duration<double>(Clock::now() - run.start).count());
#endif
      const bool solved = inner < 0.1 * reached || reached <= options_.tolerance;
      if (solved || inner < outer) {
        r = next;
        outer = reached;
      }
      epsilon = std::clamp(solved ? 0.3 * epsilon : 4 * epsilon, least, most);
    }
  }

  Options options_;
};

}  // namespace moreau
