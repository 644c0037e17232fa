// SPDX-License-Identifier: MIT
// Walls whose force or velocity is a function of time, and walls with a prescribed pressure.
#include "moreau/boundary/drive.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>

#include "moreau/boundary/servo.hpp"

#include "boundary/check_lid.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

namespace {

using Law = moreau::SignoriniCoulomb<double>;

/// A simulation with one wall, whose normal is along x, and no grains.
template <class ShapeT>
struct LoneWall {
  using Vector = typename moreau::SpaceOf<ShapeT>::Vector;
  scenes::World<ShapeT> simulation{0.02, moreau::Materials<Law>(1)};
  BodyId wall = simulation.add_wall(Vector::UnitX(), Vector::Zero());

  double x() const { return simulation.bodies().pose[wall.index()].position[0]; }
  double v() const { return simulation.bodies().velocity[wall.index()][0]; }
};

}  // namespace

TEST_CASE("the harmonic force swings between its bounds from the mean downwards") {
  const HarmonicForce f(100, 500, 5, 0.25);
  CHECK(f(0.25) == 300);
  CHECK(f(0.3) == doctest::Approx(100));
  CHECK(f(0.4) == doctest::Approx(500));
  CHECK(HarmonicForce(-1, 3, 0)(7) == 1);
}

TEST_CASE_TEMPLATE("a wall without grains moves as the force says, to second order", ShapeT,
                   moreau::Ball<>, moreau::Disk<>) {
  using Vector = typename LoneWall<ShapeT>::Vector;
  const double fmin = -20, fmax = 60, frequency = 4, mass = 2;
  const double w = 2 * std::numbers::pi * frequency;
  const double mean = (fmin + fmax) / 2, amplitude = (fmax - fmin) / 2;
  double errors[2];
  for (int refine = 0; refine < 2; ++refine) {
    LoneWall<ShapeT> scene;
    scene.simulation.set_wall_mass(scene.wall, mass);
    const ForceDrive drive(scene.wall, -Vector::UnitX(), HarmonicForce(fmin, fmax, frequency));
    const double h = 2e-3 / (1 << refine);
    errors[refine] = 0;
    while (scene.simulation.time() < 1) {
      drive.apply(scene.simulation, h);
      scene.simulation.step(h);
      const double t = scene.simulation.time();
      const double v = -(mean * t - amplitude * (1 - std::cos(w * t)) / w) / mass;
      const double x = -(mean * t * t / 2 - amplitude * (t / w - std::sin(w * t) / (w * w))) / mass;
      errors[refine] = std::max({errors[refine], std::abs(scene.x() - x), std::abs(scene.v() - v)});
    }
  }
  CHECK(errors[0] < 1e-3);
  CHECK(errors[0] / errors[1] == doctest::Approx(4).epsilon(0.05));
}

TEST_CASE("a driven velocity is taken in the middle of the step") {
  LoneWall<moreau::Disk<>> scene;
  const VelocityDrive drive(scene.wall, Space<2>::Vector(1, 0), [](double t) { return 3 * t * t; });
  const double h = 1e-3;
  for (int k = 0; k < 1000; ++k) {
    drive.apply(scene.simulation, h);
    CHECK(scene.v() == doctest::Approx(3 * std::pow((k + 0.5) * h, 2)));
    scene.simulation.step(h);
  }
  // For t^3, the midpoint rule gives a result that is too small by h^2/4.
  CHECK(scene.x() == doctest::Approx(1 - h * h / 4).epsilon(1e-10));
}

TEST_CASE_TEMPLATE("a lid under pressure settles to it", ShapeT,
                   MOREAU_TYPES((Polygon<>, moreau::Ball<>), (Polyhedron<>, moreau::Disk<>))) {
  scenes::check_lid<ShapeT>();
}

