// SPDX-License-Identifier: MIT
// Simulations in periodic cells.
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "boundary/grain_of_radius.hpp"
#include "sanitized.hpp"
#include "types.hpp"
#include "world/assemblies.hpp"

using namespace moreau;

namespace {

using Law = moreau::SignoriniCoulomb<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Two layers of grains with random orientations on a floor, in a cell that is periodic along x. In
/// space the box has walls along y. The whole scene is shifted along x, and the poses are wrapped
/// into the cell.
template <class ShapeT>
struct Layers {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  static constexpr double length = 0.12;
  static constexpr std::size_t count = 14;
  scenes::World<ShapeT> simulation;
  std::vector<Vector> start;
  double shift;

  explicit Layers(double moved, bool periodic = true)
      : simulation(0.02, moreau::Materials<Law>(1, Law(0.4)), solver()), shift(moved) {
    if (periodic) simulation.set_periodic(0, 0, length);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> jitter(-1, 1);
    const auto shape = simulation.add_shape(grain_of_radius<ShapeT>(0.008));
    for (int k = 0; k < int(count); ++k) {
      Pose<S> pose;
      pose.position = Vector::Constant(0.02);
      pose.position[0] = length / 7 * (k % 7 + 0.5 * (k / 7)) + 5e-4 * jitter(random);
      pose.position[up] = 0.009 + 0.017 * (k / 7);
      pose.rotation = S::exp(S::Angular::Constant(jitter(random)));
      start.push_back(pose.position);
      pose.position[0] += shift;
      if (periodic) pose.position = simulation.cell().wrap(pose.position);
      const BodyId grain = simulation.add_grain(shape, pose, 2700);
      simulation.set_velocity(grain, 0.3 * jitter(random) * Vector::UnitX());
    }
    for (int axis = 1; axis < up; ++axis) {
      simulation.add_wall(Vector::Unit(axis), Vector::Zero());
      simulation.add_wall(-Vector::Unit(axis), 0.04 * Vector::Unit(axis));
    }
    simulation.add_wall(Vector::Unit(up), Vector::Zero());
    simulation.set_gravity(-9.81 * Vector::Unit(up) + 2 * Vector::UnitX());
  }
  static moreau::ColouredGaussSeidel solver() {
    moreau::ColouredOptions options;
    options.tolerance = 1e-13;
    options.max_sweeps = 2000;
    return moreau::ColouredGaussSeidel(options);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("a periodic packing knows no origin", ShapeT,
                   MOREAU_TYPES((Polygon<>, moreau::Ball<>), (Polyhedron<>, moreau::Disk<>))) {
  using Scene = Layers<ShapeT>;
  Scene one(0), other(0.37 * Scene::length);
  std::size_t across = 0;
  for (int k = 0; k < 80; ++k) {
    const auto a = one.simulation.step(5e-4), b = other.simulation.step(5e-4);
    REQUIRE(a.points == b.points);
    CHECK(a.warm_started == b.warm_started);
    for (const auto& contact : one.simulation.contacts().points) {
      if (contact.b >= Scene::count) continue;
      const auto& pose = one.simulation.bodies().pose;
      across +=
          std::abs(pose[contact.a].position[0] - pose[contact.b].position[0]) > Scene::length / 2;
    }
  }
  CHECK(across > 0);
  double worst = 0;
  for (std::size_t k = 0; k < Scene::count; ++k) {
    typename Scene::Vector moved = other.simulation.bodies().pose[k].position;
    moved[0] -= other.shift;
    const auto& x = one.simulation.bodies().pose[k].position;
    worst = std::max(worst, (one.simulation.cell().nearest(moved, x) - x).norm());
    worst = std::max(
        worst,
        (one.simulation.bodies().velocity[k] - other.simulation.bodies().velocity[k]).norm());
  }
  CHECK(worst < 1e-10);
}

TEST_CASE_TEMPLATE("where nothing reaches the boundary, a periodic cell keeps the bits", ShapeT,
                   Polyhedron<>, Polygon<>) {
  Layers<ShapeT> open(0, false), wide(0, false);
  wide.simulation.set_periodic(0, -0.5, 1);
  CHECK(scenes::have_same_bits_after(rounds(120), open.simulation, wide.simulation));
  CHECK(open.simulation.contacts().size() > 0);
}

TEST_CASE_TEMPLATE("two grains hunt each other around the cell", ShapeT, moreau::Ball<>,
                   moreau::Disk<>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const double h = 1e-3, length = 1, half = 0.1, v = 1;
  scenes::World<ShapeT> ring(0.2, moreau::Materials<Law>(1, Law(0, 1)));
  ring.set_periodic(0, 0, length);
  const auto shape = ring.add_shape(grain_of_radius<ShapeT>(half));
  Pose<S> pose;
  pose.position[0] = 0.2;
  const BodyId runner = ring.add_grain(shape, pose, 1000);
  pose.position[0] = 0.7;
  const BodyId target = ring.add_grain(shape, pose, 1000);
  ring.set_velocity(runner, v * Vector::UnitX());
  // Each impact transfers the velocity to the other grain. The path before the first impact is 0.3;
  // all later paths have the free length of the cell, 1 minus two widths of 0.2.
  int impacts = 0;
  bool runs = true;
  while (ring.time() < 20) {
    ring.step(h);
    const bool now = ring.velocity(runner)[0] > v / 2;
    impacts += now != runs;
    runs = now;
  }
  CHECK(std::abs(impacts - (1 + (20 - 0.3) / 0.6)) <= 1);
  const double travelled =
      ring.pose(runner).position[0] - 0.2 + ring.pose(target).position[0] - 0.7;
  CHECK(travelled == doctest::Approx(20 * v).epsilon(1e-9));
  CHECK(ring.pose(runner).position[0] > 8);
}

TEST_CASE("bad cells are named") {
  using S = Space<3>;
  scenes::World<BallIn<S>> world(0.02, moreau::Materials<Law>(1));
  CHECK_THROWS_WITH_AS(world.set_periodic(3, 0, 1),
                       "Simulation::set_periodic: axis = 3 must be an axis of the space",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(world.set_periodic(0, 1, 1),
                       "Simulation::set_periodic: upper = 1 must be finite and above lower",
                       std::invalid_argument);
  CHECK_THROWS_AS(world.set_periodic(0, std::nan(""), 1), std::invalid_argument);
  CHECK_THROWS_AS(world.set_periodic(0, -infinity, 1), std::invalid_argument);
  world.set_periodic(0, 0, 0.1);
  CHECK_THROWS_WITH_AS(world.add_wall(S::Vector::UnitX(), S::Vector::Zero()),
                       "Simulation::add_wall: normal = (1, 0, 0) must be perpendicular to the "
                       "periodic axes",
                       std::invalid_argument);
  CHECK_THROWS_AS(world.add_cylinder(S::Vector::Zero(), S::Vector::UnitY(), 1),
                  std::invalid_argument);
  const auto large = world.add_shape(BallIn<S>(0.025)), small = world.add_shape(BallIn<S>(0.02));
  CHECK_THROWS_WITH_AS(world.add_grain(large, {}, 1000),
                       "Simulation::add_grain: length of the cell = 0.1 must be more than two of "
                       "the widest grain with margin and skin",
                       std::invalid_argument);
  CHECK(world.bodies().size() == 0);
  world.add_grain(small, {}, 1000);
  CHECK_THROWS_AS(world.set_periodic(1, 0, 0.08), std::invalid_argument);
  CHECK(!world.cell().is_periodic(1));
  world.add_wall(S::Vector::UnitZ(), S::Vector::Zero());
  world.add_cylinder(S::Vector::Zero(), S::Vector::UnitX(), 1);
  CHECK_THROWS_AS(world.set_periodic(2, 0, 1), std::invalid_argument);
  world.set_periodic(0, -infinity, infinity);
  CHECK(world.cell().is_open());
  world.step(1e-3);
}
