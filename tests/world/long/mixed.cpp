// SPDX-License-Identifier: MIT
// Assemblies with several types of shapes.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
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
using Grain = OneOf<BallIn<S>, CapsuleIn<S>, Rounded<Rock>, Rock>;
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
    for (const double half_length : {0.1, 0.3, 0.0}) {  // narrower and wider than the plank; balls
      const bool has_capsules = half_length > 0;
      CAPTURE(c.spin);
      CAPTURE(c.h);
      CAPTURE(half_length);
      World world(0.1, Materials<Law>(1, Law(0.3)));
      world.set_gravity({0, 0, -9.81});
      const ShapeId roller = has_capsules ? world.add_shape(CapsuleIn<S>(half_length, 0.1))
                                          : world.add_shape(BallIn<S>(0.1));
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

TEST_CASE("a grain slides along a bar that spins about its axis, and stays at its height") {
  const S::Rotation across = S::exp({0, 0, 1.5707963267948966});
  for (const double spin : {0.0, 1e-9, 3.0, -100.0})
    for (const double v : {1.0, 3.0})
      for (const bool is_ball : {true, false}) {
        CAPTURE(spin);
        CAPTURE(v);
        CAPTURE(is_ball);
        Simulation<Grain, Law> world(0.04, Materials<Law>(1, Law(0)));
        world.set_gravity({0, 0, -9.81});
        const BodyId bar = world.add_grain(world.add_shape(CapsuleIn<S>(1, 0.02)), {}, 1000);
        world.prescribe_motion(bar);
        world.set_spin(bar, {spin, 0, 0});
        const ShapeId shape =
            is_ball ? world.add_shape(BallIn<S>(0.02)) : world.add_shape(CapsuleIn<S>(0.03, 0.02));
        const BodyId grain = world.add_grain(shape, {{-0.5, 0, 0.04}, across}, 1000);
        world.set_velocity(grain, {v, 0, 0});
        for (int k = 0; k < 200; ++k) world.step(1e-3);
        CHECK(std::abs(world.pose(grain).position[2] - 0.04) < 1e-9);
        CHECK(std::abs(world.velocity(grain)[0] - v) < 1e-9);
      }
}

/// An arm along the first axis whose surface is 0.02 from it towards y: a capsule, or a box whose edge is there, rounded or not.
Grain arm_of(int kind) {
  constexpr double radius = 0.02, rounding = 0.006;
  if (kind == 0) return CapsuleIn<S>(1, radius);
  const double half = (kind == 1 ? radius - rounding : radius) / std::numbers::sqrt2;
  const Rock box = cuboid<Rock>({1, half, half});
  return kind == 1 ? Grain(Rounded(box, rounding)) : Grain(box);
}
/// Turns the edge of an arm_of() a box towards y.
S::Rotation edge_to_y(int kind) {
  return kind == 0 ? S::identity() : S::exp({std::numbers::pi / 4, 0, 0});
}

// In the frame of the arm x'' = Omega^2 x along it, and the arm pushes with m (2 Omega x' - Omega^2 y).
TEST_CASE("an arm that turns pushes a ball outwards, to second order") {
  const auto error_of_place = [](int kind, double omega, double h) {
    Simulation<Grain, Law> world(0.04, Materials<Law>(1, Law(0)));
    const BodyId arm =
        world.add_grain(world.add_shape(arm_of(kind)), {Vector::Zero(), edge_to_y(kind)}, 1000);
    world.prescribe_motion(arm);
    world.set_spin(arm, {0, 0, omega});
    const BodyId ball = world.add_grain(world.add_shape(BallIn<S>(0.02)), {{0.1, 0.04, 0}}, 1000);
    world.set_velocity(ball, {-0.04 * omega + 0.05 * omega, 0.1 * omega, 0});
    const double m = world.shape(ball).mass_properties(1000).mass;
    const int steps = int(2 / omega / h);
    double force = 0, right = 0;
    for (int k = 0; k < steps; ++k) {
      world.step(h);
      if (k < steps / 2) continue;
      const double t = (k + 0.5) * h;
      force += world.contact_impulse(ball).norm() / h;
      right += m * omega * omega * (0.2 * std::sinh(omega * t) + 0.1 * std::cosh(omega * t) - 0.04);
    }
    CHECK(std::abs(force / right - 1) < 2e-3);
    const Vector place = edge_to_y(kind) * Vector(world.pose(arm).rotation.inverse() *
                                                  Vector(world.pose(ball).position));
    const double t = omega * h * steps;
    return std::abs(place[0] - 0.1 * std::cosh(t) - 0.05 * std::sinh(t)) +
           std::abs(place[1] - 0.04);
  };
  for (const int kind : {0, 1, 2})
    for (const double omega : {5.0, 20.0}) {
      CAPTURE(kind);
      CAPTURE(omega);
      const double coarse = error_of_place(kind, omega, 0.02 / omega),
                   fine = error_of_place(kind, omega, 0.005 / omega);
      CHECK(coarse < 4e-4);
      CHECK(fine < coarse / 8);
    }
}

// A rod across the arm's edge keeps its direction, and turns in the frame of the arm: the normal turns with both.
TEST_CASE("a rod that lies across a turning arm is not lifted") {
  for (const int kind : {0, 1, 2})
    for (const double omega : {0.5, -2.0}) {
      CAPTURE(kind);
      CAPTURE(omega);
      Simulation<Grain, Law> world(0.04, Materials<Law>(1, Law(0)));
      world.set_gravity({0, -9.81, 0});
      const BodyId arm =
          world.add_grain(world.add_shape(arm_of(kind)), {Vector::Zero(), edge_to_y(kind)}, 1000);
      world.prescribe_motion(arm);
      world.set_spin(arm, {0, omega, 0});
      // Two arms side by side would hold the rod; here its centre lies on the axis.
      const BodyId rod =
          world.add_grain(world.add_shape(CapsuleIn<S>(0.2, 0.02)),
                          {{0, 0.04, 0}, S::exp({0, std::numbers::pi / 2, 0})}, 1000);
      for (int k = 0; k < 200; ++k) world.step(1e-3);
      CHECK(std::abs(world.pose(rod).position[1] - 0.04) < 1e-9);
    }
}

TEST_CASE("a plank that slides on a turning beam across its edges stays at its height") {
  for (const bool is_round : {true, false})
    for (const double omega : {3.0, -10.0}) {
      CAPTURE(is_round);
      CAPTURE(omega);
      Simulation<Grain, Law> world(0.04, Materials<Law>(1, Law(0)));
      world.set_gravity({0, 0, -9.81});
      const auto board = [&](double x, double y) {
        const double r = is_round ? 0.005 : 0;
        const Rock box = cuboid<Rock>({x - r, y - r, 0.02 - r});
        return world.add_shape(is_round ? Grain(Rounded(box, r)) : Grain(box));
      };
      const BodyId beam = world.add_grain(board(0.5, 0.05), {}, 1000);
      world.prescribe_motion(beam);
      world.set_spin(beam, {0, 0, omega});
      const BodyId plank = world.add_grain(
          board(0.3, 0.04), {{0, 0, 0.04}, S::exp({0, 0, std::numbers::pi / 2})}, 1000);
      double least = 1, most = 0;
      for (int k = 0; k < 150; ++k) {
        world.step(1e-3);
        least = std::min(least, world.pose(plank).position[2]);
        most = std::max(most, world.pose(plank).position[2]);
      }
      CHECK(least > 0.04 - 1e-9);
      CHECK(most < 0.04 + 1e-9);
    }
}

}  // namespace
