// SPDX-License-Identifier: MIT
// Threads within the processes change no bit.
#include <doctest/doctest.h>

#include "moreau/io/snapshot.hpp"
#include "moreau/parallel/thread_team.hpp"

#include "distributed/worlds.hpp"

using namespace distributed_test;

namespace {

/// A snapshot of all grains, on rank 0, after some steps in which each process has this many threads.
template <class World>
std::string packed_with(int threads) {
  World world = on_first_rank<World>([] { return box_of_grains<World>(400); });
  world.set_team(ThreadTeam(threads));
  DistributedSimulation<World> packing(MPI_COMM_WORLD, std::move(world));
  for (int k = 0; k < 60; ++k) packing.step(step);
  const std::optional<World> all = packing.gather();
  return all ? snapshot(*all) : std::string();
}

}  // namespace

TEST_CASE_TEMPLATE("Two threads in each process give the bits of one", World, SoftPolyhedra,
                   Polygons) {
  const std::string one = packed_with<World>(1);
  CHECK(packed_with<World>(2) == one);
  CHECK(one.empty() == (rank() != 0));
}
