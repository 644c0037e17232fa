// SPDX-License-Identifier: MIT
// A servo wall under compliant contacts, whose forces are continuous functions of its position.
#include "moreau/law/compliant.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

#include "moreau/boundary/servo.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

TEST_CASE("a servo wall brings a packing with compliant contacts to its pressure") {
  using namespace moreau;
  using Law = Compliant<SignoriniCoulomb<double>>;
  const double width = 0.11, h = 2e-4, pressure = 500;  // [m], [s], [N/m]
  Simulation<Disk<double>, Law> simulation(0.02,
                                           Materials<Law>(1, Law(SignoriniCoulomb<>(0.3), 2e4)));
  const ShapeId disk = simulation.add_shape(Disk<double>(0.01));
  for (int k = 0; k < 20; ++k)
    simulation.add_grain(
        disk, {{0.012 + 0.0215 * (k % 5), 0.011 + 0.021 * (k / 5)}, Space<2>::identity()}, 1000);
  simulation.add_wall({1, 0}, {0, 0});
  simulation.add_wall({-1, 0}, {width, 0});
  simulation.add_wall({0, 1}, {0, 0});
  const BodyId lid = simulation.add_wall({0, -1}, {0, 0.1});
  const PressureServo servo(lid, pressure, 1e-4, 0.1, [&] { return width; });
  double worst = 0;
  for (int k = 0; k < 4000; ++k) {
    servo.apply(simulation, h);
    CHECK(simulation.step(h).solve.converged);
    if (k >= 3800)
      worst = std::max(worst, std::abs(wall_pressure(simulation, lid, h, width) / pressure - 1));
  }
  CHECK(worst < 0.01);
}
