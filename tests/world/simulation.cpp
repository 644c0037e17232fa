// SPDX-License-Identifier: MIT
#include "moreau/world/simulation.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <vector>

#include "sanitized.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"
#include "world/check_rest.hpp"

using moreau::BallIn;
using moreau::BodyId;
using moreau::MaterialId;
using moreau::Polygon;
using moreau::Polyhedron;
using moreau::Pose;
using moreau::ShapeId;
using moreau::Space;
using scenes::BoxOfGrains;

TEST_CASE_TEMPLATE("linear momentum of grains and walls balances every step", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, moreau::Disk<>), (Polygon<>, moreau::Ball<>))) {
  BoxOfGrains<ShapeT> scene(27);
  using Vector = typename BoxOfGrains<ShapeT>::Vector;
  const double h = 5e-4;
  Vector weight = Vector::Zero();
  for (const BodyId grain : scene.grains)
    weight += scene.simulation.bodies().grain_mass[grain.index()] * scene.simulation.gravity();
  double worst = 0, reactions = 0;
  int unsolved =
      0;  // steps with an island that the direct method attempted, and left to the sweeps
  for (int k = 0; k < rounds(400); ++k) {
    const Vector before = scene.momentum();
    const auto report = scene.simulation.step(h);
    CHECK(report.solve.residual <= moreau::ColouredOptions{}.tolerance);
    unsolved += !report.solve.converged;
    Vector walls = Vector::Zero();
    for (const BodyId wall : scene.walls) walls += scene.simulation.contact_impulse(wall);
    const Vector error = scene.momentum() - before - h * weight + walls;
    worst = std::max(worst, error.norm() / (h * weight.norm()));
    reactions = std::max(reactions, walls.norm());
  }
  CHECK(unsolved <= rounds(400) / 100);
  CHECK(worst < 1e-10);
  CHECK(reactions > 0.1 * h * weight.norm());
}

TEST_CASE_TEMPLATE("grains come to rest on each other, with bounded overlap", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, moreau::Disk<>), (Polygon<>, moreau::Ball<>))) {
  scenes::check_rest<ShapeT>();
}

TEST_CASE_TEMPLATE("the same scene gives the same bits", ShapeT, Polyhedron<>, Polygon<>) {
  BoxOfGrains<ShapeT> one(27), two(27);
  CHECK(scenes::have_same_bits_after(rounds(300), one.simulation, two.simulation));
}

TEST_CASE_TEMPLATE("a driven wall pushes at its velocity, a wall with mass obeys its force", ShapeT,
                   Polyhedron<>, Polygon<>) {
  using Scene = BoxOfGrains<ShapeT>;
  using Vector = typename Scene::Vector;
  Scene scene(9);
  const BodyId wall = scene.walls[1];
  scene.simulation.set_velocity(wall, -0.1 * Vector::UnitX());
  for (int k = 0; k < 100; ++k) scene.simulation.step(5e-4);
  CHECK(scene.simulation.pose(wall).position[0] == doctest::Approx(0.08 - 0.1 * 0.05));
  scene.simulation.set_velocity(wall, Vector::Zero());
  scene.simulation.set_wall_mass(wall, 2.0);
  scene.simulation.set_force(wall, -3 * Vector::UnitX());
  for (int k = 0; k < 20; ++k) {
    const double before = scene.simulation.velocity(wall)[0];
    scene.simulation.step(5e-4);
    const double after = scene.simulation.velocity(wall)[0];
    const double reaction = scene.simulation.contact_impulse(wall)[0] / 5e-4;
    CHECK(2.0 * (after - before) / 5e-4 == doctest::Approx(reaction - 3).epsilon(1e-9));
  }
  CHECK(scene.simulation.bodies().velocity[wall.index()].tail(1).norm() == 0);
}

