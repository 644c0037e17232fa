// SPDX-License-Identifier: MIT
// Boundaries under regularized contact laws, which give forces.
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>

#include "moreau/boundary/servo.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

namespace {

using moreau::BallIn;
using moreau::BodyId;
using moreau::Pose;
using moreau::Space;
using Law = moreau::LinearSpringDashpot<double>;

template <class S>
using Springs = moreau::Simulation<BallIn<S>, Law>;

/// Balls of radius 1 cm on a lattice of spacing 22 mm, in layers along the last axis. The cell is
/// periodic along the other axes.
template <class S>
Springs<S> periodic_layers(int per_side, int layers, const Law& law) {
  Springs<S> world(0.02, moreau::Materials<Law>(1, law));
  const auto ball = world.add_shape(BallIn<S>(0.01));
  int count = layers;
  for (int axis = 0; axis + 1 < S::dim; ++axis) {
    world.set_periodic(axis, 0, 0.022 * per_side);
    count *= per_side;
  }
  for (int k = 0; k < count; ++k) {
    Pose<S> pose;
    int rest = k;
    for (int axis = 0; axis + 1 < S::dim; ++axis, rest /= per_side)
      pose.position[axis] = 0.022 * (rest % per_side);
    pose.position[0] += 0.007 * rest;
    pose.position[S::dim - 1] = 0.012 + 0.021 * rest;
    world.add_grain(ball, pose, 1000);
  }
  return world;
}

}  // namespace

TEST_CASE_TEMPLATE("a servo wall brings a periodic packing to its pressure", S, Space<2>,
                   Space<3>) {
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1, side = 4, steps = up == 1 ? 5000 : 8000;
  const double h = up == 1 ? 2e-4 : 5e-5, pressure = up == 1 ? 500 : 2e4;
  Springs<S> world = periodic_layers<S>(side, 4, Law(2e4, 1e4, 0.3, 0.2));
  world.add_wall(Vector::Unit(up), Vector::Zero());
  const BodyId lid = world.add_wall(-Vector::Unit(up), 0.1 * Vector::Unit(up));
  const double area = std::pow(0.022 * side, double(up));
  const moreau::PressureServo servo(lid, pressure, up == 1 ? 1e-4 : 5e-6, 0.1,
                                    [&] { return area; });
  double worst = 0;
  for (int k = 0; k < steps; ++k) {
    servo.apply(world, h);
    world.step(h);
    const double now = moreau::wall_pressure(world, lid, h, area);
    if (k >= steps - 200) worst = std::max(worst, std::abs(now / pressure - 1));
  }
  CHECK(worst < 0.01);
  // There are no side walls, so the floor carries the whole load.
  CHECK(moreau::wall_pressure(world, BodyId(lid.index() - 1), h, area) ==
        doctest::Approx(pressure).epsilon(0.01));
  Vector momentum = Vector::Zero();
  for (std::size_t k = 0; k < world.grain_count(); ++k)
    momentum += world.bodies().grain_mass[k] * world.bodies().velocity[k].template head<S::dim>();
  CHECK(momentum.norm() < 1e-3);
}

TEST_CASE_TEMPLATE("springs across the boundary keep momentum and energy", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  Springs<S> ring(0.02, moreau::Materials<Law>(1, Law(1e4)));
  ring.set_periodic(0, -0.3, -0.2);
  const auto ball = ring.add_shape(BallIn<S>(0.01));
  const double speeds[] = {1, -0.5, 0.2};
  double momentum = 0, energy = 0;
  for (int k = 0; k < 3; ++k) {
    Pose<S> pose;
    pose.position[0] = 0.03 * k;
    ring.set_velocity(ring.add_grain(ball, pose, 1000), speeds[k] * Vector::UnitX());
    momentum += speeds[k];
    energy += speeds[k] * speeds[k];
  }
  for (int k = 0; k < 20000; ++k) ring.step(2e-5);
  double momentum_after = 0, energy_after = 0, farthest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double v = ring.bodies().velocity[k][0];
    momentum_after += v;
    energy_after += v * v;
    farthest = std::max(farthest, std::abs(ring.bodies().pose[k].position[0]));
  }
  CHECK(momentum_after == doctest::Approx(momentum).epsilon(1e-10));
  CHECK(energy_after == doctest::Approx(energy).epsilon(0.02));
  CHECK(farthest < 0.4);  // the balls cannot pass each other
}

TEST_CASE_TEMPLATE("a soft ball swings in a cylinder", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  constexpr int up = S::dim - 1;
  const double R = 0.5, r = 0.05, angle = 0.05, h = 5e-5, g = 9.81;
  const double rate = std::sqrt((up == 2 ? 5.0 / 7 : 2.0 / 3) * g / (R - r));
  Springs<S> world(0.1, moreau::Materials<Law>(1, Law(1e6, 5e5, 1, 0.2)));
  Pose<S> pose;
  pose.position =
      (R - r) * (std::sin(angle) * Vector::UnitX() - std::cos(angle) * Vector::Unit(up));
  const BodyId ball = world.add_grain(world.add_shape(BallIn<S>(r)), pose, 1000);
  world.add_cylinder(Vector::Zero(), S::Angular::Unit(S::angular_dim / 2), R);
  world.set_gravity(-g * Vector::Unit(up));
  const double quarter = std::numbers::pi / 2 / rate;
  while (world.time() < quarter) world.step(h);
  const double x = world.pose(ball).position[0];
  CHECK(std::abs(x) < 0.02 * angle * (R - r));
  while (world.time() < 2 * quarter) world.step(h);
  CHECK(world.pose(ball).position[0] == doctest::Approx(-(R - r) * std::sin(angle)).epsilon(0.02));
}
