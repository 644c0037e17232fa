// SPDX-License-Identifier: MIT
// Both sweep solvers on random assemblies: the conformance suite and the additional requirements on
// these two solvers.
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "conformance/solver.hpp"
#include "types.hpp"

using namespace solve_test;

#define MOREAU_SPACES \
  MOREAU_TYPES((Space<2, double>, Space<3, double>), (Space<2, float>, Space<3, float>))

TEST_CASE_TEMPLATE("both solvers meet the tolerance they report", S, MOREAU_SPACES) {
  const double tolerance = sizeof(typename S::Scalar) == 8 ? 1e-9 : 3e-5;
  GaussSeidelOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 20000;
  conformance::solver<S>(NonlinearGaussSeidel(options), tolerance);
  for (const bool accelerate : {false, true})
    conformance::solver<S>(ColouredGaussSeidel(fast<S>(tolerance, accelerate)), tolerance);
}

TEST_CASE_TEMPLATE("a body of many partners may be heavier than they are or as light", S, Space<2>,
                   Space<3>) {
  for (const double mobility : {1e-4, 0.05, 0.1, 0.3, 1.0}) {
    Assembly<S> problem(9, true, mobility);
    std::vector<typename S::Vector> impulses;
    const SolveReport report =
        problem.solve(ColouredGaussSeidel(fast<S>(1e-8)), problem.laws, impulses);
    // In the plane, a mobility of 0.1 is a critical case: the sweeps are repelled from the
    // solution, and rounding decides whether it is found.
    const double tolerance = S::dim == 2 && mobility == 0.1 ? 1e-4 : 1e-8;
    CHECK(report.converged == (report.residual <= 1e-8));
    CHECK(problem.measure(impulses).residual <= tolerance);
  }
}

// Many of these problems are not solved by any number of sweeps: the residual of the reference is
// up to 2e-3 after 20,000 sweeps.
TEST_CASE_TEMPLATE("a heavy body that no floor holds shares the lanes of its partners", S, Space<2>,
                   Space<3>) {
  GaussSeidelOptions options;
  options.tolerance = 1e-8;
  options.max_sweeps = 6000;
  int solved = 0;
  for (const double mobility : {1e-4, 0.02, 0.05})
    for (const std::uint64_t seed : {9u, 10u, 11u, 12u}) {
      Assembly<S> problem(seed, true, mobility, false);
      std::vector<typename S::Vector> impulses, swept;
      const SolveReport reference =
          problem.solve(NonlinearGaussSeidel(options), problem.laws, swept);
      const SolveReport report =
          problem.solve(ColouredGaussSeidel(fast<S>(1e-8)), problem.laws, impulses);
      // At a mobility of 1e-4 a residual of 1e-8 can leave velocities that are wrong by a half: the islands say so.
      CHECK(report.converged == (report.residual <= 1e-8 &&
                                 report.relative_approach <= SolveReport::max_relative_approach &&
                                 report.unsolved_islands == 0));
      CHECK(std::abs(problem.measure(impulses).residual - report.residual) <= 1e-12);
      if (reference.converged) CHECK(report.converged);
      solved += reference.converged;
    }
  CHECK(solved >= 3);
}

TEST_CASE_TEMPLATE("LMGC90's test ends the sweeps, and the residual is told all the same", S,
                   Space<2>, Space<3>) {
  const auto check = [](auto solver, auto options) {
    options.stop_test = StopTest::qm16;
    options.max_sweeps = 20000;
    int sweeps = 0;
    for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
      options.tolerance = tolerance;
      Assembly<S> problem(5);
      std::vector<typename S::Vector> impulses;
      const SolveReport report = problem.solve(decltype(solver)(options), problem.laws, impulses);
      CHECK(report.converged);
      CHECK(passes_qm16(report, tolerance));
      CHECK(report.sweeps >= sweeps);
      const SolveReport measured = problem.measure(impulses);
      CHECK(measured.residual == doctest::Approx(report.residual).epsilon(1e-6));
      CHECK(measured.relative_approach == doctest::Approx(report.relative_approach).epsilon(1e-6));
      CHECK(measured.worst_velocity == doctest::Approx(report.worst_velocity).epsilon(1e-6));
      CHECK(measured.worst_complementarity ==
            doctest::Approx(report.worst_complementarity).epsilon(1e-6));
      CHECK(std::abs(measured.worst_cone - report.worst_cone) <= 1e-12);
      CHECK(std::abs(measured.wrong_sign_dissipation - report.wrong_sign_dissipation) <= 1e-12);
      sweeps = report.sweeps;
    }
    options.tolerance = 1e-12;
    options.max_sweeps = 20;
    Assembly<S> problem(5);
    std::vector<typename S::Vector> impulses;
    const SolveReport report = problem.solve(decltype(solver)(options), problem.laws, impulses);
    CHECK(report.capped);
    CHECK_FALSE(passes_qm16(report, options.tolerance));
  };
  check(NonlinearGaussSeidel(), GaussSeidelOptions());
  check(ColouredGaussSeidel(), ColouredOptions());
}

