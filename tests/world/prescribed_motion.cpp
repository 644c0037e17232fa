// SPDX-License-Identifier: MIT
// Grains whose motion is prescribed: obstacles, rough floors, intruders.
#include <doctest/doctest.h>
#include <vector>

#include "moreau/law/rolling_resistance.hpp"
#include "moreau/measure/energy_balance.hpp"

#include "sanitized.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"
#include "world/spring_world.hpp"

using namespace moreau;
using scenes::BoxOfGrains;
using scenes::World;

namespace {

constexpr double h = 5e-4;

/// Two grains of 2 cm side by side: one of prescribed motion, which a lid with a mass of 1 kg rests
/// on, and a free one, lower by 1 mm.
template <class Law, class ShapeT>
struct Lid {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  Simulation<ShapeT, Law> world;
  BodyId held, lid;

  explicit Lid(const Law& law) : world(0.02, Materials<Law>(1, law)) {
    const ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));
    held = world.add_grain(shape, {0.011 * up, S::identity()}, 2700);
    world.prescribe_motion(held);
    world.add_grain(shape, {0.01 * up + 0.03 * Vector::UnitX(), S::identity()}, 2700);
    world.add_wall(up, Vector::Zero());
    lid = world.add_wall(-up, 0.022 * up);
    world.set_wall_mass(lid, 1);
    world.set_force(lid, -10 * up);
    world.set_gravity(-9.81 * up);
  }
  void check() {
    for (int k = 0; k < 200; ++k) world.step(h);
    CHECK(world.pose(lid).position[S::dim - 1] == doctest::Approx(0.021).epsilon(1e-3));
    CHECK(world.velocity(lid).norm() < 1e-9);
    const Vector push = world.contact_impulse(held) / h;
    CHECK((push + 10 * up).norm() < 1e-6);
    CHECK(world.pose(held).position == Vector(0.011 * up));
  }
};

}  // namespace

TEST_CASE_TEMPLATE("an intruder moves at its velocity, and gives the momentum that it receives",
                   ShapeT, MOREAU_TYPES((Polyhedron<>, Disk<>), (Polygon<>, Ball<>))) {
  using Scene = BoxOfGrains<ShapeT>;
  using S = typename Scene::S;
  using Vector = typename Scene::Vector;
  Scene scene(24);
  auto& world = scene.simulation;
  for (int k = 0; k < rounds(400); ++k) world.step(h);
  const BodyId intruder = scene.grains[4];
  world.prescribe_motion(intruder);
  world.prescribe_motion(intruder);
  CHECK(world.is_prescribed(intruder));
  CHECK_FALSE(world.is_prescribed(scene.grains[5]));
  CHECK(world.is_prescribed(scene.walls[0]));
  const Vector velocity = 0.1 * Vector::Unit(S::dim - 1);  // up: a path that no wall ends
  const typename S::Angular spin = S::Angular::Constant(3);
  world.set_velocity(intruder, velocity);
  world.set_spin(intruder, spin);
  EnergyBalance<S> energy(world);

  const auto momentum = [&] {
    Vector sum = Vector::Zero();
    for (const BodyId grain : scene.grains)
      if (grain != intruder)
        sum += world.bodies().grain_mass[grain.index()] * world.velocity(grain);
    return sum;
  };
  Vector weight = Vector::Zero();
  for (const BodyId grain : scene.grains)
    if (grain != intruder) weight += world.bodies().grain_mass[grain.index()] * world.gravity();
  const Vector start = world.pose(intruder).position;
  double worst = 0, pushes = 0;
  const int steps = rounds(200);
  for (int k = 0; k < steps; ++k) {
    const Vector before = momentum();
    energy.add(world, world.step(h), h);
    Vector received = world.contact_impulse(intruder);
    pushes += received.norm();
    for (const BodyId wall : scene.walls) received += world.contact_impulse(wall);
    worst = std::max(worst, (momentum() - before - h * weight + received).norm());
    REQUIRE(world.velocity(intruder) == velocity);
    REQUIRE(world.spin(intruder) == spin);
  }
  CHECK(worst < 1e-10 * h * weight.norm());
  CHECK(pushes > 0);
  const Vector way = steps * h * velocity;
  CHECK((world.pose(intruder).position - start - way).norm() < 1e-12);
  CHECK(energy.terms().drives != 0);

  world.release(intruder);
  CHECK_FALSE(world.is_prescribed(intruder));
  world.step(h);
  CHECK(world.velocity(intruder) != velocity);
}