TEST_CASE("the order in which walls and grains are added does not matter to the sorted contacts") {
  using S = Space<2>;
  using Law = moreau::SignoriniCoulomb<double>;
  scenes::World<BallIn<S>> simulation(0.02, moreau::Materials<Law>(1, Law(0.3)));
  simulation.add_wall(S::Vector::UnitY(), S::Vector::Zero());
  const auto shape = simulation.add_shape(BallIn<S>(0.01));
  for (int k = 0; k < 3; ++k)
    simulation.add_grain(shape, {S::Vector(0.02 * k, 0.01), S::identity()}, 1000);
  simulation.set_gravity(S::Vector(0, -9.81));
  for (int k = 0; k < 5; ++k) {
    const auto report = simulation.step(1e-4);
    CHECK(std::is_sorted(simulation.contacts().keys.begin(), simulation.contacts().keys.end()));
    if (k > 0) CHECK(report.warm_started == report.points);
  }
}

#ifdef MOREAU_TEST_FURTHER_TYPES
namespace {

/// A law that returns NaN for fast contacts.
struct NoNumber {
  double velocity_offset(double gap, double, double step) const { return gap / step; }
  template <class S>
  typename S::Vector solve(const moreau::LocalBlock<S>&, const typename S::Vector& b,
                           const typename S::Vector&) const {
    return S::Vector::Constant(std::sqrt(b[0] + 1));
  }
  template <class Vector>
  Vector natural_map(const Vector&, const Vector& r) const {
    return Vector(0 * r);
  }
};

}  // namespace

TEST_CASE("a step whose impulses are not finite throws names the body") {
  using S = Space<3>;
  moreau::Simulation<BallIn<S>, NoNumber> world(0.02, moreau::Materials<NoNumber>(1));
  const BodyId ball = world.add_grain(world.add_shape(BallIn<S>(0.01)), {}, 1000);
  world.add_wall(S::Vector::UnitZ(), S::Vector(0, 0, -0.01));
  world.set_velocity(ball, S::Vector(0, 0, -5));
  CHECK_THROWS_WITH_AS(world.step(1e-3), doctest::Contains("Simulation::step: velocity of body 0"),
                       std::runtime_error);
  CHECK(world.pose(ball).is_finite());
}
#endif

TEST_CASE("a step whose velocities are not finite throws") {
  using S = Space<3>;
  scenes::World<BallIn<S>> far(0.02, moreau::Materials<moreau::SignoriniCoulomb<double>>(1));
  far.add_grain(far.add_shape(BallIn<S>(0.01)), {}, 1000);
  far.set_gravity(S::Vector(0, 0, -1e308));
  CHECK_THROWS_AS(far.step(10), std::runtime_error);
}

