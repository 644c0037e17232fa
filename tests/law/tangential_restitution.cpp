// SPDX-License-Identifier: MIT
// Impacts under e, mu and beta0: Walton's two branches, energy, and contacts that are no impacts.
#include "moreau/law/tangential_restitution.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"

#include "law/vertices_on_floor.hpp"

using namespace landing;

namespace {

using Law = TangentialRestitution<double>;
using Coulomb = SignoriniCoulomb<double>;

/// A sphere or a disk that touches the floor with its lowest point.
template <class S>
Grain<S> ball(double radius) {
  Grain<S> grain;
  grain.name = "ball";
  grain.mass = 0.01;
  grain.inertia *= (S::dim == 3 ? 0.4 : 0.5) * grain.mass * radius * radius;
  grain.vertices.push_back(-radius * S::Vector::Unit(S::dim - 1));
  return grain;
}

/// The floor is body 0 at first; u of the lowest point.
template <class S, class World>
typename S::Vector velocity_below(const World& world, double radius) {
  const auto& twist = world.bodies.velocity[1];
  return linear<S>(twist) +
         S::spin(angular<S>(twist), typename S::Vector(-radius * S::Vector::Unit(S::dim - 1)));
}

}  // namespace

TEST_CASE("tangential restitution: ranges and what the law is") {
  CHECK_THROWS_WITH_AS(Law(0.3, 0.5, 1.1), doctest::Contains("tangential"), std::invalid_argument);
  CHECK_THROWS_AS(Law(0.3, 0.5, -0.1), std::invalid_argument);
  CHECK_THROWS_AS(Law(0.3, 0.5, std::nan("")), std::invalid_argument);
  CHECK_THROWS_AS(Law(-0.3, 0.5, 0.1), std::invalid_argument);
  const Law law(0.25, 0.87, 0.43);
  CHECK(law.friction() == 0.25);
  CHECK(law.restitution() == 0.87);
  CHECK(law.tangential_restitution() == 0.43);
  CHECK(law.tangential_share(0, -1) == 0.43);
  CHECK(law.tangential_share(-1e-6, -1) == 0.43);
  CHECK(law.tangential_share(1e-6, -1) == 0);
  CHECK(law.tangential_share(-1e-6, 0) == 0);
  CHECK(law.tangential_share(-1e-6, 1) == 0);
  CHECK(std::isinf(law.velocity_offset(1e-6, -1, 1e-3)));
  CHECK(std::isinf(Law(0.25, 0, 0.43).velocity_offset(1e-6, -1, 1e-3)));
  static_assert(TangentialRestitutionLaw<Law, Space<2>> && CoulombLaw<Law, Space<3>>);
  static_assert(!StatefulLaw<Law, Space<3>> && !TangentialRestitutionLaw<Coulomb, Space<3>>);
  // What Simulation refuses, see policies.hpp.
  static_assert(CompliantLaw<Compliant<Law>, Space<3>> &&
                TangentialRestitutionLaw<Compliant<Law>, Space<3>>);
}

TEST_CASE_TEMPLATE("tangential restitution: an impact of a ball has the two branches of Walton", S,
                   Space<2>, Space<3>) {
  const double radius = 0.01, speed = 0.7;
  const Grain<S> grain = ball<S>(radius);
  // Of a tangential impulse on the point: 1/m + R^2 / I, in units of 1/m.
  const double mobility = S::dim == 3 ? 3.5 : 3;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  int sticking = 0, sliding = 0;
  for (const double e : {0.0, 0.5, 0.97})
    for (const double mu : {0.092, 0.25, 1.0})
      for (const double beta : {0.0, 0.44, 1.0})
        for (int k = 0; k < 20; ++k) {
          OnFloor<S, Law> world(grain, Law(mu, e, beta), S::identity(), -1e-12);
          for (int d = 0; d < S::dofs; ++d)
            world.velocity()[d] = normal(random) * (d < S::dim ? 1 : 50);
          world.velocity()[world.up] = -speed;
          const typename S::Vector before = velocity_below<S>(world, radius);
          world.step(1e-12);
          const typename S::Vector after = velocity_below<S>(world, radius);
          CHECK(after[world.up] == doctest::Approx(e * speed).epsilon(1e-9));
          typename S::Vector slip = before;
          slip[world.up] = 0;
          const double size = slip.norm(), most = mobility * mu * (1 + e) * speed;
          const bool sticks = (1 + beta) * size <= most;
          typename S::Vector expected = sticks ? typename S::Vector(-beta * slip)
                                               : typename S::Vector(slip * (1 - most / size));
          expected[world.up] = e * speed;
          CAPTURE(e);
          CAPTURE(mu);
          CAPTURE(beta);
          CHECK((after - expected).norm() <= 1e-9 * (size + speed));
          ++(sticks ? sticking : sliding);
        }
  CHECK(sticking > 100);
  CHECK(sliding > 100);
}

