// SPDX-License-Identifier: MIT
// Grains that are removed and added during a run: ids, contacts, the list of pairs, snapshots.
#include <cstring>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/io/snapshot.hpp"
#include "moreau/measure/coordination.hpp"

#include "sanitized.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"
#include "world/spring_world.hpp"

using namespace moreau;
using scenes::BoxOfGrains;
using scenes::LawOf;
using scenes::World;

namespace {

constexpr double h = 5e-4;

/// A pile of grains of one shape on a floor, between side walls unless it is periodic along x.
template <class ShapeT>
struct Pile {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  World<ShapeT> world{0.02, Materials<LawOf<ShapeT>>(1, LawOf<ShapeT>(0.4))};
  ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));

  explicit Pile(int count, bool periodic = false) {
    world.set_gravity(-9.81 * Vector::Unit(up));
    world.add_wall(Vector::Unit(up), Vector::Zero());
    for (int axis = 0; axis < up; ++axis) {
      if (periodic && axis == 0) {
        world.set_periodic(0, 0, 0.1);
        continue;
      }
      world.add_wall(Vector::Unit(axis), Vector::Zero());
      world.add_wall(-Vector::Unit(axis), 0.1 * Vector::Unit(axis));
    }
    for (int k = 0; k < count; ++k) add(k, 0.015 + 0.025 * (k / 4));
  }
  /// Adds a grain in one of four columns.
  BodyId add(int column, double height) {
    Vector x = Vector::Constant(0.05);
    x[0] = 0.0125 + 0.025 * (column % 4);
    x[up] = height;
    return world.add_grain(shape, {x, S::exp(S::Angular::Constant(0.1 * column))}, 2700);
  }
  double highest() const {
    double height = 0;
    for (const BodyId grain : world.grains())
      height = std::max(height, world.pose(grain).position[up]);
    return height;
  }
  StepReport run(int steps) {
    StepReport report;
    for (int k = 0; k < steps; ++k) report = world.step(h);
    return report;
  }
  /// Removes and adds grains, at places that the random numbers give.
  void churn(int rounds, std::mt19937_64& random) {
    for (int k = 0; k < rounds; ++k) {
      const auto grains = world.grains();
      const std::vector<BodyId> gone{grains[random() % (grains.size() / 2)], grains.back()};
      world.remove_grains(gone);
      run(3);
      for (int added = 0; added < 2; ++added) {
        add(int(random() % 4), highest() + 0.03);
        run(2);
      }
    }
  }
};

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_CASE("the id of a removed grain is refused, also when its index has a new body") {
  Pile<Disk<>> pile(3);
  auto& world = pile.world;
  const std::vector<BodyId> grains(world.grains().begin(), world.grains().end());
  const std::size_t bodies = world.bodies().size();
  world.remove_grain(grains[1]);
  CHECK(world.grain_count() == 2);
  CHECK(world.bodies().size() == bodies);
  CHECK_FALSE(world.contains(grains[1]));
  CHECK_FALSE(world.is_grain(grains[1].index()));
  CHECK(world.contains(grains[2]));
  const auto refused = [&] {
    CHECK_THROWS_WITH_AS(world.velocity(grains[1]),
                         "Simulation::velocity: body = 4 must not be the id of a removed grain",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(world.remove_grain(grains[1]),
                         "Simulation::remove_grain: grain = 4 must be the id of a grain",
                         std::invalid_argument);
    CHECK_THROWS_AS(world.set_pose(grains[1], {}), std::invalid_argument);
    CHECK_THROWS_AS(world.shape(grains[1]), std::invalid_argument);
    CHECK_THROWS_AS(world.prescribe_motion(grains[1]), std::invalid_argument);
  };
  refused();
  CHECK_THROWS_WITH_AS(world.body_id(4),
                       "Simulation::body_id: index = 4 must be the index of a body",
                       std::invalid_argument);

  const BodyId added = pile.add(1, 0.2);
  CHECK(added.index() == grains[1].index());
  CHECK(added != grains[1]);
  CHECK(world.bodies().size() == bodies);
  CHECK(world.body_id(4) == added);
  CHECK(world.velocity(added).isZero(0));
  CHECK(std::is_sorted(world.grains().begin(), world.grains().end()));
  refused();
  world.remove_grain(added);
  CHECK_THROWS_WITH_AS(world.spin(added),
                       "Simulation::spin: body = 4 (generation 2) must not be the id of a removed "
                       "grain",
                       std::invalid_argument);

  // A list is removed as a whole or not at all.
  const std::vector<BodyId> twice{grains[0], grains[2], grains[0]},
      wall{grains[0], world.walls()[0]};
  CHECK_THROWS_WITH_AS(world.remove_grains(twice),
                       "Simulation::remove_grains: grain = 3 must be listed once",
                       std::invalid_argument);
  CHECK_THROWS_AS(world.remove_grains(wall), std::invalid_argument);
  CHECK(world.grain_count() == 2);
  world.remove_grains({});
  world.remove_grains(world.grains());
  CHECK(world.grain_count() == 0);
  CHECK(world.step(h).points == 0);
}

TEST_CASE_TEMPLATE("a grain that never touched the others leaves no trace in their bits", ShapeT,
                   MOREAU_TYPES((Polygon<>, Ball<>), (Disk<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const auto build = [](bool with_guest) {
    World<ShapeT> world(0.02, Materials<LawOf<ShapeT>>(1, LawOf<ShapeT>(0.4)));
    const ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));
    world.set_gravity(-9.81 * Vector::Unit(S::dim - 1));
    world.add_wall(Vector::Unit(S::dim - 1), Vector::Zero());
    if (with_guest) world.add_grain(shape, {9 * Vector::Unit(S::dim - 1), S::identity()}, 2700);
    for (int k = 0; k < 8; ++k)
      world.add_grain(
          shape,
          {Vector::UnitX() * 0.003 * (k % 3) + Vector::Unit(S::dim - 1) * (0.012 + 0.025 * k),
           S::exp(S::Angular::Constant(0.1 * k))},
          2700);
    return world;
  };
  World<ShapeT> with = build(true), without = build(false);
  for (int k = 0; k < rounds(300); ++k) {
    if (k == 120) with.remove_grain(with.grain(0));
    const StepReport one = with.step(h), two = without.step(h);
    REQUIRE(one.points == two.points);
    REQUIRE(one.warm_started == two.warm_started);
  }
  for (std::size_t k = 0; k < without.grain_count(); ++k) {
    const std::size_t i = with.grain(with.grain_count() - 8 + k).index();
    const std::size_t j = without.grain(k).index();
    CHECK(same_bits(with.bodies().velocity[i], without.bodies().velocity[j]));
    CHECK(with.bodies().pose[i].position == without.bodies().pose[j].position);
  }
}

TEST_CASE("contacts of the other grains keep their impulses; a new grain starts without") {
  Pile<Disk<>> pile(12);
  auto& world = pile.world;
  pile.run(2000);
  const BodyId top = world.grains().back();
  const Pose<Space<2>> place = world.pose(top);
  const auto contacts_of = [&](std::uint32_t body) {
    std::size_t count = 0;
    for (const auto& point : world.contacts().points) count += point.a == body || point.b == body;
    return count;
  };
  const std::size_t all = world.contacts().size(), lost = contacts_of(top.value);
  REQUIRE(lost > 0);
  world.remove_grain(top);
  CHECK(world.contacts().size() == all - lost);
  CHECK(contacts_of(top.value) == 0);
  const Coordination counted = coordination(world);
  CHECK(counted.grains == 11);
  CHECK(counted.points <= all - lost);

  // At the same place and with the same index, so that its contacts have the same keys.
  CHECK(world.add_grain(pile.shape, place, 2700).index() == top.index());
  const StepReport report = world.step(h);
  CHECK(report.points == all);
  CHECK(report.warm_started == all - lost);
  CHECK(world.step(h).warm_started == all);
}

TEST_CASE_TEMPLATE("contacts after removals are those of a new simulation of the same grains",
                   ShapeT, MOREAU_TYPES((Polygon<>, Ball<>), (Disk<>))) {
  for (const bool periodic : {false, true}) {
    Pile<ShapeT> pile(16, periodic), other(0, periodic);
    pile.world.set_contact_points(ContactPoints::all);
    other.world.set_contact_points(ContactPoints::all);
    std::mt19937_64 random(5);
    pile.run(100);
    pile.churn(rounds(30), random);
    pile.world.remove_grain(pile.world.grain(3));
    for (const BodyId grain : pile.world.grains()) {
      const BodyId copy = other.world.add_grain(other.shape, pile.world.pose(grain), 2700);
      other.world.set_velocity(copy, pile.world.velocity(grain));
      other.world.set_spin(copy, pile.world.spin(grain));
    }
    pile.run(1);
    other.run(1);
    const auto &one = pile.world.contacts(), &two = other.world.contacts();
    REQUIRE(one.size() == two.size());
    REQUIRE(one.size() > 5);
    CHECK(std::is_sorted(one.keys.begin(), one.keys.end()));
    for (std::size_t c = 0; c < one.size(); ++c) {
      CHECK(one.keys[c].feature == two.keys[c].feature);
      CHECK(one.points[c].lever_b == two.points[c].lever_b);
    }
  }
}

TEST_CASE_TEMPLATE("a restart amid removals continues with the same bits", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>))) {
  for (const bool periodic : {false, true}) {
    Pile<ShapeT> pile(16, periodic), other(3, periodic);
    std::mt19937_64 random(7), other_random;
    pile.run(50);
    pile.churn(5, random);
    pile.world.remove_grain(pile.world.grain(2));
    pile.world.prescribe_motion(pile.world.grain(4));
    const std::string middle = snapshot(pile.world, random);
    restore_snapshot(middle, other.world, other_random);
    REQUIRE(snapshot(other.world, other_random) == middle);
    pile.churn(5, random);
    other.churn(5, other_random);
    CHECK(snapshot(other.world, other_random) == snapshot(pile.world, random));
    CHECK(other.world.bodies().id == pile.world.bodies().id);
  }
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("springs of a regularized law: the other contacts keep their memory") {
  using S = Space<2>;
  auto world = scenes::spring_world<Disk<>>();
  const ShapeId shape = world.add_shape(Disk<>(0.01));
  world.set_gravity(S::Vector(0, -9.81));
  world.add_wall(S::Vector::UnitY(), S::Vector::Zero());
  for (int k = 0; k < 4; ++k)
    world.add_grain(shape, {S::Vector(0.019 * k, 0.01), S::identity()}, 1000);
  for (int k = 0; k < 2000; ++k) world.step(2e-5);
  const std::size_t all = world.contacts().size();
  world.remove_grain(world.grain(1));
  const std::size_t left = world.contacts().size();
  CHECK(left < all);
  CHECK(world.step(2e-5).warm_started == left);
  const std::string bytes = snapshot(world);
  auto other = world;
  restore_snapshot(bytes, other);
  for (int k = 0; k < 50; ++k) {
    for (auto* one : {&world, &other}) {
      if (k == 20) one->add_grain(shape, {S::Vector(0.02, 0.05), S::identity()}, 1000);
      one->step(2e-5);
    }
  }
  CHECK(snapshot(world) == snapshot(other));
}
#endif