TEST_CASE_TEMPLATE("without friction the velocities are unique and equal", S, Space<2>, Space<3>) {
  Assembly<S> problem(4, false);
  GaussSeidelOptions options;
  options.tolerance = 1e-12;
  options.max_sweeps = 100000;
  std::vector<typename S::Vector> reference, impulses;
  problem.solve(NonlinearGaussSeidel(options), problem.laws, reference);
  problem.measure(reference);
  std::vector<typename S::Vector> velocities;
  for (std::size_t c = 0; c < problem.op.size(); ++c) velocities.push_back(problem.op.velocity(c));
  problem.solve(ColouredGaussSeidel(fast<S>(1e-12)), problem.laws, impulses);
  for (std::size_t c = 0; c < problem.op.size(); ++c)
    CHECK((problem.op.velocity(c) - velocities[c]).norm() < 1e-7);
}

TEST_CASE_TEMPLATE("equal input gives equal bits, with fresh or used buffers", S, Space<2>,
                   Space<3>) {
  Assembly<S> problem(6), other(7);
  const ColouredGaussSeidel solver(fast<S>(1e-6));
  using Law = typename Assembly<S>::Law;
  ColouredGaussSeidel::Workspace<BodyDelassus<S>, Law> used;
  std::vector<typename S::Vector> impulses, again, scratch(other.op.size(), S::Vector::Zero());
  problem.solve(solver, problem.laws, impulses);
  auto first = other.problem(), second = problem.problem();
  solver.solve(first, std::span(scratch), used);
  again.resize(problem.op.size(), S::Vector::Zero());
  solver.solve(second, std::span(again), used);
  for (std::size_t c = 0; c < impulses.size(); ++c) CHECK(impulses[c] == again[c]);
}

TEST_CASE_TEMPLATE("a problem with other free velocities is solved again", S, Space<2>, Space<3>) {
  using Law = typename Assembly<S>::Law;
  ColouredOptions options = fast<S>(1e-8);
  options.islands = false;
  const ColouredGaussSeidel solver(options);
  ColouredGaussSeidel::Workspace<BodyDelassus<S>, Law> workspace;
  auto problem = Assembly<S>(4).problem();
  std::vector<typename S::Vector> impulses(problem.size(), S::Vector::Zero());
  CHECK(solver.solve(problem, std::span(impulses), workspace).converged);
  for (const bool cold : {false, true}) {
    for (std::size_t c = 0; c < problem.size(); ++c)
      problem.delassus.offset_normal(c, 0.2 * double(c % 3) - 0.1);
    if (cold) impulses.assign(problem.size(), S::Vector::Zero());
    const SolveReport report =
        solver.solve(problem, std::span(impulses), workspace, /*again=*/true);
    CHECK(report.converged);
    detail::set_impulses(problem.delassus, std::span<const typename S::Vector>(impulses));
    SolveReport measured;
    measure_residual(problem, std::span<const typename S::Vector>(impulses), measured);
    CHECK(measured.residual <= 1e-8);
  }
}

TEST_CASE("the cap is reported") {
  Assembly<Space<3>> problem(8);
  ColouredOptions options;
  options.tolerance = 1e-14;
  options.max_sweeps = 15;
  std::vector<Space<3>::Vector> impulses;
  const SolveReport report = problem.solve(ColouredGaussSeidel(options), problem.laws, impulses);
  CHECK(report.sweeps == 15);
  CHECK(report.capped);
  CHECK_FALSE(report.converged);
  CHECK(report.residual > 1e-14);
}

TEST_CASE("options out of range are refused") {
  ColouredOptions options;
  options.tolerance = 0;
  CHECK_THROWS_WITH_AS(ColouredGaussSeidel{options}, doctest::Contains("tolerance"),
                       std::invalid_argument);
  options = {};
  options.max_sweeps = 0;
  CHECK_THROWS_WITH_AS(ColouredGaussSeidel{options}, doctest::Contains("max_sweeps"),
                       std::invalid_argument);
  options = {};
  options.check_interval = 0;
  CHECK_THROWS_WITH_AS(ColouredGaussSeidel{options}, doctest::Contains("check_interval"),
                       std::invalid_argument);
}

TEST_CASE_TEMPLATE("a warm start that is not finite counts as zero", S, Space<2>, Space<3>) {
  Assembly<S> problem(3);
  std::vector<typename S::Vector> cold;
  const SolveReport expected =
      problem.solve(ColouredGaussSeidel(fast<S>(1e-8)), problem.laws, cold);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
    std::vector<typename S::Vector> impulses(cold.size(), S::Vector::Constant(bad));
    const SolveReport report =
        problem.solve(ColouredGaussSeidel(fast<S>(1e-8)), problem.laws, impulses);
    CHECK(report.converged == expected.converged);
    CHECK(report.sweeps == expected.sweeps);
    CHECK(impulses == cold);
  }
}

