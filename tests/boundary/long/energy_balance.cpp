// SPDX-License-Identifier: MIT
// The energy balance under other laws, integrators and walls than in the quick tests.
#include "moreau/measure/energy_balance.hpp"

#include <cmath>
#include <doctest/doctest.h>

#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"

#include "world/assemblies.hpp"

namespace {

using namespace moreau;
using S = Space<2>;
using DiskT = BallIn<S>;
using Vector = S::Vector;

/// Disks of two sizes with initial velocities in a box.
template <class World>
EnergyBalance<S> thrown(World& world, double h) {
  const ShapeId shapes[] = {world.add_shape(DiskT(0.01)), world.add_shape(DiskT(0.008))};
  for (int k = 0; k < 12; ++k) {
    const Vector x(0.015 + 0.022 * (k % 3), 0.012 + 0.022 * (k / 3));
    const BodyId grain = world.add_grain(shapes[k % 2], {x, S::identity()}, 1000);
    world.set_velocity(grain, {0.3, 0.1 * (k % 3)});
    world.set_spin(grain, S::Angular(10.0 * (k % 2)));
  }
  world.add_wall({0, 1}, {0, 0});
  world.add_wall({1, 0}, {0, 0});
  world.add_wall({-1, 0}, {0.08, 0});
  world.set_gravity({0, -9.81});
  EnergyBalance<S> energy(world);
  for (double t = 0; t < 0.3; t += h) energy.add(world, world.step(h), h);
  return energy;
}

double share(const EnergyBalance<S>& energy) {
  return std::abs(energy.imbalance()) / energy.kinetic_at_start();
}

}  // namespace

TEST_CASE("what rolling takes is in the balance") {
  using Law = RollingResistance<double>;
  Simulation<DiskT, Law> world(0.016, Materials<Law>(1, Law(0.4, 0.2)));
  const auto energy = thrown(world, 5e-4);
  CHECK(share(energy) < 1e-12);
  CHECK(energy.terms().rolling > 1e-3 * energy.kinetic_at_start());
  CHECK(energy.terms().friction > 1e-3 * energy.kinetic_at_start());
}

TEST_CASE("an implicit scheme takes energy, in proportion to the step") {
  using Law = SignoriniCoulomb<double>;
  double shares[2];
  for (int refine = 0; refine < 2; ++refine) {
    scenes::World<DiskT> world(0.016, Materials<Law>(1, Law(0.4)), {}, {}, {}, MoreauJean(1));
    const auto energy = thrown(world, refine == 0 ? 5e-4 : 1.25e-4);
    CHECK(energy.imbalance() < 0);
    shares[refine] = share(energy);
  }
  CHECK(shares[0] < 0.1);
  CHECK(shares[1] < 0.5 * shares[0]);
}

TEST_CASE("the balance of springs closes as the step shrinks") {
  using Law = LinearSpringDashpot<double>;
  double shares[2];
  for (int refine = 0; refine < 2; ++refine) {
    Simulation<DiskT, Law> world(0.016, Materials<Law>(1, Law(1e4, 8e3, 0.4, 0.5)));
    shares[refine] = share(thrown(world, refine == 0 ? 2e-5 : 5e-6));
  }
  CHECK(shares[0] < 0.05);
  CHECK(shares[1] < 0.5 * shares[0]);
}

TEST_CASE("a drum that turns works on what is in it") {
  using Law = SignoriniCoulomb<double>;
  scenes::World<DiskT> world(0.02, Materials<Law>(1, Law(0.5)));
  const ShapeId disk = world.add_shape(DiskT(0.01));
  for (int k = 0; k < 9; ++k) {
    const Vector x(-0.025 + 0.025 * (k % 3), -0.03 + 0.025 * (k / 3));
    world.add_grain(disk, {x, S::identity()}, 1000);
  }
  const BodyId drum = world.add_cylinder({0, 0}, S::Angular(1), 0.06);
  world.set_spin(drum, S::Angular(3));
  world.set_gravity({0, -9.81});
  EnergyBalance<S> energy(world);
  for (int k = 0; k < 1000; ++k) energy.add(world, world.step(5e-4), 5e-4);
  const EnergyTerms& terms = energy.terms();
  CHECK(terms.drives > 0);
  CHECK(terms.friction > 0);
  CHECK(std::abs(energy.imbalance()) < 1e-12 * (terms.drives + terms.friction + terms.impacts));
}
