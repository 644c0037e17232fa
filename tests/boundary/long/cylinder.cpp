// SPDX-License-Identifier: MIT
// Grains in a cylinder, or in the plane in a circle.
#include "moreau/shape/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <numbers>

#include "world/assemblies.hpp"

using namespace moreau;

namespace {

using Law = moreau::SignoriniCoulomb<double>;
constexpr double gravity = 9.81;

/// The direction perpendicular to x and to the last axis.
template <class S>
typename S::Angular across() {
  return S::Angular::Unit(S::angular_dim / 2);
}

/// One grain in a cylinder about the origin. The axis of the cylinder is horizontal.
template <class ShapeT>
struct InCylinder {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  scenes::World<ShapeT> simulation;
  BodyId grain, drum;

  InCylinder(const ShapeT& shape, const Vector& position, double radius, double friction)
      : simulation(0.1, moreau::Materials<Law>(1, Law(friction)), solver()) {
    Pose<S> pose;
    pose.position = position;
    grain = simulation.add_grain(simulation.add_shape(shape), pose, 1000);
    drum = simulation.add_cylinder(Vector::Zero(), across<S>(), radius);
    simulation.set_gravity(-gravity * Vector::Unit(up));
  }
  static moreau::ColouredGaussSeidel solver() {
    moreau::ColouredOptions options;
    options.tolerance = 1e-13;
    options.max_sweeps = 20000;
    return moreau::ColouredGaussSeidel(options);
  }
  const Vector& position() const { return simulation.pose(grain).position; }
  double mass() const { return simulation.bodies().grain_mass[grain.index()]; }
};

}  // namespace

TEST_CASE_TEMPLATE("a ball (disk) without slip swings at sqrt(5 g / 7 (R - r)), (2 g / 3 (R - r))",
                   ShapeT, moreau::Ball<>, moreau::Disk<>) {
  using Scene = InCylinder<ShapeT>;
  using Vector = typename Scene::Vector;
  constexpr bool solid = Scene::S::angular_dim == 3;
  const double R = 0.5, r = 0.05, angle = 0.05;
  const double rate = std::sqrt((solid ? 5.0 / 7 : 2.0 / 3) * gravity / (R - r));
  // Period of a pendulum, to second order in its amplitude.
  const double period = 2 * std::numbers::pi / rate * (1 + angle * angle / 16);
  for (const double h : {2e-3, 5e-4}) {
    const Vector start =
        (R - r) * (std::sin(angle) * Vector::UnitX() - std::cos(angle) * Vector::Unit(Scene::up));
    Scene scene(ShapeT(r), start, R, 1);
    double first = 0, last = 0, before = start[0];
    int crossings = 0;
    while (crossings < 7) {
      scene.simulation.step(h);
      const double x = scene.position()[0];
      if (x * before <= 0) {
        last = scene.simulation.time() - h * x / (x - before);
        if (crossings++ == 0) first = last;
      }
      before = x;
    }
    CHECK(std::abs((last - first) / 3 - period) < h);
    CHECK(std::abs(scene.position().norm() - (R - r)) < 1e-4);
  }
}

// A contact at one end only would tilt the grain: it lost 14 % of its amplitude in four periods with 1 ms.
TEST_CASE(
    "a Cylinder that rolls or slides in a cylinder touches it at both ends and loses nothing") {
  using S = Space<3>;
  const double R = 0.1, r = 0.02, angle = 0.1, path = R - r;
  for (const double friction : {0.0, 1.0})
    for (const double h : {4e-3, 1e-3}) {
      Simulation<Cylinder<>, Law> world(2 * r, moreau::Materials<Law>(1, Law(friction)));
      world.add_cylinder(S::Vector::Zero(), S::Vector::UnitX(), R);
      const S::Vector start(0, path * std::sin(angle), -path * std::cos(angle));
      const BodyId grain =
          world.add_grain(world.add_shape(Cylinder<>(0.03, r)), {start, S::identity()}, 1000);
      world.set_gravity(-gravity * S::Vector::UnitZ());
      const double rate = std::sqrt(gravity / path / (friction > 0 ? 1.5 : 1));
      const double period = 2 * std::numbers::pi / rate * (1 + angle * angle / 16);
      double most = 0, off = 0;
      std::size_t points = 0;
      for (double t = 0; t < 4.25 * period; t += h) {
        points = std::max(points, world.step(h).points);
        const S::Vector x = world.pose(grain).position;
        if (t > 3.75 * period) most = std::max(most, std::atan2(x[1], -x[2]));
        off = std::max(off, std::abs(std::hypot(x[1], x[2]) - path));
      }
      CAPTURE(friction);
      CAPTURE(h);
      CHECK(points == 2);
      CHECK(std::abs(most / angle - 1) < 0.2 * std::pow(rate * h, 2));
      CHECK(off < 0.1 * std::pow(rate * h, 2) * path);
      CHECK(
          (world.pose(grain).rotation * S::Vector(S::Vector::UnitX()) - S::Vector::UnitX()).norm() <
          1e-9);
    }
}