TEST_CASE("bad input is named") {
  using S = Space<3>;
  using Law = moreau::SignoriniCoulomb<double>;
  using Sim = scenes::World<BallIn<S>>;
  const moreau::Materials<Law> laws(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH_AS(Sim(0, laws), "Simulation: grain_size = 0 must be finite and > 0",
                       std::invalid_argument);
  Sim simulation(0.02, laws);
  CHECK_THROWS_WITH_AS(simulation.add_grain(ShapeId(0), {}, 1000),
                       "Simulation::add_grain: shape = 0 must be the id of a shape",
                       std::invalid_argument);
  const ShapeId shape = simulation.add_shape(BallIn<S>(0.01));
  CHECK_THROWS_WITH_AS(simulation.add_grain(shape, {}, -1),
                       "Simulation::add_grain: density = -1 must be finite and > 0",
                       std::invalid_argument);
  Pose<S> bad;
  bad.position[1] = nan;
  CHECK_THROWS_WITH_AS(simulation.add_grain(shape, bad, 1000),
                       "Simulation::add_grain: pose.position = (0, nan, 0) must be finite",
                       std::invalid_argument);
  CHECK_THROWS_AS(simulation.add_grain(shape, {}, 1000, MaterialId(3)), std::invalid_argument);
  CHECK_THROWS_AS(simulation.add_wall(S::Vector(0, 0, 2), S::Vector::Zero()),
                  std::invalid_argument);
  const BodyId grain = simulation.add_grain(shape, {}, 1000);
  CHECK_THROWS_WITH_AS(
      simulation.set_wall_mass(grain, 1),
      "Simulation::set_wall_mass: wall = 0 must be the id of a half-space or of a mesh wall",
      std::invalid_argument);
  Pose<S> twisted;
  twisted.rotation.coeffs() *= 3;
  CHECK_THROWS_WITH_AS(simulation.set_pose(grain, twisted),
                       doctest::Contains("Simulation::set_pose: pose.rotation"),
                       std::invalid_argument);
  twisted.rotation.w() = nan;
  CHECK_THROWS_WITH_AS(simulation.add_grain(shape, twisted, 1000),
                       doctest::Contains("Simulation::add_grain: pose.rotation"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(simulation.grain(1),
                       "Simulation::grain: k = 1 must be below the number of grains",
                       std::invalid_argument);
  CHECK_THROWS_AS(simulation.shape_of_grain(1), std::invalid_argument);
  CHECK_THROWS_WITH_AS(BodyId(std::size_t(1) << 32), "Id: index = 4294967296 must be below 2^32",
                       std::invalid_argument);
  CHECK_THROWS_AS(moreau::Materials<Law>(65536), std::invalid_argument);
  CHECK_THROWS_WITH_AS(laws(MaterialId(0), MaterialId(1)),
                       "Materials::operator(): b = 1 must be the id of a material",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(simulation.contact_impulse(BodyId(99)),
                       "Simulation::contact_impulse: body = 99 must be the id of a body",
                       std::invalid_argument);
  moreau::Tolerances endless;
  endless.margin = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH_AS(Sim(0.02, laws, moreau::ColouredGaussSeidel(), endless),
                       "Simulation: margin = inf must be finite and > 0", std::invalid_argument);
  CHECK_THROWS_AS(simulation.set_force(BodyId(7), S::Vector::Zero()), std::invalid_argument);
  CHECK_THROWS_AS(simulation.set_force(grain, S::Vector(nan, 0, 0)), std::invalid_argument);
  CHECK_THROWS_WITH_AS(simulation.set_torque(BodyId(7), S::Vector::Zero()),
                       "Simulation::set_torque: body = 7 must be the id of a body",
                       std::invalid_argument);
  CHECK_THROWS_AS(simulation.set_torque(grain, S::Vector(nan, 0, 0)), std::invalid_argument);
  CHECK_THROWS_AS(simulation.set_gravity(S::Vector(nan, 0, 0)), std::invalid_argument);
  CHECK_THROWS_WITH_AS(simulation.step(-1e-3),
                       "Simulation::step: step = -0.001 must be finite and > 0",
                       std::invalid_argument);
}

TEST_CASE_TEMPLATE("a torque turns a grain about its centre until it is set again", ShapeT,
                   moreau::Ball<>, moreau::Disk<>) {
  using S = moreau::SpaceOf<ShapeT>;
  scenes::World<ShapeT> world(0.02, moreau::Materials<scenes::LawOf<ShapeT>>(1));
  const BodyId grain = world.add_grain(world.add_shape(ShapeT(0.01)), {}, 2500);
  const typename S::Angular torque = 1e-6 * S::Angular::Unit(S::angular_dim - 1);
  world.set_torque(grain, torque);
  for (int k = 0; k < 100; ++k) world.step(1e-3);
  world.set_torque(grain, S::Angular::Zero());
  world.step(1e-3);
  const double inertia = world.bodies().inertia_body[grain.index()](0, 0);
  CHECK(world.spin(grain)[S::angular_dim - 1] == doctest::Approx(0.1 * 1e-6 / inertia));
  CHECK(world.velocity(grain).norm() == 0);
}
