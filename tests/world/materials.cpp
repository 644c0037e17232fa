// SPDX-License-Identifier: MIT
// A law for each pair of materials.
#include <cmath>
#include <doctest/doctest.h>

#include "world/assemblies.hpp"

using namespace moreau;

TEST_CASE("a wall with a material of its own has a law of its own") {
  using Law = SignoriniCoulomb<double>;
  const MaterialId stone(0), glass(1);
  Materials<Law> materials(2, Law(0.4));  // friction 0.4 for every pair of two materials
  materials.set(stone, glass, Law(0.0));  // no friction for this pair
  scenes::World<Polygon<double>> simulation(0.02, materials);
  const ShapeId block = simulation.add_shape(cuboid<Polygon<double>>({0.01, 0.01}));

  const BodyId on_stone = simulation.add_grain(block, {{-0.05, 0.01}, Space<2>::identity()}, 2700);
  const BodyId on_glass = simulation.add_grain(block, {{0.05, 0.111}, Space<2>::identity()}, 2700);
  simulation.add_wall({0, 1}, {0, 0});  // of material 0
  simulation.add_wall({0, -1}, {0, 0.121}, glass);
  simulation.set_gravity({0.1 * 9.81, 0});   // along the walls
  simulation.set_force(on_stone, {0, -10});  // [N], presses one block on each wall
  simulation.set_force(on_glass, {0, 10});
  for (int k = 0; k < 100; ++k) CHECK(simulation.step(1e-3).solve.converged);

  CHECK(std::abs(simulation.velocity(on_stone)[0]) <
        1e-6);  // 1.06 N along the wall, at most 4 N of friction
  CHECK(simulation.velocity(on_glass)[0] == doctest::Approx(0.1 * 9.81 * 0.1));
}
