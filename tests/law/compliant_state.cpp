// SPDX-License-Identifier: MIT
// What springs remember of the step before: snapshots, new grains and new materials do not change it.
#include <doctest/doctest.h>

#include "moreau/io/snapshot.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

using Sticky = Compliant<Cohesive<SignoriniCoulomb<double>>>;
constexpr double radius = 0.01, h = 2e-5, stiffness = 1e4;

Materials<Sticky> materials(double pull) {
  using Coulomb = SignoriniCoulomb<double>;
  return Materials<Sticky>(
      1, Sticky(Cohesive<Coulomb>(Coulomb(0.3, 0.5), pull), stiffness, stiffness / 2));
}

/// Two grains that attract each other, on springs.
template <class S>
struct Pair {
  using Vector = typename S::Vector;
  Simulation<BallIn<S>, Sticky> world{2 * radius, materials(1)};
  ShapeId shape = world.add_shape(BallIn<S>(radius));
  BodyId a = world.add_grain(shape, {}, 2500);
  BodyId b =
      world.add_grain(shape, Pose<S>(Vector((2 * radius - 1 / stiffness) * Vector::UnitX())), 2500);
};

}  // namespace

TEST_CASE_TEMPLATE("compliant: a restart and a new grain keep what springs remember", S,
                   MOREAU_TYPES((Space<2>), (Space<3>))) {
  using Vector = typename S::Vector;
  Pair<S> pair;
  auto& world = pair.world;
  for (int k = 0; k < 50; ++k) world.step(h);
  world.set_velocity(pair.b, Vector(0.03 * Vector::Ones()));
  auto copy = world, more = world;
  restore_snapshot(snapshot(world), copy);
  more.add_grain(pair.shape, Pose<S>(Vector(Vector::Ones())), 2500);
  for (int k = 0; k < 3; ++k) {
    // Steps of another length, in which the springs follow the motion that they have missed.
    const double step = k % 2 == 0 ? h / 3 : h;
    world.step(step), copy.step(step), more.step(step);
    CHECK(copy.pose(pair.b).position == world.pose(pair.b).position);
    CHECK((more.velocity(pair.b) - world.velocity(pair.b)).norm() < 1e-15);
  }
  CHECK(snapshot(copy) == snapshot(world));
}

TEST_CASE_TEMPLATE("compliant: another attraction does not compress the springs at once", S,
                   MOREAU_TYPES((Space<2>), (Space<3>))) {
  Pair<S> pair;
  auto& world = pair.world;
  double energy = 0;
  for (int k = 0; k < 8000; ++k) energy = world.step(h).elastic_energy;
  CHECK(energy == doctest::Approx(1 / (2 * stiffness)).epsilon(0.05));
  world.set_materials(materials(1.2));
  world.set_materials(materials(3));
  auto copy = world;
  restore_snapshot(snapshot(world), copy);
  for (auto* one : {&world, &copy}) {
    CHECK(one->step(h).elastic_energy == doctest::Approx(energy).epsilon(0.05));
    double later = 0;
    for (int k = 0; k < 8000; ++k) later = one->step(h).elastic_energy;
    CHECK(later == doctest::Approx(9 / (2 * stiffness)).epsilon(0.05));
  }
}
