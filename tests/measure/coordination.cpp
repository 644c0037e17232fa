// SPDX-License-Identifier: MIT
#include "moreau/measure/coordination.hpp"

#include <doctest/doctest.h>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/world/simulation.hpp"

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