TEST_CASE_TEMPLATE("the energy balance closes while an intruder moves", ShapeT, Polygon<>, Disk<>) {
  BoxOfGrains<ShapeT> scene(16);
  auto& world = scene.simulation;
  for (int k = 0; k < 200; ++k) world.step(h);
  EnergyBalance<typename BoxOfGrains<ShapeT>::S> energy(world);
  world.prescribe_motion(scene.grains[2]);
  world.set_velocity(scene.grains[2], {0.1, 0.05});
  energy.rebase(world);
  for (int k = 0; k < 200; ++k) energy.add(world, world.step(h), h);
  CHECK(energy.terms().drives > 0);
  CHECK(std::abs(energy.imbalance()) < 1e-10 * energy.terms().drives);

  world.remove_grain(scene.grains[3]);
  const StepReport report = world.step(h);
  CHECK_THROWS_WITH_AS(energy.add(world, report, h),
                       doctest::Contains("EnergyBalance::add: simulation = "),
                       std::invalid_argument);
  energy.rebase(world);
  const double before = energy.imbalance();
  for (int k = 0; k < 50; ++k) energy.add(world, world.step(h), h);
  CHECK(std::abs(energy.imbalance() - before) < 1e-10 * energy.terms().drives);

  // A wall that moves has a kinetic energy as soon as it has a mass.
  const BodyId wall = scene.walls[0];
  world.set_velocity(wall, -0.05 * world.bodies().axes(wall.index()).col(0).eval());
  world.set_wall_mass(wall, 1);
  energy.rebase(world);
  for (int k = 0; k < 50; ++k) energy.add(world, world.step(h), h);
  CHECK(std::abs(energy.imbalance() - before) < 1e-10 * energy.terms().drives);

  // A forgotten rebase() is refused where it would matter: of bodies that move.
  const auto add = [&] { energy.add(world, world.step(h), h); };
  const auto is_refused = doctest::Contains("EnergyBalance::add: body = ");
  world.set_wall_mass(wall, 2);
  CHECK_THROWS_WITH_AS(add(), is_refused, std::invalid_argument);
  energy.rebase(world);
  world.release(scene.grains[2]);
  CHECK_THROWS_WITH_AS(add(), is_refused, std::invalid_argument);
  energy.rebase(world);
  world.prescribe_motion(scene.grains[4]);
  CHECK_THROWS_WITH_AS(add(), is_refused, std::invalid_argument);
  energy.rebase(world);
  world.set_wall_mass(scene.walls[1], 3);
  CHECK_NOTHROW(add());
}

TEST_CASE_TEMPLATE("release() is the inverse of prescribe_motion()", ShapeT, Polygon<>,
                   Polyhedron<>) {
  BoxOfGrains<ShapeT> one(9), two(9);
  for (int k = 0; k < 5; ++k) {
    two.simulation.prescribe_motion(two.grains[3]);
    two.simulation.release(two.grains[3]);
    two.simulation.release(two.grains[4]);
    CHECK(scenes::have_same_bits_after(20, one.simulation, two.simulation));
  }
  CHECK_THROWS_WITH_AS(one.simulation.prescribe_motion(one.walls[0]),
                       doctest::Contains("must be the id of a grain"), std::invalid_argument);
  CHECK_THROWS_AS(one.simulation.release(one.walls[0]), std::invalid_argument);
  CHECK_THROWS_AS(one.simulation.is_prescribed(BodyId(99)), std::invalid_argument);
}

TEST_CASE_TEMPLATE("release() of a free grain does not place it", ShapeT, Disk<>, Polyhedron<>) {
  using S = SpaceOf<ShapeT>;
  using Law = SignoriniCoulomb<double>;
  World<ShapeT> world(0.02, Materials<Law>(1, Law(0.3)));
  const ShapeId shape = world.add_shape(regular_shape<ShapeT>(0.02));
  const BodyId grain = world.add_grain(shape, Pose<S>(S::Vector::Zero()), 1000);
  world.add_grain(shape, Pose<S>(typename S::Vector(0.002 * S::Vector::UnitX())), 1000);
  world.allow_overlaps();
  world.step(h);
  world.allow_overlaps(false);
  world.release(grain);
  CHECK_NOTHROW(world.step(h));
  world.prescribe_motion(grain);
  world.release(grain);
  CHECK_THROWS_AS(world.step(h), std::invalid_argument);
}