TEST_CASE_TEMPLATE("velocities that are not finite are not solved", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  const auto check = [](const auto& solver) {
    Assembly<S> problem(3);
    problem.free[problem.contacts.back().a][0] = std::numeric_limits<T>::quiet_NaN();
    problem.op.assemble(problem.contacts, problem.roots, problem.free);
    std::vector<typename S::Vector> impulses;
    const SolveReport report = problem.solve(solver, problem.laws, impulses);
    CHECK_FALSE(report.converged);
    CHECK(report.residual == std::numeric_limits<double>::infinity());
    CHECK(report.relative_approach == std::numeric_limits<double>::infinity());
  };
  ColouredOptions coloured;
  coloured.tolerance = 1e-4;
  coloured.max_sweeps = 50;
  check(ColouredGaussSeidel(coloured));
  NonlinearGaussSeidel::Options plain;
  plain.tolerance = 1e-4;
  plain.max_sweeps = 50;
  check(NonlinearGaussSeidel(plain));
}

TEST_CASE_TEMPLATE("the rounding of a fast body excuses no other one", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  Assembly<S> assembly(3);
  auto problem = assembly.problem();
  const std::vector<typename S::Vector> none(problem.size(), S::Vector::Zero());
  const auto measured = [&] {
    SolveReport report;
    measure_residual(problem, std::span<const typename S::Vector>(none), report);
    return report.relative_approach;
  };
  const double expected = measured();
  CHECK(expected > 0.5);
  double square = 0;
  for (std::size_t c = 0; c < problem.size(); ++c)
    square += std::pow(double(problem.delassus.free_velocity(c)[0]), 2);
  const auto rounding = T(std::sqrt(4 * square / double(problem.size())));
  problem.rounding.assign(assembly.free.size(), 0);
  problem.rounding[assembly.contacts.back().b] = rounding;  // not the hub
  CHECK(measured() == expected);
  problem.rounding.assign(assembly.free.size(), rounding);
  CHECK(measured() == 0);
}

// The change per sweep falls below the tolerance long before the load has been transmitted to the
// bottom of the column.
TEST_CASE_TEMPLATE("sweeps go on while approach is left over", SolverT, NonlinearGaussSeidel,
                   ColouredGaussSeidel) {
  using S = Space<2>;
  constexpr std::uint32_t height = 100;  // number of bodies in the column; body 0 is the floor
  std::vector<Contact<S>> contacts;
  std::vector<MobilityRoot<S>> roots(height + 1);
  std::vector<S::Twist> free(height + 1, S::Twist(0, -1, 0));
  const S::Vector up(0, 1);
  for (std::uint32_t k = 0; k < height; ++k) {
    contacts.push_back({k, k + 1, 0, 0, S::contact_frame(up), up, -up});
    roots[k + 1].linear = S::Matrix::Identity();
    roots[k + 1].angular = S::Inertia::Identity();
  }
  roots[0].linear.setZero();
  roots[0].angular.setZero();
  free[0].setZero();
  ContactProblem<BodyDelassus<S>, SignoriniCoulomb<double>> problem;
  problem.delassus.assemble(contacts, roots, free);
  problem.laws.assign(1, SignoriniCoulomb<double>(0.3));
  problem.law_of.assign(height, 0);
  std::vector<S::Vector> impulses(height, S::Vector::Zero());
  typename SolverT::Options options;
  options.tolerance = 1e-3;
  options.stop_test = StopTest::qm16;
  options.max_sweeps = 200000;
  typename SolverT::template Workspace<BodyDelassus<S>, SignoriniCoulomb<double>> workspace;
  const SolveReport report = SolverT(options).solve(problem, std::span(impulses), workspace);
  CHECK(report.converged);
  CHECK(report.relative_approach <= SolveReport::max_relative_approach);
}

TEST_CASE_TEMPLATE("friction beyond all measure hides no approach", S, Space<2>, Space<3>) {
  Assembly<S> problem(5);
  const std::vector<SignoriniCoulomb<double>> steep(problem.laws.size(),
                                                    SignoriniCoulomb<double>(1e5));
  for (const double tolerance : {1e-3, 1e-4}) {
    std::vector<typename S::Vector> impulses;
    const SolveReport report =
        problem.solve(ColouredGaussSeidel(fast<S>(tolerance)), steep, impulses);
    CHECK((!report.converged || report.relative_approach <= SolveReport::max_relative_approach));
    CHECK(report.converged == !report.capped);
  }
}
