// SPDX-License-Identifier: MIT
// Balls that resist rolling and twisting, with answers in closed form.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

#include "moreau/law/rolling_resistance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

namespace {

using Law = RollingResistance<>;
using S = Space<3>;
using Vector = S::Vector;

constexpr double radius = 0.01, g = 9.81, h = 2e-4;

Simulation<Ball<>, Law> on_floor(const Law& law) {
  Simulation<Ball<>, Law> world(2 * radius, Materials<Law>(1, law));
  world.add_wall(Vector::UnitZ(), Vector::Zero());
  world.set_gravity(-g * Vector::UnitZ());
  return world;
}

/// Whether one ball stands on two others, which touch and lie on a floor, for half a second.
bool stands(double friction, double rolling) {
  auto world = on_floor(Law(friction, rolling));
  const ShapeId ball = world.add_shape(Ball<>(radius));
  for (const double x : {-radius, radius})
    world.add_grain(ball, Pose<S>(Vector(x, 0, radius)), 2500);
  const double height = radius * (1 + std::sqrt(3.0));
  const BodyId top = world.add_grain(ball, Pose<S>(Vector(0, 0, height)), 2500);
  for (int step = 0; step < 2500; ++step) world.step(h);
  return world.pose(top).position.z() > height - 0.01 * radius;
}

}  // namespace

TEST_CASE("a ball on two others stands by the couples, which friction alone does not hold") {
  // The ball on top presses with N on each of the others, at 30 degrees. They slip beneath it, T = mu N, and
  // stick on the floor, whose normal force is 3/2 of the weight W. Per N,
  //
  //     floor      T' = sin 30 - mu cos 30,        W = 2 (cos 30 + mu sin 30)
  //     couples    T' - mu <= eta (1/2 + 3/2 W),   R of the two contacts: radius / 2 and radius.
  //
  // Without couples it takes mu >= tan 15 = 0.268.
  const double friction = 0.2, cosine = std::sqrt(0.75);
  const double couple = 0.5 - friction * (1 + cosine), weight = 2 * cosine + friction;
  const double least = couple / (0.5 + 1.5 * weight);
  CHECK(stands(friction, 1.03 * least));
  CHECK_FALSE(stands(friction, 0.97 * least));
  CHECK(stands(0.28, 0));
  CHECK_FALSE(stands(0.25, 0));
}

TEST_CASE("a spin about the normal falls by eta R N / I") {
  const double eta = 0.1;
  for (const double load : {0.0, 3.0}) {  // beside the weight, in units of it
    auto world = on_floor(Law(0.5, eta));
    const BodyId ball =
        world.add_grain(world.add_shape(Ball<>(radius)), Pose<S>(Vector(0, 0, radius)), 2500);
    const double mass = world.bodies().grain_mass[ball.index()];
    world.set_force(ball, Vector(-load * mass * g * Vector::UnitZ()));
    const double fall = 2.5 * eta * (1 + load) * g / radius;
    world.set_spin(ball, Vector(50 * Vector::UnitZ()));
    int steps = 0;
    for (; steps < 2000 && world.spin(ball).norm() > 1e-9; ++steps) {
      const double expected = std::max(0.0, 50 - fall * h * (steps + 1));
      CHECK(world.step(h).solve.converged);
      CHECK(world.spin(ball).z() == doctest::Approx(expected).epsilon(1e-6));
      CHECK(world.velocity(ball).norm() < 1e-9);
    }
    CHECK(steps == int(std::ceil(50 / (fall * h))));
  }
}

TEST_CASE(
    "a ball on a slope rolls from tan(tilt) = eta, with the acceleration g (sin - eta cos) / (1 + "
    "2/5)") {
  const double eta = 0.1;
  for (const double slope : {0.999 * eta, 1.001 * eta, 0.3}) {
    const double tilt = std::atan(slope), pull = g * (std::sin(tilt) - eta * std::cos(tilt)) / 1.4;
    auto world = on_floor(Law(0.5, eta));
    world.set_gravity(g * Vector(std::sin(tilt), 0, -std::cos(tilt)));
    const BodyId ball =
        world.add_grain(world.add_shape(Ball<>(radius)), Pose<S>(Vector(0, 0, radius)), 2500);
    for (int step = 1; step <= 500; ++step) {
      CHECK(world.step(h).solve.converged);
      const double speed = std::max(0.0, pull * h * step);
      CHECK(std::abs(world.velocity(ball).x() - speed) < 1e-9);
      CHECK(std::abs(world.spin(ball).y() - speed / radius) < 1e-7);
    }
  }
}
