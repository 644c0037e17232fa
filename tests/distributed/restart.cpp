// SPDX-License-Identifier: MIT
// A gathered simulation is the one that was distributed, and goes on over any number of processes.
#include <doctest/doctest.h>

#include "moreau/io/snapshot.hpp"

#include "distributed/worlds.hpp"

using namespace distributed_test;

namespace {

template <class World>
void check_round_trip(std::size_t count) {
  World start = box_of_grains<World>(count);
  const BodyId gone[] = {start.grain(3), start.grain(17)};
  start.remove_grains(gone);
  for (int k = 0; k < 150; ++k) start.step(step);
  DistributedSimulation<World> packing(MPI_COMM_WORLD, on_first_rank<World>([&] { return start; }));
  // Springs remember the velocity of the floor in the last step, not the velocity that it gets here.
  const BodyId floor = packing.walls()[std::size_t(World::S::dim - 1)];
  const typename World::S::Vector velocity = 0.01 * World::S::Vector::Unit(World::S::dim - 1);
  packing.set_velocity(floor, velocity);
  start.set_velocity(floor, velocity);
  std::optional<World> whole = packing.gather();
  if (!whole) return;
  CHECK(state(*whole) == state(start));
  for (const double factor : {0.3, 1.0}) {  // springs use these velocities if the step changes
    whole->step(factor * step);
    start.step(factor * step);
    CHECK(state(*whole) == state(start));
  }
  CHECK(!whole->contains(gone[0]));
  // The index of a removed grain is taken again.
  CHECK(whole->add_grain(ShapeId(0), Pose<typename World::S>{}, 2700).index() ==
        start.add_grain(ShapeId(0), Pose<typename World::S>{}, 2700).index());
}

}  // namespace

TEST_CASE("To distribute and to gather changes nothing") {
  check_round_trip<Polygons>(60);
  check_round_trip<Balls>(60);
  check_round_trip<SoftPolyhedra>(40);
}

TEST_CASE("A simulation that is gathered before its first step refuses deep overlaps, too") {
  const auto build = [] {
    Balls world = empty_world<Balls>();
    const ShapeId shape = world.add_shape(Ball<>(size / 2));
    for (const double x : {0.0, 1.5, 3.0, 4.5, 0.1})
      world.add_grain(shape, Pose<Space<3>>({size * x, 0, 0}), 2700);
    return world;
  };
  DistributedSimulation<Balls> packing(MPI_COMM_WORLD, on_first_rank<Balls>(build));
  std::optional<Balls> whole = packing.gather();
  if (!whole) return;
  CHECK_THROWS_AS(whole->step(step), std::invalid_argument);
  whole->allow_overlaps();
  CHECK(whole->step(step).overlapping == 1);
}

TEST_CASE("A run goes on after a snapshot, over another number of processes") {
  using World = SoftPolyhedra;
  const auto build = [] { return box_of_grains<World>(60); };
  std::string bytes;
  double lowest = 0, energy = 0;
  {
    DistributedSimulation<World> packing(MPI_COMM_WORLD, on_first_rank<World>(build));
    for (int k = 0; k < 200; ++k) packing.step(step);
    if (const std::optional<World> whole = packing.gather()) bytes = snapshot(*whole);
    for (int k = 0; k < 20; ++k) energy = packing.step(step).elastic_energy;
    lowest = packing.pose(packing.walls().back()).position[1];
  }
  // One process fewer.
  MPI_Comm fewer = MPI_COMM_NULL;
  const bool is_left = rank() + 1 < ranks();
  MPI_Comm_split(MPI_COMM_WORLD, is_left ? 0 : MPI_UNDEFINED, 0, &fewer);
  if (!is_left) return;
  {
    World world = empty_world<World>();
    if (rank() == 0) restore_snapshot(bytes, world);
    DistributedSimulation<World> packing(fewer, std::move(world));
    CHECK(packing.time() == doctest::Approx(200 * step));
    StepReport report;
    for (int k = 0; k < 20; ++k) {
      report = packing.step(step);
      CHECK(report.solve.converged);
      if (k == 0) CHECK(report.warm_started * 10 >= report.points * 9);
    }
    // The same up to the tolerance of the solver.
    CHECK(report.elastic_energy == doctest::Approx(energy).epsilon(0.02));
    CHECK(std::abs(packing.pose(packing.walls().back()).position[1] - lowest) <= 1e-5);
  }
  MPI_Comm_free(&fewer);
}

TEST_CASE("Walls are moved and read by their ids, in all processes") {
  using World = Balls;
  const auto build = [] { return box_of_grains<World>(30); };
  DistributedSimulation<World> packing(MPI_COMM_WORLD, on_first_rank<World>(build));
  const BodyId mover = packing.walls().back(), floor = packing.walls()[2];
  const World reference = build();
  CHECK(packing.walls().size() == reference.walls().size());
  CHECK(mover == reference.walls().back());
  CHECK(packing.pose(mover).position == reference.pose(mover).position);
  packing.set_wall_mass(mover, INFINITY);
  packing.set_velocity(mover, {0, -0.1, 0});
  for (int k = 0; k < 100; ++k) packing.step(step);
  CHECK(packing.pose(mover).position[1] ==
        doctest::Approx(reference.pose(mover).position[1] - 0.1 * 100 * step));
  CHECK(packing.velocity(mover)[1] == -0.1);
  CHECK(packing.contact_impulse(floor)[2] < 0);
  CHECK_THROWS_AS(packing.pose(reference.grain(0)), std::invalid_argument);
  CHECK_THROWS_AS(packing.step(-1), std::invalid_argument);
}
