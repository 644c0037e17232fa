// SPDX-License-Identifier: MIT
#include "moreau/measure/energy.hpp"

#include <array>
#include <doctest/doctest.h>
#include <random>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

TEST_CASE_TEMPLATE("energy and momentum of bodies are those of the particles they consist of", S,
                   Space<2, double>, Space<3, double>) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto fill = [&](auto x) {
    for (auto& component : x.reshaped()) component = normal(random);
    return x;
  };
  std::array<BodyMotion<S>, 3> bodies;
  const typename S::Vector origin = fill(typename S::Vector());
  double energy = 0;
  typename S::Vector linear = S::Vector::Zero();
  typename S::Angular angular = S::Angular::Zero();
  for (auto& body : bodies) {
    body.position = fill(typename S::Vector());
    body.velocity = fill(typename S::Twist());
    // The particles form pairs at opposite sides of a point, so that this point is the centre of
    // mass.
    for (int i = 0; i < 8; ++i) {
      const double mass = 0.1 + normal(random) * normal(random);
      const typename S::Vector arm = fill(typename S::Vector());
      for (const typename S::Vector& r : {arm, typename S::Vector(-arm)}) {
        const auto lever = S::lever(r);
        const typename S::Vector v = body.velocity.template head<S::dim>() +
                                     lever * body.velocity.template tail<S::angular_dim>();
        body.mass += mass;
        body.inertia += mass * lever.transpose() * lever;
        energy += mass * v.squaredNorm() / 2;
        linear += mass * v;
        angular += S::moment(body.position + r - origin, mass * v);
      }
    }
  }
  const auto motion_of = [&](std::size_t k) { return bodies[k]; };
  const KineticEnergy<S> sum = kinetic_energy<S>(bodies.size(), motion_of);
  const Momentum<S> total = momentum<S>(bodies.size(), motion_of, origin);
  CHECK(sum.total() == doctest::Approx(energy).epsilon(1e-13));
  CHECK((total.linear - linear).norm() < 1e-12 * (1 + linear.norm()));
  CHECK((total.angular - angular).norm() < 1e-12 * (1 + angular.norm()));
}

TEST_CASE("the parts of the energy") {
  BodyMotion<Space<2>> disk{2, Space<2>::Inertia(3), Space<2>::Vector(7, 7),
                            Space<2>::Twist(1, 2, -4)};
  const auto energy = kinetic_energy(disk);
  CHECK(energy.translation == 5);
  CHECK(energy.rotation == 24);
  CHECK(momentum(disk).angular[0] == 3 * -4 + 2 * (7 * 2 - 7 * 1));
}

TEST_CASE("energy and momentum of a simulation: of its grains, not of its walls") {
  using S = Space<2>;
  using Law = SignoriniCoulomb<>;
  Simulation<Disk<>, Law> world(1, Materials<Law>(1, Law(0.5)));
  world.set_velocity(world.add_wall(S::Vector(0, 1), S::Vector(0, -5)), S::Vector(0, 7));
  const BodyId grain = world.add_grain(world.add_shape(Disk<>(0.5)), {S::Vector(1, 2)}, 1000);
  world.set_velocity(grain, S::Vector(0, 2));
  world.set_spin(grain, S::Angular(3));
  const double mass = world.bodies().grain_mass[grain.index()];
  const KineticEnergy<S> energy = kinetic_energy(world);
  CHECK(energy.translation == 2 * mass);
  CHECK(energy.rotation == doctest::Approx(mass * 0.25 / 2 * 9 / 2).epsilon(1e-14));
  const Momentum<S> all = momentum(world), about = momentum(world, {0, 2});
  CHECK(all.linear == S::Vector(0, 2 * mass));
  CHECK(all.angular[0] == doctest::Approx(mass * (0.25 / 2 * 3 + 1 * 2)).epsilon(1e-14));
  CHECK(about.angular[0] == all.angular[0]);
  CHECK(momentum(world, {3, 0}).angular[0] ==
        doctest::Approx(mass * (0.25 / 2 * 3 - 2 * 2)).epsilon(1e-14));
}
