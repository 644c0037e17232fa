// SPDX-License-Identifier: MIT
#include "moreau/world/gather_problem.hpp"

#include <doctest/doctest.h>

#include "moreau/instances/friction_problems.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/solve/proximal_solver.hpp"

#include "world/assemblies.hpp"

using namespace moreau;
using scenes::BoxOfGrains;

namespace {

/// The impulses of the last step at the contacts of the gathered problem.
template <class World, class Gathered>
Eigen::VectorXd impulses_of(const World& world, const Gathered& gathered) {
  constexpr int rows = decltype(gathered.problem)::Space::dim;
  Eigen::VectorXd r(rows * Eigen::Index(gathered.contacts.size()));
  for (std::size_t k = 0; k < gathered.contacts.size(); ++k)
    r.segment<rows>(rows * Eigen::Index(k)) = world.contacts().impulses[gathered.contacts[k]];
  return r;
}

}  // namespace

TEST_CASE_TEMPLATE("a step's problem is solved by the step's impulses, and by another solver",
                   ShapeT, Polyhedron<>, Polygon<>) {
  BoxOfGrains<ShapeT> scene(8);
  auto& simulation = scene.simulation;
  for (int k = 0; k < 400; ++k) simulation.step(5e-4);
  REQUIRE(simulation.contacts().size() > 0);

  const auto gathered = gather_problem(simulation);  // the matrices, and the index of each contact
  Eigen::VectorXd impulses;
  const ProblemReport report = ProximalSolver().solve(gathered.problem, impulses);

  CHECK(report.converged);
  CHECK(natural_map_residual(gathered.problem, impulses_of(simulation, gathered)) < 1e-3);
  // If there are many contacts, the impulses of a solution are not unique, but the velocities are.
  CHECK(natural_map_residual(gathered.problem, impulses) < 1e-10);
}

TEST_CASE("a simulation that was read from a snapshot has no problem to gather") {
  BoxOfGrains<Polyhedron<>> scene(4);
  auto& simulation = scene.simulation;
  for (int k = 0; k < 400; ++k) simulation.step(5e-4);
  const std::string before = snapshot(simulation);
  REQUIRE(simulation.contacts().size() > 0);
  simulation.step(5e-4);
  restore_snapshot(before, simulation);
  CHECK_THROWS_AS(gather_problem(simulation), std::invalid_argument);
}
