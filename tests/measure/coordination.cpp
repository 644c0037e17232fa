// SPDX-License-Identifier: MIT
#include "moreau/measure/coordination.hpp"

#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/measure/contact_classes.hpp"
#include "moreau/measure/fabric.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

TEST_CASE("coordination() of a stack counts pairs, not contact points, and walls as neighbours") {
  using S = Space<2>;
  using Law = SignoriniCoulomb<double>;
  Simulation<Polygon<double>, Law> world(0.1, Materials<Law>(1, Law(0.5)));
  const ShapeId square = world.add_shape(
      Polygon<double>({{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}}));
  CHECK(coordination(world).neighbours == 0);
  for (int k = 0; k < 3; ++k) world.add_grain(square, {{0, 0.05 + 0.1 * k}, S::identity()}, 1000);
  world.add_grain(square, {{1, 1}, S::identity()}, 1000);  // falls
  world.add_wall({0, 1}, {0, 0});
  world.set_gravity({0, -9.81});
  world.step(1e-3);
  // The floor and two pairs of squares carry load, each at two points: 1 + 2 + 2 neighbours.
  const Coordination all = coordination(world);
  CHECK(all.grains == 4);
  CHECK(all.pairs == 3);
  CHECK(all.points == 6);
  // Where many headers are read together, those of detection come before: no name of theirs may hide the type of a segment.
  CHECK(force_chains(world, 1e-3).size() == 6);
  CHECK(all.neighbours == doctest::Approx(5 / 4.0));
  CHECK(all.points_per_grain == doctest::Approx(10 / 4.0));
  const Coordination without = coordination(world, 1);
  CHECK(without.rattlers == 1);
  CHECK(without.neighbours == doctest::Approx(5 / 3.0));
}

namespace {

/// The rattlers by the definition: passes over all bodies until none is found.
std::size_t rattlers_by_passes(const std::vector<Contact<Space<2>>>& pairs, std::size_t bodies,
                               std::size_t fewest, const auto& is_grain) {
  std::vector<bool> taken(bodies, false);
  std::size_t count = 0;
  for (bool found = true; found;) {
    found = false;
    std::vector<std::size_t> neighbours(bodies, 0);
    for (const auto& pair : pairs)
      if (!taken[pair.a] && !taken[pair.b]) ++neighbours[pair.a], ++neighbours[pair.b];
    for (std::size_t i = 0; i < bodies; ++i)
      if (!taken[i] && is_grain(i) && neighbours[i] < fewest) taken[i] = found = true, ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("rattlers are those that passes over all grains find, also of a long chain") {
  using S = Space<2>;
  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    const std::uint32_t bodies = 30;
    std::vector<Contact<S>> pairs;
    std::bernoulli_distribution touches(0.12);
    for (std::uint32_t a = 0; a < bodies; ++a)
      for (std::uint32_t b = a + 1; b < bodies; ++b)
        if (touches(random)) {
          Contact<S>& pair = pairs.emplace_back();
          pair.a = a, pair.b = b;
        }
    const std::vector<S::Vector> push(pairs.size(), S::Vector::UnitX());
    const auto is_grain = [](std::size_t i) { return i % 7 != 0; };
    for (const std::size_t fewest : {0u, 1u, 2u, 3u, 4u}) {
      const auto found = CoordinationCounter<S>().count(pairs, push, bodies, is_grain, fewest);
      CHECK(found.rattlers == rattlers_by_passes(pairs, bodies, fewest, is_grain));
    }
  }
  // A free chain loses its two ends, and so on. By passes this takes 1e10 operations.
  constexpr std::uint32_t count = 100000;
  std::vector<Contact<S>> chain(count - 1);
  for (std::uint32_t c = 0; c + 1 < count; ++c) chain[c].a = c, chain[c].b = c + 1;
  const std::vector<S::Vector> push(chain.size(), S::Vector::UnitX());
  const auto found = CoordinationCounter<S>().count(
      chain, push, count, [](auto) { return true; }, 2);
  CHECK(found.rattlers == count);
  CHECK(found.pairs == 0);
}

TEST_CASE_TEMPLATE("a grain on obstacles has the coordination number of one on walls", ShapeT,
                   MOREAU_TYPES((Disk<>, Ball<>),
                                (BallIn<Space<2, float>>, BallIn<Space<3, float>>))) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = SignoriniCoulomb<T>;
  const T radius = T(0.01), half = std::sqrt(T(0.5));
  const Vector up = Vector::Unit(S::dim - 1), aside = Vector::UnitX();
  const auto build = [&](bool on_obstacles) {
    Simulation<ShapeT, Law> world(2 * radius, Law(T(0.5)));
    const ShapeId ball = world.add_shape(ShapeT(radius));
    world.add_grain(ball, Pose<S>(Vector(Vector::Zero())), T(2700));
    for (const T side : {T(-1), T(1)}) {
      const Vector normal = half * (up - side * aside);  // from the support to the ball
      if (on_obstacles)
        world.prescribe_motion(
            world.add_grain(ball, Pose<S>(Vector(-2 * radius * normal)), T(2700)));
      else
        world.add_wall(normal, Vector(-radius * normal));
    }
    world.set_gravity(Vector(T(-9.81) * up));
    world.step(T(1e-3));
    return world;
  };
  for (const bool on_obstacles : {true, false})
    for (const std::size_t fewest : {0u, 2u, 3u}) {
      CAPTURE(on_obstacles);
      CAPTURE(fewest);
      const auto world = build(on_obstacles);
      const Coordination found = coordination(world, fewest);
      const bool is_left = fewest <= 2;
      CHECK(found.grains == std::size_t(is_left));
      CHECK(found.rattlers == std::size_t(!is_left));
      CHECK(found.pairs == (is_left ? 2 : 0));
      CHECK(found.neighbours == (is_left ? 2 : 0));
      CHECK(found.points_per_grain == (is_left ? 2 : 0));
      double neighbours = 0;
      for (const auto& share : contact_classes(world, T(1e-3)).shares)
        neighbours += share.neighbours;
      CHECK(neighbours == 2);
      // The branch vectors end at the obstacles, as at walls, and there is no pair of grains.
      const Aabb<S> box{Vector::Constant(T(-0.1)), Vector::Constant(T(0.1))};
      double pushes = 0;
      for (const auto& impulse : world.contacts().impulses) pushes += double(impulse[0]) / 1e-3;
      const double trace = double(radius) * pushes / std::pow(0.2, S::dim);
      const auto stress = contact_stress(world, T(1e-3), box);
      CHECK(double(stress.trace()) == doctest::Approx(trace).epsilon(1e-5));
      CHECK(fabric(world, T(1e-3), box).pairs == 0);
    }
}
