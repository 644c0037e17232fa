// SPDX-License-Identifier: MIT
// Every contact is found by exactly one process, whatever the grains and the boxes of the processes.
#include <algorithm>
#include <cstdint>
#include <doctest/doctest.h>

#include "distributed/worlds.hpp"

using namespace distributed_test;

namespace {

/// Balls of very different size at random places, so that some are wider than the boxes of the
/// processes. They overlap, and have velocities that mix them.
template <class World>
World random_balls(std::uint64_t seed, std::size_t count) {
  using S = typename World::S;
  using ShapeT = ShapeIn<World>;
  World world = empty_world<World>();
  world.allow_overlaps();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  const double length = 0.04 * std::pow(double(count), 1.0 / S::dim);
  // Clusters: the boxes get many different sizes.
  typename S::Vector center = S::Vector::Constant(length / 2);
  for (std::size_t k = 0; k < count; ++k) {
    const double width = size * (k % 50 == 0 ? 10 : 1 + part(random));
    const ShapeId shape = world.add_shape(regular_shape<ShapeT>(width));
    Pose<S> pose;
    if (k % 20 == 0)
      for (int axis = 0; axis < S::dim; ++axis) center[axis] = length * part(random);
    for (int axis = 0; axis < S::dim; ++axis)
      pose.position[axis] = center[axis] + 0.4 * length * (part(random) - 0.5);
    pose.rotation = S::exp(S::Angular::Constant(part(random)));
    const BodyId grain = world.add_grain(shape, pose, 2700);
    typename S::Vector velocity;
    for (int axis = 0; axis < S::dim; ++axis) velocity[axis] = 2 * (part(random) - 0.5);
    world.set_velocity(grain, velocity);
  }
  world.add_wall(S::Vector::UnitX(), S::Vector::Zero());
  return world;
}

/// The keys of the contacts of all processes, on rank 0, by the ids of the whole simulation.
template <class World>
std::vector<ContactKey> all_keys(DistributedSimulation<World>& packing) {
  std::vector<ContactKey> keys;
  for (ContactKey key : packing.local().contacts().keys) {
    key.a = packing.id(BodyId(key.a)).value;
    key.b = packing.id(BodyId(key.b)).value;
    keys.push_back(key);
  }
  std::string bytes(reinterpret_cast<const char*>(keys.data()), keys.size() * sizeof(ContactKey));
  std::vector<ContactKey> all;
  for (const std::string& part : packing.processes().gather(std::move(bytes))) {
    const std::size_t first = all.size();
    all.resize(first + part.size() / sizeof(ContactKey));
    std::memcpy(static_cast<void*>(all.data() + first), part.data(), part.size());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Compares the contacts with those of one process through some steps.
template <class World>
void check_contacts(const World& scene, int steps) {
  DistributedSimulation<World> packing(MPI_COMM_WORLD, on_first_rank<World>([&] { return scene; }));
  std::optional<World> before;
  for (int k = 0; k < steps; ++k) {
    before = packing.gather();
    const StepReport report = packing.step(step);
    const std::vector<ContactKey> keys = all_keys(packing);
    for (const std::uint32_t body :
         {report.deepest_a, report.deepest_b})  // the same in all processes
      CHECK(packing.processes().sum(double(body)) == double(body) * packing.processes().size());
    if (!before) continue;
    const StepReport alone = before->step(step);
    CHECK(keys == before->contacts().keys);
    CHECK(report.pairs == alone.pairs);
    CHECK(report.points == alone.points);
    CHECK(report.overlapping == alone.overlapping);
    CHECK(report.max_overlap == doctest::Approx(alone.max_overlap));
    if (alone.max_overlap > 0) {
      CHECK(report.deepest_a == alone.deepest_a);
      CHECK(report.deepest_b == alone.deepest_b);
    }
    CHECK(report.mean_overlap == doctest::Approx(alone.mean_overlap));
    CHECK(report.warm_started == alone.warm_started);
  }
}

}  // namespace

TEST_CASE("The owner of a contact is one of the owners of its grains, the same for both") {
  for (int a = 0; a < 20; ++a)
    for (int b = 0; b < 20; ++b) {
      const int owner = detail::RankTopology::owner_of_contact(a, b);
      CHECK((owner == a || owner == b));
      CHECK(owner == detail::RankTopology::owner_of_contact(b, a));
      // Exactly one process has the contact; here body 0 is a grain of a, body 1 one of b.
      int found = 0;
      for (int rank = 0; rank < 20; ++rank) {
        detail::RankTopology topology;
        topology.rank = rank;
        topology.owner = {a, b, detail::RankTopology::everywhere};
        found += topology.has_contact(0, 1);
        CHECK(topology.has_contact(0, 2) == (rank == a));
        CHECK(topology.has_contact(2, 1) == (rank == b));
      }
      CHECK(found == 1);
    }
}

TEST_CASE("Each contact of random packings is found once") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    check_contacts(random_balls<Balls>(seed, 120), 15);
    check_contacts(random_balls<Polygons>(seed, 120), 15);
  }
}

TEST_CASE("Each contact across a periodic boundary is found once") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Balls balls = random_balls<Balls>(seed, 200);
    balls.set_periodic(1, 0.05, 0.5);
    balls.set_periodic(2, -0.1, 0.4);
    check_contacts(balls, 15);
    Polygons polygons = random_balls<Polygons>(seed, 120);
    polygons.set_periodic(1, 0, 0.62);
    check_contacts(polygons, 15);
  }
}

TEST_CASE("There may be fewer grains than processes") {
  for (std::size_t count = 0; count < 3; ++count) {
    Balls few = random_balls<Balls>(1, count);
    few.set_gravity({0, 0, -9.81});
    check_contacts(few, 5);
  }
}

TEST_CASE("Grains leave their processes and come back, without a new partition") {
  // A row of balls moves along x: one process after the other is left without grains.
  Balls row = empty_world<Balls>();
  const ShapeId shape = row.add_shape(regular_shape<Ball<>>(size));
  for (int k = 0; k < 40; ++k) {
    const BodyId ball =
        row.add_grain(shape, {{0.0201 * k, 0, 0.01}, Space<3>::Rotation::Identity()}, 2700);
    row.set_velocity(ball, {10, 0, 0});
  }
  row.add_wall({0, 0, 1}, {0, 0, 0});
  row.add_wall({-1, 0, 0}, {1.5, 0, 0});
  row.set_gravity({0, 0, -9.81});
  DistributionOptions never;
  never.imbalance = 1e9;
  DistributedSimulation<Balls> packing(MPI_COMM_WORLD, on_first_rank<Balls>([&] { return row; }),
                                       never);
  bool was_empty = false;
  for (int k = 0; k < 150; ++k) {
    const bool checks = k % 10 == 0;
    std::optional<Balls> before;
    if (checks) before = packing.gather();
    const StepReport report = packing.step(step);
    if (checks) {
      const std::vector<ContactKey> keys = all_keys(packing);
      if (before) {
        // One process does not solve every step to 1e-6 either, while the row hits the wall.
        if (before->step(step).solve.converged) CHECK(report.solve.converged);
        CHECK(keys == before->contacts().keys);
      }
      CHECK(packing.grain_count() == 40);
    }
    was_empty = was_empty || packing.distribution().grains == 0;
  }
  CHECK(packing.processes().sum(was_empty) >= 1);
  CHECK(packing.distribution().partitions == 1);
}
