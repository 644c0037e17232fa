// SPDX-License-Identifier: MIT
#include "moreau/solve/proximal_fallback.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <vector>

#include "moreau/instances/friction_problems.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "conformance/solver.hpp"
#include "types.hpp"

using namespace solve_test;

namespace {

ColouredOptions few_sweeps(double tolerance) {
  ColouredOptions options;
  options.tolerance = tolerance;
  options.max_sweeps = 100;
  return options;
}

}  // namespace

TEST_CASE_TEMPLATE("where sweeps do not suffice, the proximal point method does", S, Space<2>,
                   Space<3>) {
  conformance::solver<S>(ProximalFallback<>(few_sweeps(1e-9)), 1e-9);
  static_assert(!ContactSolver<ProximalFallback<>, PlainCoulomb<double>, S>);
}

TEST_CASE_TEMPLATE("adhesion leaves the push to Coulomb's law, and so to the fallback", S, Space<2>,
                   Space<3>) {
  Assembly<S> problem(2);
  std::vector<Cohesive<>> sticky;
  for (const auto& law : problem.laws) sticky.emplace_back(law, 1);
  std::vector<typename S::Vector> impulses;
  CHECK(problem.solve(ProximalFallback<>(few_sweeps(1e-9)), sticky, impulses).converged);
  CHECK(problem.measure(impulses).residual <= 1e-9);
}

TEST_CASE("a solution that repels sweeps is found") {
  Assembly<Space<2>> problem(9, true, 0.1);
  std::vector<Space<2>::Vector> impulses;
  const SolveReport report =
      problem.solve(ProximalFallback<>(fast<Space<2>>(1e-8)), problem.laws, impulses);
  CHECK(report.converged);
  CHECK(problem.measure(impulses).residual <= 1e-8);
}

TEST_CASE("what it cannot solve in time it leaves as swept, and says so") {
  Assembly<Space<3>> problem(3);
  std::vector<Space<3>::Vector> impulses, swept;
  const SolveReport report =
      problem.solve(ProximalFallback<>(few_sweeps(1e-15), 1e-9), problem.laws, impulses);
  const SolveReport first =
      problem.solve(ColouredGaussSeidel(few_sweeps(1e-15)), problem.laws, swept);
  CHECK_FALSE(report.converged);
  CHECK(report.capped);
  CHECK(report.residual <= first.residual);
  CHECK_THROWS_AS(ProximalFallback<>(few_sweeps(1e-8), 0), std::invalid_argument);
  CHECK_THROWS_AS(ProximalFallback<>(few_sweeps(-1)), std::invalid_argument);
}

TEST_CASE_TEMPLATE("islands that are not solved are said", ShapeT,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>))) {
  using S = SpaceOf<ShapeT>;
  using Law = SignoriniCoulomb<>;
  using Vector = typename S::Vector;
  using World = Simulation<ShapeT, Law, MoreauJean, CellGrid<S>, ProximalFallback<>>;
  constexpr int up = S::dim - 1;
  ColouredOptions options;
  options.velocity_tolerance = 1e-16;  // beyond what any method reaches
  World world(0.02, Materials<Law>(1, Law(0.5)), ProximalFallback<>(options));
  world.add_wall(Vector::Unit(up), Vector::Zero());
  const ShapeId cube = world.add_shape(cuboid<ShapeT>(Vector::Constant(0.01)));
  for (int k = 0; k < 5; ++k)
    world.add_grain(
        cube, Pose<S>(Vector((0.02 * k + 0.01) * Vector::Unit(up) + 1e-4 * k * Vector::UnitX())),
        2000);
  world.set_gravity(-9.81 * Vector::Unit(up));
  int unsolved = 0;
  for (int k = 0; k < 20; ++k) {
    const StepReport report = world.step(1e-3);
    unsolved += report.solve.unsolved_islands > 0;
    CHECK_FALSE((report.solve.converged && report.solve.unsolved_islands > 0));
  }
  CHECK(unsolved > 0);
}

TEST_CASE("large friction hides no approach, and numbers that end no failure") {
  FrictionProblem<Space<3>> problem;
  problem.delassus.resize(3, 3);
  problem.delassus.setIdentity();
  problem.free_velocity = Eigen::Vector3d(-1, 5, 0);
  problem.friction = Eigen::VectorXd::Constant(1, 1e4);
  Eigen::VectorXd impulses;
  ProximalOptions options;
  options.tolerance = 1e-4;
  CHECK(ProximalSolver(options).solve(problem, impulses).converged);
  CHECK((impulses - Eigen::Vector3d(1, -5, 0)).norm() < 1e-3);

  options.max_sweeps = 1000;
  impulses.setZero();
  problem.friction[0] = 1e160;
  const ProblemReport steep = ProximalSolver(options).solve(problem, impulses);
  CHECK((!steep.converged || (impulses - Eigen::Vector3d(1, -5, 0)).norm() < 1e-3));
  impulses.setZero();
  problem.friction[0] = 0.5;
  problem.free_velocity[0] = -1e200;
  CHECK_FALSE(ProximalSolver(options).solve(problem, impulses).converged);
}
