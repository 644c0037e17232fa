// SPDX-License-Identifier: MIT
// A heavy disk falls on a bed of light ones and squeezes some of them against the floor. Impulses with restitution
// would add energy there. No step adds any, or the report says that it was not solved.
#include <doctest/doctest.h>
#include <random>

#include "moreau/measure/energy.hpp"
#include "moreau/shape/ball.hpp"

#include "sanitized.hpp"
#include "world/assemblies.hpp"

namespace {

using moreau::Disk;
using Vector = moreau::SpaceOf<Disk<double>>::Vector;

/// 240 disks of 2 mm and one of 20 mm that meets them at 2.4 m/s, without gravity.
int count_silent_gains(double tolerance, double restitution, int steps, unsigned seed) {
  using Law = scenes::LawOf<Disk<double>>;
  moreau::ColouredOptions options;
  options.tolerance = tolerance;
  scenes::World<Disk<double>> world{0.002, moreau::Materials<Law>(1, Law(0.3, restitution)),
                                    moreau::ColouredGaussSeidel(options)};
  const auto light = world.add_shape(Disk<double>(0.001));
  const auto heavy = world.add_shape(Disk<double>(0.01));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(0, 0.4e-4);
  constexpr int columns = 30, layers = 8;
  constexpr double spacing = 0.00205;
  for (int k = 0; k < columns; ++k)
    for (int l = 0; l < layers; ++l) {
      const double x = 0.001 + spacing * k + shift(random);
      world.add_grain(light, {Vector(x, 0.001 + spacing * l + shift(random))}, 2500);
    }
  const auto disk = world.add_grain(heavy, {Vector(0.03, 0.011 + spacing * layers)}, 2500);
  world.set_velocity(disk, Vector(0, -2.4));
  world.add_wall(Vector(0, 1), Vector::Zero());
  world.add_wall(Vector(1, 0), Vector::Zero());
  world.add_wall(Vector(-1, 0), Vector(0.0625, 0));
  double before = moreau::kinetic_energy(world).total();
  int silent = 0;
  for (int step = 0; step < steps; ++step) {
    const bool converged = world.step(5e-5).solve.converged;
    const double after = moreau::kinetic_energy(world).total();
    if (converged && after > (1 + 1e-9) * before) ++silent;
    before = after;
  }
  return silent;
}

}  // namespace

TEST_CASE("a heavy disk that squeezes light ones gains no energy without a word") {
  const int steps = rounds(400);
  for (const double tolerance : {1e-2, 1e-3})
    for (const double restitution : {0.5, 1.0})
      for (const unsigned seed : {1u, 2u}) {
        CAPTURE(tolerance);
        CAPTURE(restitution);
        CAPTURE(seed);
        CHECK(count_silent_gains(tolerance, restitution, steps, seed) == 0);
      }
}
