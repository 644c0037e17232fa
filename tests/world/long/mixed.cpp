// SPDX-License-Identifier: MIT
// Assemblies with several types of shapes.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "detect/shapes.hpp"
#include "sanitized.hpp"

namespace {

using namespace moreau;

using S = Space<3>;
using Vector = S::Vector;
using Rock = Polyhedron<double>;
using Grain = OneOf<BallIn<S>, CapsuleIn<S>, Rounded<Rock>>;
using Law = SignoriniCoulomb<double>;
using World = Simulation<Grain, Law>;

/// Grains of about 2 cm above the floor of a box. The types of shapes alternate.
World box_of_grains(int count) {
  std::mt19937_64 random(41);
  World world(0.02, Materials<Law>(1, Law(0.4)));
  for (int k = 0; k < count; ++k) {
    const Rock rock = samples::grain(S{}, random).scaled(0.01);
    const Grain kinds[] = {BallIn<S>(0.01), CapsuleIn<S>(0.006, 0.006),
                           Rounded(rock.scaled(0.7), 0.004)};
    const Vector center(0.015 + 0.025 * (k % 2), 0.015 + 0.025 * (k / 2 % 2),
                        0.015 + 0.03 * (k / 4));
    world.add_grain(world.add_shape(kinds[k % 3]), {center, samples::rotation(S{}, random)}, 2700);
  }
  for (int axis = 0; axis < 3; ++axis) world.add_wall(Vector::Unit(axis), Vector::Zero());
  for (int axis = 0; axis < 2; ++axis)
    world.add_wall(-Vector::Unit(axis), 0.055 * Vector::Unit(axis));
  world.set_gravity({0, 0, -9.81});
  return world;
}

Vector momentum(const World& world) {
  Vector sum = Vector::Zero();
  for (std::size_t k = 0; k < world.grain_count(); ++k) {
    const std::size_t i = world.grain(k).index();
    sum += world.bodies().grain_mass[i] * world.bodies().velocity[i].head<3>();
  }
  return sum;
}

TEST_CASE("balls, rods and rounded rocks come to rest, momentum balanced at every step") {
  World world = box_of_grains(24);
  const double h = 5e-4;
  Vector weight = Vector::Zero();
  for (std::size_t k = 0; k < world.grain_count(); ++k)
    weight += world.bodies().grain_mass[world.grain(k).index()] * world.gravity();
  double worst = 0, overlap = 0;
  for (int k = 0; k < rounds(1600); ++k) {
    const Vector before = momentum(world);
    const StepReport report = world.step(h);
    CHECK(report.solve.converged);
    overlap = std::max(overlap, report.max_overlap);
    Vector walls = Vector::Zero();
    for (const BodyId wall : world.walls()) walls += world.contact_impulse(wall);
    worst = std::max(worst, (momentum(world) - before - h * weight + walls).norm());
  }
  CHECK(worst < 1e-10 * h * weight.norm());
  CHECK(overlap < 1e-2 * 0.02);
  for (const BodyId grain : world.grains()) CHECK(world.pose(grain).position.minCoeff() > 0.003);
  if (sanitizer_share == 1) CHECK(momentum(world).norm() < 0.01 * 24 * 0.011);
}

TEST_CASE("a rod that is given a kick rolls on as far as its spin says") {
  using Rod = CapsuleIn<S>;
  Simulation<Grain, Law> world(0.02, Materials<Law>(1, Law(0.5)));
  const BodyId rod =
      world.add_grain(world.add_shape(Rod(0.02, 0.01)), {Vector(0, 0, 0.01), S::identity()}, 1000);
  world.add_wall(Vector::UnitZ(), Vector::Zero());
  world.set_gravity({0, 0, -9.81});
  world.set_velocity(rod, {0, 0.1, 0});
  world.set_spin(rod, {-10, 0, 0});
  for (int k = 0; k < 500; ++k) world.step(1e-3);
  const Pose<S>& pose = world.pose(rod);
  CHECK(pose.position.y() == doctest::Approx(0.05).epsilon(1e-6));
  CHECK(std::abs(pose.position.z() - 0.01) < 1e-5);
  CHECK(std::abs(pose.position.x()) < 1e-9);
}

TEST_CASE("a plank of two rods does not tip, a ball on a rounded box stays") {
  Simulation<Grain, Law> world(0.02, Materials<Law>(1, Law(0.5)));
  const ShapeId rod = world.add_shape(CapsuleIn<S>(0.03, 0.01));
  const ShapeId board = world.add_shape(Rounded(samples::box(0.06, 0.06, 0.01), 0.002));
  for (const double y : {-0.02, 0.02})
    world.add_grain(rod, {Vector(0, y, 0.01), S::identity()}, 1000);
  const BodyId top = world.add_grain(board, {Vector(0, 0, 0.027), S::identity()}, 1000);
  world.add_wall(Vector::UnitZ(), Vector::Zero());
  world.set_gravity({0, 0, -9.81});
  for (int k = 0; k < 300; ++k) CHECK(world.step(1e-3).solve.converged);
  CHECK((world.pose(top).position - Vector(0, 0, 0.027)).norm() < 1e-5);
  CHECK(world.bodies().velocity[top.index()].norm() < 1e-6);
}

TEST_CASE("a plank on rollers takes their speed and does not sink") {
  struct Case {
    double spin, h, bound;
  };
  for (const Case& c : {Case{10, 5e-3, 1e-6}, Case{10, 1e-3, 1e-7}, Case{50, 1e-3, 1e-5}})
    for (const bool has_capsules : {true, false}) {
      CAPTURE(c.spin);
      CAPTURE(c.h);
      CAPTURE(has_capsules);
      World world(0.1, Materials<Law>(1, Law(0.3)));
      world.set_gravity({0, 0, -9.81});
      const ShapeId roller =
          has_capsules ? world.add_shape(CapsuleIn<S>(0.1, 0.1)) : world.add_shape(BallIn<S>(0.1));
      const S::Rotation across = S::exp({0, 0, 1.5707963267948966});
      for (int k = 0; k < 12; ++k)
        for (const double y : {-0.1, 0.1}) {
          if (has_capsules && y > 0) continue;
          const BodyId body =
              world.add_grain(roller, {{0.3 * k, has_capsules ? 0 : y, 0}, across}, 1000);
          world.prescribe_motion(body);
          world.set_spin(body, {0, c.spin, 0});
        }
      const Rounded plank(cuboid<Rock>({0.49, 0.14, 0.04}), 0.01);
      const BodyId body =
          world.add_grain(world.add_shape(plank), {{0.75, 0, 0.15}, S::identity()}, 1000);
      for (int k = 0; k < int(0.6 / c.h); ++k) world.step(c.h);
      const double speed = std::min(0.1 * c.spin, 0.3 * 9.81 * 0.6);
      CHECK(std::abs(world.pose(body).position[2] - 0.15) < c.bound);
      CHECK(std::abs(world.velocity(body)[0] - speed) < 1e-3 * speed);
    }
}

}  // namespace
