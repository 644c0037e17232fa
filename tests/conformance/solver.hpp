// SPDX-License-Identifier: MIT
// What every solver of contacts has to fulfil. A new one inherits the suite by one line:
//
//   TEST_CASE("mine") { conformance::solver<moreau::Space<3>>(MySolver(options), 1e-9); }
#pragma once

#include <cstdint>
#include <doctest/doctest.h>
#include <span>
#include <vector>

#include "moreau/solve/concepts.hpp"

#include "solve/assembly.hpp"

namespace conformance {

/// It meets its tolerance on random assemblies, under a law that offers no more than the concept
/// too if it takes such; what it reports is what one measures; it leaves the velocities of its
/// impulses; it goes on from a solution; nothing to solve is solved.
/// @param tolerance that the solver was given, on the natural map
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
    CHECK(report.residual == problem.measure(impulses).residual);
    for (std::size_t c = 0; c < problem.op.size(); ++c)
      CHECK(velocities[c] == problem.op.velocity(c));

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

}  // namespace conformance