TEST_CASE("bodies of prescribed motion have no contacts with each other") {
  using S = Space<2>;
  using Law = SignoriniCoulomb<double>;
  World<Disk<>> world(0.02, Materials<Law>(1, Law(0.3)));
  const ShapeId shape = world.add_shape(Disk<>(0.01));
  std::vector<BodyId> floor;
  for (int k = 0; k < 10; ++k) {
    floor.push_back(world.add_grain(shape, {S::Vector(0.015 * k, 0), S::identity()}, 1000));
    world.prescribe_motion(floor.back());
  }
  world.add_wall(S::Vector::UnitY(), S::Vector::Zero());
  world.add_cylinder(S::Vector::Zero(), S::Angular::Constant(1), 0.1);
  world.set_gravity(S::Vector(0, -9.81));
  CHECK(world.step(h).points == 0);
  CHECK(world.step(h).pairs == 0);
  // Each free grain comes to rest between two grains of the floor.
  for (int k = 0; k < 3; ++k)
    world.add_grain(shape, {S::Vector(0.0075 + 0.03 * k, 0.025), S::identity()}, 1000);
  StepReport report;
  for (int k = 0; k < 400; ++k) report = world.step(h);
  CHECK(report.points >= 6);
  for (const BodyId grain : world.grains()) CHECK(world.velocity(grain).norm() < 1e-6);
  for (const BodyId grain : floor) CHECK(world.pose(grain).position[1] == 0);
}

TEST_CASE("a wall with a mass rests on a grain of prescribed motion") {
  using Law = SignoriniCoulomb<double>;
  Lid<Law, Disk<>>(Law(0.4)).check();
  Lid<Law, Ball<>>(Law(0.4)).check();
  Lid<Law, Polyhedron<>>(Law(0.4)).check();
#ifdef MOREAU_TEST_FURTHER_TYPES
  using Rolling = RollingResistance<double>;
  Lid<Rolling, Ball<>>(Rolling(0.4, 0.1)).check();
#endif
}

#ifdef MOREAU_TEST_FURTHER_TYPES
TEST_CASE("a regularized law pushes grains away from an intruder, and not the intruder") {
  using S = Space<3>;
  auto world = scenes::spring_world<Ball<>>();
  const ShapeId shape = world.add_shape(Ball<>(0.01));
  const BodyId intruder = world.add_grain(shape, {S::Vector::Zero(), S::identity()}, 1000);
  const BodyId other = world.add_grain(shape, {S::Vector(0.021, 0, 0), S::identity()}, 1000);
  const BodyId fixed = world.add_grain(shape, {S::Vector(0, 0.015, 0), S::identity()}, 1000);
  world.prescribe_motion(intruder);
  world.prescribe_motion(fixed);
  world.set_velocity(intruder, {0.5, 0, 0});
  world.set_force(intruder, {100, 0, 0});
  for (int k = 0; k < 500; ++k) world.step(2e-5);
  CHECK(world.velocity(intruder) == S::Vector(0.5, 0, 0));
  CHECK(world.velocity(fixed) == S::Vector::Zero());
  CHECK(world.velocity(other)[0] > 0.5);
}

TEST_CASE_TEMPLATE("calls without an effect change no bit of a step with springs", ShapeT, Disk<>,
                   Ball<>) {
  using S = SpaceOf<ShapeT>;
  auto one = scenes::spring_world<ShapeT>();
  const ShapeId shape = one.add_shape(ShapeT(0.01));
  const BodyId obstacle = one.add_grain(shape, Pose<S>(S::Vector::Zero()), 1000);
  const BodyId grain =
      one.add_grain(shape, Pose<S>(typename S::Vector(0.019 * S::Vector::UnitX())), 1000);
  one.prescribe_motion(obstacle);
  one.set_spin(grain, S::Angular::Constant(10));
  auto two = one;
  for (int k = 0; k < 50; ++k) {
    one.step(2e-5);
    two.prescribe_motion(obstacle);
    two.release(grain);
    two.step(2e-5);
    REQUIRE(one.bodies().velocity[grain.index()] == two.bodies().velocity[grain.index()]);
  }
  CHECK(one.velocity(grain).norm() > 0);
}
#endif