TEST_CASE_TEMPLATE("a ball rolls on the spot in a spinning cylinder", ShapeT, moreau::Ball<>,
                   moreau::Disk<>) {
  using Scene = InCylinder<ShapeT>;
  using S = typename Scene::S;
  using Vector = typename Scene::Vector;
  const double R = 0.5, r = 0.1, rate = 3, h = 1e-3;
  const Vector bottom = -(R - r) * Vector::Unit(Scene::up);
  Scene scene(ShapeT(r), bottom, R, 0.5);
  scene.simulation.set_spin(scene.drum, rate * across<S>());
  scene.simulation.set_spin(scene.grain, rate * R / r * across<S>());
  for (int k = 0; k < 500; ++k) CHECK(scene.simulation.step(h).points == 1);
  CHECK((scene.position() - bottom).norm() < 1e-9);
  const auto& velocity = scene.simulation.bodies().velocity[scene.grain.index()];
  CHECK((velocity.template tail<S::angular_dim>() - rate * R / r * across<S>()).norm() < 1e-8);
  CHECK((scene.simulation.contact_impulse(scene.drum) +
         scene.mass() * gravity * h * Vector::Unit(Scene::up))
            .norm() < 1e-9 * scene.mass());
  // Without this initial spin, friction moves the grain in the direction of the wall's motion.
  Scene dragged(ShapeT(r), bottom, R, 0.5);
  dragged.simulation.set_spin(dragged.drum, rate * across<S>());
  for (int k = 0; k < 50; ++k) dragged.simulation.step(h);
  const Vector wall = S::spin(rate * across<S>(), bottom);
  CHECK(wall.dot(dragged.position() - bottom) > 0);
}

TEST_CASE_TEMPLATE("a box rests in a cylinder on its corners", ShapeT, Polyhedron<>, Polygon<>) {
  using Scene = InCylinder<ShapeT>;
  using Vector = typename Scene::Vector;
  const double half = 0.05, R = 0.2, h = 1e-3;
  const double depth = std::sqrt(R * R - half * half) - half;
  Scene scene(scenes::cuboid<ShapeT>(Vector::Constant(half)), -depth * Vector::Unit(Scene::up), R,
              0.4);
  const std::size_t corners = 1u << (Scene::S::dim - 1);
  for (int k = 0; k < 300; ++k) {
    const auto report = scene.simulation.step(h);
    CHECK(report.points == corners);
    CHECK(report.pairs == 1);
    if (k > 0) CHECK(report.warm_started == corners);
  }
  CHECK((scene.position() + depth * Vector::Unit(Scene::up)).norm() < 1e-7);
  CHECK(scene.simulation.bodies().velocity[scene.grain.index()].norm() < 1e-8);
  CHECK((scene.simulation.contact_impulse(scene.drum) +
         scene.mass() * gravity * h * Vector::Unit(Scene::up))
            .norm() < 1e-8 * scene.mass());
}

TEST_CASE("bad cylinders are named") {
  using S = Space<3>;
  scenes::World<BallIn<S>> world(0.02, moreau::Materials<Law>(1));
  const S::Vector zero = S::Vector::Zero();
  CHECK_THROWS_WITH_AS(world.add_cylinder(zero, S::Vector(0, 0, 2), 1),
                       "Simulation::add_cylinder: axis = (0, 0, 2) must be unit",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.add_cylinder(zero, S::Vector::UnitX(), -1),
                       "Simulation::add_cylinder: radius = -1 must be finite and > 0",
                       std::invalid_argument);
  CHECK_THROWS_AS(world.add_cylinder(S::Vector(std::nan(""), 0, 0), S::Vector::UnitX(), 1),
                  std::invalid_argument);
  CHECK_THROWS_AS(moreau::CylinderWall<S>(zero, 1), std::invalid_argument);
  const BodyId drum = world.add_cylinder(zero, S::Vector::UnitX(), 1);
  CHECK_THROWS_AS(world.set_wall_mass(drum, 1), std::invalid_argument);
}
