// SPDX-License-Identifier: MIT
// The solution of several processes solves the contact problem of one.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <stdexcept>
#include <type_traits>

#include "moreau/boundary/drive.hpp"
#include "moreau/boundary/servo.hpp"

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
    CHECK(report.solve.converged == (report.solve.residual <= tolerance));
    // Rigid contacts are not solved to 1e-6 in every step, whatever the number of processes.
    if (std::is_same_v<World, SoftPolyhedra> || tolerance > 1e-5) CHECK(report.solve.converged);
    if (!checks) continue;
    Vector from_walls = Vector::Zero();
    for (const BodyId wall : packing.walls()) from_walls -= packing.contact_impulse(wall);
    const std::optional<World> after = packing.gather();
    if (!after) continue;
    const SolveReport measured = measured_on_one_rank(*before, *after);
    if (report.solve.converged) CHECK(measured.residual <= tolerance);
    CHECK(measured.residual == doctest::Approx(report.solve.residual).epsilon(1e-3));
    CHECK(report.points == after->contacts().size());
    Vector change = Vector::Zero();
    double all = 0;
    for (const BodyId grain : after->grains()) {
      const double mass = after->bodies().grain_mass[grain.index()];
      change += mass * (after->velocity(grain) - before->velocity(grain) - step * after->gravity());
      all += mass * after->velocity(grain).norm();
    }
    for (const auto& impulse : after->contacts().impulses) all += impulse.norm();
    CHECK((change - from_walls).norm() <= 1e-10 * all);
    // One of the checked steps of rigid polygons to 1e-6 is solved by one process and not by two.
    if (before->step(step).solve.converged) WARN(report.solve.converged);
  }
  // The scene is a packing by now.
  CHECK(packing.step(step).pairs > count);
}

/// Rows of balls that overlap by a hundredth of their size.
Balls overlapping_rows() {
  Balls rows = empty_world<Balls>();
  rows.set_correction({});
  const ShapeId shape = rows.add_shape(regular_shape<Ball<>>(size));
  for (int k = 0; k < 60; ++k)
    rows.add_grain(shape, Pose<Space<3>>({0.99 * size * (k % 20), 2 * size * (k / 20), 0}), 2700);
  return rows;
}

}  // namespace

TEST_CASE("The residual on one rank is below the tolerance, and momentum is balanced") {
  check_steps<Polygons>(100, 1e-4, 300);
  check_steps<Polygons>(100, 1e-6, 300);
  check_steps<Balls>(150, 1e-4, 250);
  check_steps<Balls>(150, 1e-6, 250);
  check_steps<RollingBalls>(150, 1e-4, 250);
  check_steps<RollingBalls>(150, 1e-6, 250);
  check_steps<SoftPolyhedra>(80, 1e-4, 250);
  check_steps<SoftPolyhedra>(80, 1e-6, 250);
}

TEST_CASE("Overlaps across processes are corrected as in one process") {
  const Balls rows = overlapping_rows();
  Balls alone = rows;
  DistributedSimulation<Balls> packing(MPI_COMM_WORLD, on_first_rank<Balls>([&] { return rows; }));
  StepReport report, reference;
  for (int k = 0; k < 200; ++k) {
    report = packing.step(step);
    reference = alone.step(step);
    if (k == 0) CHECK(report.correction.corrected == 57);
    if (k == 0) CHECK(report.correction.corrected == reference.correction.corrected);
    CHECK(reference.max_overlap <= 0.0101 * size);
  }
  // The slop of the correction is left, and about as much is left in one process.
  CHECK(report.max_overlap <= 4e-4 * size);
  CHECK(report.max_overlap <= 1.5 * reference.max_overlap + 1e-5 * size);
  const std::optional<Balls> whole = packing.gather();
  if (!whole) return;
  Space<3>::Vector center = Space<3>::Vector::Zero();
  for (const BodyId grain : whole->grains())
    center += (whole->pose(grain).position - rows.pose(grain).position) / 60;
  CHECK(center.norm() <= 1e-12);
}

// Known miss: the balls of a process push outwards before those of the next push back, so that the
// overlap between the processes grows for some steps, to 0.018 of the size with two.
TEST_CASE("Overlaps across processes only shrink" * doctest::should_fail()) {
  DistributedSimulation<Balls> packing(MPI_COMM_WORLD, on_first_rank<Balls>(overlapping_rows));
  double largest = 0;
  for (int k = 0; k < 200; ++k) largest = std::max(largest, packing.step(step).max_overlap);
  CHECK(largest <= 0.0101 * size);
}

