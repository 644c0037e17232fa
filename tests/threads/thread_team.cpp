// SPDX-License-Identifier: MIT
// The number of threads has no influence on the results.
#include "moreau/solve/thread_team.hpp"

#include <atomic>
#include <doctest/doctest.h>
#include <vector>

#include "conformance/solver.hpp"

using namespace solve_test;

TEST_CASE("every member works, and meets the others") {
  for (const int size : {1, 2, 3}) {
    const ThreadTeam team(size);
    CHECK(team.size() == size);
    std::vector<int> before(std::size_t(size), 0), after(std::size_t(size), 0);
    for (int round = 1; round <= 20; ++round)
      team.run([&](int rank, int count, auto&& wait) {
        before[std::size_t(rank)] = round;
        wait();
        int sum = 0;
        for (const int value : before) sum += value;
        after[std::size_t(rank)] = sum;
        if (count != size) after[0] = -1;
      });
    for (const int sum : after) CHECK(sum == 20 * size);
  }
}

TEST_CASE_TEMPLATE("one, two and three threads give the same bits", S, Space<2>, Space<3>) {
  Assembly<S> problem(6);
  std::vector<typename S::Vector> alone;
  const SolveReport report = problem.solve(ColouredGaussSeidel(fast<S>(1e-6)), problem.laws, alone);
  CHECK(report.converged);
  for (const int threads : {1, 2, 3}) {
    std::vector<typename S::Vector> impulses;
    const SolveReport parallel =
        problem.solve(ParallelGaussSeidel(fast<S>(1e-6), threads), problem.laws, impulses);
    CHECK(parallel.sweeps == report.sweeps);
    CHECK(parallel.residual == report.residual);
    for (std::size_t c = 0; c < alone.size(); ++c) CHECK(impulses[c] == alone[c]);
  }
}

TEST_CASE("a team of two is a solver") {
  conformance::solver<Space<3>>(ParallelGaussSeidel(fast<Space<3>>(1e-9), 2), 1e-9);
}

TEST_CASE("a team without members is refused") {
  CHECK_THROWS_WITH_AS(ThreadTeam(0), doctest::Contains("threads"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(ParallelGaussSeidel({}, -1), doctest::Contains("threads"),
                       std::invalid_argument);
}
