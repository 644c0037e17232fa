// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>

#include "moreau/parallel/team.hpp"
#include "moreau/solve/measure_residual.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/solve/stop_test.hpp"

namespace moreau::detail {

/// A solver that can be made to run a few sweeps at a time.
template <class Solver>
concept SolvesInParts = requires(const Solver solver) {
  solver.options().max_sweeps;
  solver.options().check_interval;
  Solver(solver.options());
};

/// Solves a contact problem together with the equation of a periodic cell: a few sweeps, the rate of the cell by the
/// impulses, and again; the head of cell_servo.hpp has the iteration.
/// @param solver   with the options of the whole solution
/// @param impulses in: the first guess; out: the solution [N s]
/// @param sweeps   with one rate of the cell, >= 1
/// @param move     function: sets the rate by the impulses, and the free velocities of the problem by the rate
template <SolvesInParts Solver, class Problem, class Row>
void solve_with_cell(const Solver& solver, Problem& problem, std::span<Row> impulses,
                     auto& workspace, int sweeps, const Team& team, const auto& move,
                     SolveReport& report) {
  auto options = solver.options();
  const double tolerance = options.tolerance;
  const int most = options.max_sweeps;
  options.max_sweeps = sweeps;
  options.check_interval = std::min(options.check_interval, sweeps);
  if constexpr (requires { options.accelerate; }) options.accelerate = options.islands = false;
  Solver part(options);
  if constexpr (requires { part.set_team(team); }) part.set_team(team);
  int done = 0;
  move();
  for (bool solved = false; !solved && done < most;) {
    report = part.solve(problem, impulses, workspace);
    done += std::max(1, report.sweeps);
    move();
    measure_residual(problem, std::span<const Row>(impulses), report, team);
    solved = report.residual <= tolerance && is_closed(report);
    report.converged = solved;
  }
  report.sweeps = done;
  report.capped = !report.converged;
}

}  // namespace moreau::detail
