// SPDX-License-Identifier: MIT
// The requirements on every contact solver. A new solver is tested by one line:
//
//   TEST_CASE("mine") { conformance::solver<moreau::Space<3>>(MySolver(options), 1e-9); }
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <limits>
#include <span>
#include <vector>

#include "moreau/solve/concepts.hpp"

#include "solve/assembly.hpp"

namespace conformance {

/// Checks on random assemblies:
///   - The solver reaches its tolerance, also under a law that has only the functions of the
///     concept, if the solver takes such a law.
///   - The residual that it reports equals the residual that is measured afterwards, up to rounding.
///   - The velocities that the solver leaves in the operator are those that its impulses cause, up to rounding: bodies of
///     islands have the motion that the direct method has found.
///   - Started from a solution, it needs no more sweeps.
///   - A problem without contacts is reported as converged.
/// @param tolerance tolerance of the solver for the residual of the natural map
template <class S, class V>
requires moreau::ContactSolver<V, moreau::SignoriniCoulomb<typename S::Scalar>, S>
void solver(const V& solver, double tolerance) {
  using Vector = typename S::Vector;
  using Law = moreau::SignoriniCoulomb<typename S::Scalar>;
  using Plain = solve_test::PlainCoulomb<typename S::Scalar>;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    solve_test::Assembly<S> problem(seed);
    std::vector<Vector> impulses, velocities;
    const moreau::SolveReport report = problem.solve(solver, problem.laws, impulses);
    CHECK(report.converged);
    CHECK_FALSE(report.capped);
    CHECK(report.sweeps > 0);
    CHECK(report.residual <= tolerance);
    CHECK(report.worst_cone <= tolerance);
    for (std::size_t c = 0; c < problem.op.size(); ++c)
      velocities.push_back(problem.op.velocity(c));
    constexpr double rounding = 1e4 * double(std::numeric_limits<typename S::Scalar>::epsilon());
    CHECK(std::abs(report.residual - problem.measure(impulses).residual) <= rounding);
    double changed = 0;
    for (std::size_t c = 0; c < problem.op.size(); ++c)
      changed = std::max(changed, double((velocities[c] - problem.op.velocity(c)).norm()));
    CHECK(changed <= rounding);

    const moreau::SolveReport again = problem.solve(solver, problem.laws, impulses);
    CHECK(again.converged);
    CHECK(again.sweeps <= report.sweeps);

    if constexpr (moreau::ContactSolver<V, Plain, S>) {
      std::vector<Plain> plain;
      for (const Law& law : problem.laws) plain.push_back({law});
      impulses.clear();
      CHECK(problem.solve(solver, plain, impulses).converged);
      CHECK(problem.measure(impulses).residual <= tolerance);
    }
  }

  moreau::ContactProblem<moreau::BodyDelassus<S>, Law> none;
  typename V::template Workspace<moreau::BodyDelassus<S>, Law> workspace;
  const moreau::SolveReport report = solver.solve(none, std::span<Vector>(), workspace);
  CHECK(report.converged);
  CHECK(report.sweeps == 0);
}

/// Checks on random assemblies under one law, which may have couples and springs:
///   - The solver reaches its tolerance, or the report says that it did not.
///   - The residual that it reports equals the residual that is measured afterwards, up to rounding.
///   - Started from a solution, it needs no more sweeps.
/// @param tolerance of the solver for the residual of the natural map
/// @returns number of problems that were solved, of two
template <class S, class Law, class V>
requires moreau::ContactSolver<V, Law, S>
int solver_under(const Law& law, const V& solver, double tolerance) {
  constexpr double rounding = 1e4 * double(std::numeric_limits<typename S::Scalar>::epsilon());
  int solved = 0;
  for (const std::uint64_t seed : {1u, 2u}) {
    solve_test::AssemblyUnder<S, Law> problem(seed, law);
    std::vector<typename solve_test::AssemblyUnder<S, Law>::Row> impulses;
    const moreau::SolveReport report = problem.solve(solver, impulses);
    CHECK(report.converged == (report.residual <= tolerance && report.unsolved_islands == 0));
    CHECK(report.capped == !report.converged);
    CHECK(std::abs(report.residual - problem.measure(impulses).residual) <= rounding);
    if (!report.converged) continue;
    ++solved;
    const moreau::SolveReport again = problem.solve(solver, impulses);
    CHECK(again.converged);
    CHECK(again.sweeps <= report.sweeps);
  }
  return solved;
}

}  // namespace conformance