TEST_CASE("bad drives and servos are named") {
  LoneWall<moreau::Disk<>> scene;
  using V = Space<2>::Vector;
  CHECK_THROWS_WITH_AS(HarmonicForce(2, 1, 1), "HarmonicForce: fmax = 1 must be finite and >= fmin",
                       std::invalid_argument);
  CHECK_THROWS_AS(HarmonicForce(0, 1, -1), std::invalid_argument);
  CHECK_THROWS_AS(HarmonicForce(std::nan(""), 1, 1), std::invalid_argument);
  const auto one = [](double) { return 1.0; };
  CHECK_THROWS_WITH_AS(ForceDrive(scene.wall, V(1, 1), one),
                       "ForceDrive: direction = (1, 1) must be unit", std::invalid_argument);
  CHECK_THROWS_AS(VelocityDrive(scene.wall, V(0, 0), one), std::invalid_argument);
  const ForceDrive nobody(BodyId(9), V(1, 0), one);
  CHECK_THROWS_AS(nobody.apply(scene.simulation, 1e-3), std::invalid_argument);
  const ForceDrive push(scene.wall, V(1, 0), one), aside(scene.wall, V(0, 1), one);
  CHECK_THROWS_WITH_AS(push.apply(scene.simulation, 1e-3),
                       "ForceDrive::apply: body = 0 must have a mass along the direction; "
                       "set_wall_mass gives a wall one",
                       std::invalid_argument);
  scene.simulation.set_wall_mass(scene.wall, 1);
  push.apply(scene.simulation, 1e-3);
  CHECK_THROWS_AS(aside.apply(scene.simulation, 1e-3), std::invalid_argument);
  const VelocityDrive pull(scene.wall, V(1, 0), one), along(scene.wall, V(0, 1), one);
  CHECK_THROWS_WITH_AS(
      pull.apply(scene.simulation, 1e-3),
      "VelocityDrive::apply: body = 0 must have a prescribed motion along the direction, as a "
      "wall without set_wall_mass",
      std::invalid_argument);
  along.apply(scene.simulation, 1e-3);
  CHECK_THROWS_AS(along.apply(scene.simulation, -1e-3), std::invalid_argument);
  CHECK_THROWS_AS(HarmonicForce(0, 1, 1e308), std::invalid_argument);
  const ForceDrive endless(scene.wall, V(1, 0), [](double) { return std::nan(""); });
  CHECK_THROWS_AS(endless.apply(scene.simulation, 1e-3), std::invalid_argument);
  double length = 1;
  const auto area = [&] { return length; };
  CHECK_THROWS_AS(PressureLoad(scene.simulation, scene.wall, 1, -1, area), std::invalid_argument);
  CHECK_THROWS_AS(PressureLoad(scene.simulation, BodyId(9), 1, 1, area), std::invalid_argument);
  CHECK_THROWS_WITH_AS(PressureServo(scene.wall, 1, 0, 1, area),
                       "PressureServo: gain = 0 must be finite and > 0", std::invalid_argument);
  CHECK_THROWS_AS(PressureServo(scene.wall, 1, 1, -1, area), std::invalid_argument);
  const PressureServo servo(scene.wall, 1, 1, 1, area);
  CHECK_THROWS_WITH_AS(
      servo.apply(scene.simulation, 1e-3),
      "PressureServo::apply: wall = 0 must have a prescribed motion: contacts change the "
      "velocity of a wall with a mass",
      std::invalid_argument);
  length = 0;
  CHECK_THROWS_WITH_AS(servo.apply(scene.simulation, 1e-3),
                       "PressureServo::apply: area = 0 must be finite and > 0",
                       std::invalid_argument);
  CHECK_THROWS_AS(moreau::wall_pressure(scene.simulation, scene.wall, 0, 1), std::invalid_argument);
  CHECK_THROWS_WITH_AS(moreau::wall_pressure(scene.simulation, BodyId(9), 1e-3, 1),
                       "wall_pressure: wall = 9 must be the id of a half-space",
                       std::invalid_argument);
}