TEST_CASE_TEMPLATE("tangential restitution: no impact makes energy", S, Space<2>, Space<3>) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<Grain<S>> grains = flat_grains(S());
  grains.push_back(ball<S>(0.01));
  double least = 0, most = 0;
  for (const Grain<S>& grain : grains)
    for (const double tilt : {0.0, 1e-4, 0.3, 1.0})
      for (const double e : {0.0, 0.5, 1.0})
        for (const double beta : {0.0, 0.5, 1.0})
          for (const double friction : {0.0, 0.3, 3.0}) {
            typename S::Angular turn;
            for (auto& x : turn) x = tilt * normal(random);
            if (grain.vertices.size() == 1) turn.setZero();
            OnFloor<S, Law> world(grain, Law(friction, e, beta), S::exp(turn), -1e-6);
            for (int k = 0; k < S::dofs; ++k)
              world.velocity()[k] = normal(random) * (k < S::dim ? 1 : 50);
            world.velocity()[world.up] = -1;
            const double first = world.kinetic_energy();
            // Short steps: that the inertia turns during a step changes the energy by (h w)^2.
            double gain = 0, before = first;
            for (int k = 0; k < 20; ++k) {
              world.step(1e-7);
              gain = std::max(gain, (world.kinetic_energy() - before) / first);
              before = world.kinetic_energy();
            }
            CAPTURE(grain.name);
            CAPTURE(tilt);
            CAPTURE(e);
            CAPTURE(beta);
            CAPTURE(friction);
            CHECK(gain <= 1e-9);
            least = std::min(least, before / first - 1);
            most = std::max(most, before / first - 1);
          }
  CHECK(least < -0.1);  // some lose energy
  CHECK(most > -1e-9);  // e = beta0 = 1 can lose none
}

TEST_CASE_TEMPLATE("tangential restitution 0 is Coulomb's law, bit by bit", S, Space<2>, Space<3>) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const Grain<S>& grain : flat_grains(S())) {
    typename S::Angular turn;
    for (auto& x : turn) x = 0.3 * normal(random);
    OnFloor<S, Law> one(grain, Law(0.4, 0.6, 0), S::exp(turn), 1e-4);
    OnFloor<S, Coulomb> other(grain, Coulomb(0.4, 0.6), S::exp(turn), 1e-4);
    for (int k = 0; k < S::dofs; ++k)
      one.velocity()[k] = other.velocity()[k] = normal(random) * (k < S::dim ? 1 : 50);
    one.gravity[one.up] = other.gravity[other.up] = -9.81;
    for (int k = 0; k < 300; ++k) one.step(1e-4), other.step(1e-4);
    CAPTURE(grain.name);
    CHECK(one.bodies.velocity[1] == other.bodies.velocity[1]);
    CHECK(one.bodies.pose[1].position == other.bodies.pose[1].position);
  }
}

TEST_CASE_TEMPLATE("tangential restitution: a grain that slides stops where Coulomb's law stops it",
                   S, Space<2>, Space<3>) {
  const double mu = 0.5, speed = 0.3, h = 1e-4;
  const Grain<S> grain = flat_grains(S()).front();
  for (const double e : {0.0, 0.5}) {
    OnFloor<S, Law> world(grain, Law(mu, e, 0.9), S::identity(), 0);
    world.gravity[world.up] = -9.81;
    world.velocity()[0] = speed;
    while (world.time < 2 * speed / (mu * 9.81)) world.step(h);
    const double path = speed * speed / (2 * mu * 9.81);
    CAPTURE(e);
    CHECK(world.bodies.pose[1].position[0] == doctest::Approx(path).epsilon(0.01));
    CHECK(std::abs(world.velocity()[0]) <= 1e-9);
  }
}