TEST_CASE("Drives move walls as those of one process") {
  using Vector = Space<2>::Vector;
  const auto build = [] { return box_of_grains<Polygons>(60, 1e-4); };
  DistributedSimulation<Polygons> packing(MPI_COMM_WORLD, on_first_rank<Polygons>(build));
  Polygons alone = build();
  const BodyId pushed = alone.walls().back(), floor = alone.walls()[1];
  const ForceDrive push(pushed, -Vector::UnitX(), HarmonicForce(1, 5, 50));
  const VelocityDrive shake(floor, Vector::UnitY(),
                            [](double t) { return 0.1 * std::cos(300 * t); });
  for (int k = 0; k < 40; ++k) {
    push.apply(packing, step);
    push.apply(alone, step);
    shake.apply(packing, step);
    shake.apply(alone, step);
    packing.step(step);
    alone.step(step);
  }
  for (const BodyId wall : {pushed, floor}) {
    CHECK(alone.velocity(wall).norm() > 1e-3);
    CHECK((packing.velocity(wall) - alone.velocity(wall)).norm() <=
          2e-2 * alone.velocity(wall).norm());
    CHECK((packing.pose(wall).position - alone.pose(wall).position).norm() <= 1e-3 * size);
  }
  CHECK_THROWS_AS(shake.apply(packing, 0), std::invalid_argument);
  CHECK_THROWS_AS(ForceDrive(floor, Vector::UnitY(), HarmonicForce(1, 5, 50)).apply(packing, step),
                  std::invalid_argument);
  CHECK_THROWS_AS(VelocityDrive(alone.grain(0), Vector::UnitY(), [](double) { return 1.0; })
                      .apply(packing, step),
                  std::invalid_argument);
}

// From one state on: over many steps, the collisions amplify what the tolerance leaves open. One process
// with another tolerance is as far away then as several processes are.
TEST_CASE("A pressure on a wall is that of one process") {
  const auto build = [] { return box_of_grains<SoftPolyhedra>(60, 1e-6); };
  DistributedSimulation<SoftPolyhedra> packing(MPI_COMM_WORLD, on_first_rank<SoftPolyhedra>(build));
  SoftPolyhedra alone = build();
  const BodyId lid = alone.walls().back(), opposite = alone.walls().front();
  const auto area = [] { return 0.5; };
  const double mass = 20 * alone.bodies().grain_mass[0], pressure = 400 * mass;
  const PressureLoad load(packing, lid, pressure, mass, area);
  const PressureLoad load_alone(alone, lid, pressure, mass, area);
  double measured = 0, measured_alone = 0;
  for (int k = 1; k <= 300; ++k) {
    load.apply(packing, step);
    load_alone.apply(alone, step);
    std::optional<SoftPolyhedra> same;
    if (k % 10 == 0) same = packing.gather();
    const SoftPolyhedra::Vector before = packing.velocity(lid);
    packing.step(step);
    alone.step(step);
    const double now = wall_pressure(packing, opposite, step, 0.5);
    measured += now / 300;
    measured_alone += wall_pressure(alone, opposite, step, 0.5) / 300;
    // The wall moves along its normal only, here -y.
    const double balance = mass * (packing.velocity(lid) - before).y() -
                           packing.contact_impulse(lid).y() + step * 0.5 * pressure;
    CHECK(std::abs(balance) <= 1e-12 * step * pressure);
    if (!same) continue;
    same->step(step);
    CHECK((packing.velocity(lid) - same->velocity(lid)).norm() <= 1e-5 * size / step);
    CHECK(now == doctest::Approx(wall_pressure(*same, opposite, step, 0.5)).epsilon(1e-3));
  }
  CHECK(measured == doctest::Approx(measured_alone).epsilon(0.02));
  const SoftPolyhedra::Vector speed = packing.velocity(lid);
  CHECK(speed.norm() > 0);
  const PressureLoad again(packing, lid, pressure, mass, area);  // the wall has this mass
  CHECK(packing.velocity(lid) == speed);
  CHECK_THROWS_AS(wall_pressure(packing, alone.grain(0), step, 0.5), std::invalid_argument);
}