TEST_CASE_TEMPLATE("a servo moves the lid of a shear cell along its normal alone", ShapeT,
                   moreau::Ball<>, moreau::Disk<>) {
  using Vector = typename LoneWall<ShapeT>::Vector;
  for (const bool drive_first : {false, true}) {
    LoneWall<ShapeT> scene;
    auto& world = scene.simulation;
    const Vector along = Vector::Unit(1);
    world.set_velocity(scene.wall, Vector(7 * Vector::UnitX() + 3 * along));
    const PressureServo servo(scene.wall, 100, 1e-3, 0.05, [] { return 1.0; });
    const VelocityDrive drive(scene.wall, along, [](double) { return 3.0; });
    for (int k = 0; k < 10; ++k) {
      if (drive_first) drive.apply(world, 1e-3);
      servo.apply(world, 1e-3);
      world.step(1e-3);
      CHECK(world.velocity(scene.wall)[0] == doctest::Approx(0.05));  // the limit
      CHECK(world.velocity(scene.wall)[1] == 3);
    }
    CHECK(world.pose(scene.wall).position[1] == doctest::Approx(0.03));
  }
}

TEST_CASE("a velocity drives a grain of prescribed motion, a force does not") {
  LoneWall<moreau::Disk<>> scene;
  using V = Eigen::Vector2d;
  auto& world = scene.simulation;
  const auto shape = world.add_shape(moreau::Disk<>(0.01));
  const BodyId grain = world.add_grain(shape, {V(1, 0), moreau::Space<2>::identity()}, 1000);
  const auto one = [](double) { return 1.0; };
  const ForceDrive push(grain, V(1, 0), one);
  const VelocityDrive pull(grain, V(1, 0), one);
  CHECK_NOTHROW(push.apply(world, 1e-3));
  CHECK_THROWS_AS(pull.apply(world, 1e-3), std::invalid_argument);
  world.prescribe_motion(grain);
  CHECK_THROWS_AS(push.apply(world, 1e-3), std::invalid_argument);
  pull.apply(world, 1e-3);
  world.step(1e-3);
  CHECK(world.pose(grain).position[0] == doctest::Approx(1.001));
  world.remove_grain(grain);
  world.prescribe_motion(world.add_grain(shape, {}, 1000));  // has the same index
  CHECK_THROWS_WITH_AS(pull.apply(world, 1e-3),
                       "VelocityDrive::apply: body = 1 must be the id of a body",
                       std::invalid_argument);
}

TEST_CASE_TEMPLATE("a load that is made again goes on, and stops a wall of prescribed motion",
                   ShapeT, moreau::Ball<>, moreau::Disk<>) {
  LoneWall<ShapeT> scene;
  auto& world = scene.simulation;
  const auto area = [] { return 1.0; };
  world.set_velocity(scene.wall, LoneWall<ShapeT>::Vector::UnitX());
  const PressureLoad first(world, scene.wall, 6, 2, area);
  CHECK(scene.v() == 0);
  first.apply(world);
  world.step(0.1);
  CHECK(scene.v() == doctest::Approx(0.3));
  const double speed = scene.v();
  const PressureLoad again(world, scene.wall, 6, 2, area);
  CHECK(scene.v() == speed);
  const PressureLoad heavier(world, scene.wall, 6, 4, area);
  CHECK(scene.v() == speed);
  heavier.apply(world);
  world.step(0.1);
  CHECK(scene.v() == doctest::Approx(0.45));
  world.set_wall_mass(scene.wall, std::numeric_limits<double>::infinity());
  const PressureLoad stopped(world, scene.wall, 6, 4, area);
  CHECK(scene.v() == 0);
}

TEST_CASE("the lid of a shear cell moves under its pressure while a drive shears it") {
  LoneWall<moreau::Disk<>> scene;  // normal along x
  using V = Space<2>::Vector;
  const PressureLoad load(scene.simulation, scene.wall, 1, 2, [] { return 1.0; });
  const VelocityDrive shear(scene.wall, V(0, 1), [](double) { return 0.1; });
  const V start = scene.simulation.pose(scene.wall).position;
  for (int k = 0; k < 1000; ++k) {
    load.apply(scene.simulation, 1e-3);
    shear.apply(scene.simulation, 1e-3);
    scene.simulation.step(1e-3);
  }
  const V way = scene.simulation.pose(scene.wall).position - start;
  CHECK(std::abs(way[0]) == doctest::Approx(0.25).epsilon(1e-2));  // 1 N/m on 2 kg for 1 s
  CHECK(way[1] == doctest::Approx(0.1));
}
