// SPDX-License-Identifier: MIT
// The solution of several processes solves the contact problem of one.
#include <cmath>
#include <doctest/doctest.h>

#include "distributed/worlds.hpp"

using namespace distributed_test;

namespace {

/// Steps a scene. Every tenth step, the residual is measured on one rank, and the momentum of all
/// grains is compared with the impulses of gravity and walls.
template <class World>
void check_steps(std::size_t count, double tolerance, int steps) {
  using Vector = typename World::S::Vector;
  const auto build = [&] { return box_of_grains<World>(count, tolerance); };
  DistributedSimulation<World> packing(MPI_COMM_WORLD, on_first_rank<World>(build));
  std::optional<World> before = packing.gather();
  for (int k = 1; k <= steps; ++k) {
    const bool checks = k % 10 == 0;
    if (checks) before = packing.gather();
    const StepReport report = packing.step(step);
    CHECK(report.solve.converged);
    CHECK(report.solve.residual <= tolerance);
    if (!checks) continue;
    Vector from_walls = Vector::Zero();
    for (const BodyId wall : packing.walls()) from_walls -= packing.contact_impulse(wall);
    const std::optional<World> after = packing.gather();
    if (!after) continue;
    const SolveReport measured = measured_on_one_rank(*before, *after);
    CHECK(measured.residual <= tolerance);
    CHECK(measured.residual == doctest::Approx(report.solve.residual).epsilon(1e-3));
    CHECK(report.points == after->contacts().size());
    Vector change = Vector::Zero();
    double all = 0;
    for (const BodyId grain : after->grains()) {
      const double mass = after->bodies().weight[grain.index()];
      change += mass * (after->velocity(grain) - before->velocity(grain) - step * after->gravity());
      all += mass * after->velocity(grain).norm();
    }
    for (const auto& impulse : after->contacts().impulses) all += impulse.norm();
    CHECK((change - from_walls).norm() <= 1e-10 * all);
  }
  // The scene is a packing by now.
  CHECK(packing.step(step).pairs > count);
}

}  // namespace

TEST_CASE("The residual on one rank is below the tolerance, and momentum is balanced") {
  check_steps<Polygons>(100, 1e-4, 300);
  check_steps<Polygons>(100, 1e-6, 300);
  check_steps<Balls>(150, 1e-6, 250);
  check_steps<SoftPolyhedra>(80, 1e-4, 250);
  check_steps<SoftPolyhedra>(80, 1e-6, 250);
}
