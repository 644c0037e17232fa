// SPDX-License-Identifier: MIT
#include "moreau/measure/coordination.hpp"

#include <cmath>
#include <doctest/doctest.h>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/measure/contact_classes.hpp"
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
  CHECK(all.neighbours == doctest::Approx(5 / 4.0));
  CHECK(all.points_per_grain == doctest::Approx(10 / 4.0));
  const Coordination without = coordination(world, 1);
  CHECK(without.rattlers == 1);
  CHECK(without.neighbours == doctest::Approx(5 / 3.0));
}

TEST_CASE_TEMPLATE("a grain on obstacles has the coordination number of one on walls", ShapeT,
                   MOREAU_TYPES((Disk<>, BallIn<Space<3, float>>),
                                (Ball<>, BallIn<Space<2, float>>))) {
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
    }
}
