// SPDX-License-Identifier: MIT
// Periodic cells: pairs, whole simulations, measures.
#include <cmath>
#include <cstring>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "moreau/detect/image_pairs.hpp"
#include "moreau/detect/sweep_and_prune.hpp"
#include "moreau/measure/coordination.hpp"
#include "moreau/measure/force_chains.hpp"
#include "moreau/measure/stress.hpp"
#include "moreau/measure/velocity_field.hpp"

#include "sanitized.hpp"
#include "world/assemblies.hpp"

using moreau::Aabb;
using moreau::BodyId;
using moreau::IndexPair;
using moreau::PeriodicCell;
using moreau::Polygon;
using moreau::Polyhedron;
using moreau::Pose;
using moreau::Space;
using moreau::Sphere;

namespace {

using Law = moreau::SignoriniCoulomb<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A ball, or the cube (square) in it.
template <class ShapeT>
ShapeT grain_of_radius(double radius) {
  using Vector = typename moreau::SpaceOf<ShapeT>::Vector;
  if constexpr (std::is_constructible_v<ShapeT, double>)
    return ShapeT(radius);
  else
    return scenes::cuboid<ShapeT>(radius * Vector::Ones().normalized());
}

/// Two layers of grains at random angles on a floor, in a cell that is periodic along x; in space
/// the box has walls along y. The whole scene is shifted along x, poses wrapped.
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
    options.max_sweeps = 20000;
    return moreau::ColouredGaussSeidel(options);
  }
};

template <class S>
Aabb<S> box_at(const typename S::Vector& center, double half) {
  return {center.array() - half, center.array() + half};
}

template <class S>
auto position_of(const auto& simulation) {
  return [&](std::uint32_t body) ->
         typename S::Vector { return simulation.bodies().pose[body].position; };
}

}  // namespace

TEST_CASE_TEMPLATE("pairs across the boundary are those of all images", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  PeriodicCell<S> cell;
  cell.set(0, -1, 3);
  cell.set(S::dim - 1, 2, 5);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(-12, 12), size(0.05, 0.6);
  std::vector<Aabb<S>> boxes;
  for (int k = 0; k < 60; ++k) {
    Vector center;
    for (int axis = 0; axis < S::dim; ++axis) center[axis] = anywhere(random);
    boxes.push_back(box_at<S>(center, size(random)));
  }
  moreau::ImagePairs<S> images;
  moreau::SweepAndPrune<S> broad_phase;
  std::vector<IndexPair> pairs, expected;
  std::vector<Vector> shifts;
  images.find_pairs(cell, std::span<const Aabb<S>>(boxes), broad_phase, pairs, shifts);
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      const Vector a = (boxes[i].lower + boxes[i].upper) / 2;
      const Vector b = (boxes[j].lower + boxes[j].upper) / 2;
      const double half = (boxes[j].upper - boxes[j].lower)[0] / 2;
      if (boxes[i].overlaps(box_at<S>(cell.nearest(b, a), half))) expected.push_back({i, j});
    }
  REQUIRE(pairs == expected);
  REQUIRE(shifts.size() == pairs.size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    Aabb<S> second = boxes[pairs[p].second];
    second.lower += shifts[p];
    second.upper += shifts[p];
    CHECK(second.overlaps(boxes[pairs[p].first].inflated(1e-12)));
    CHECK((cell.wrap(shifts[p] + cell.lower()) - cell.lower()).norm() < 1e-9);
  }
}

TEST_CASE_TEMPLATE("a periodic packing knows no origin", ShapeT, Polyhedron<>, Polygon<>,
                   Sphere<Space<3>>, Sphere<Space<2>>) {
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
  for (int k = 0; k < rounds(200); ++k) {
    open.simulation.step(5e-4);
    wide.simulation.step(5e-4);
  }
  using Twist = typename Layers<ShapeT>::S::Twist;
  const auto& a = open.simulation.bodies().velocity;
  const auto& b = wide.simulation.bodies().velocity;
  CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(Twist)) == 0);
  CHECK(open.simulation.contacts().size() > 4);
}

TEST_CASE_TEMPLATE("gas in a cell periodic along all axes: momentum and energy stay", ShapeT,
                   Polyhedron<>, Polygon<>, Sphere<Space<3>>, Sphere<Space<2>>) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  scenes::World<ShapeT> gas(0.02, moreau::Materials<Law>(1, Law(0.3, 0.9)));
  std::mt19937_64 random(11);
  std::normal_distribution<double> speed(0, 0.5);
  const int side = S::dim == Space<2>::dim ? 5 : 3;
  for (int axis = 0; axis < S::dim; ++axis) gas.set_periodic(axis, -0.01, -0.01 + 0.03 * side);
  const auto shape = gas.add_shape(grain_of_radius<ShapeT>(0.008));
  for (int k = 0; k < std::pow(side, int(S::dim)); ++k) {
    Pose<S> pose;
    Vector velocity;
    for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side) {
      pose.position[axis] = 0.03 * (rest % side);
      velocity[axis] = speed(random);
    }
    gas.set_velocity(gas.add_grain(shape, pose, 1000), velocity);
  }
  const auto momentum = [&] {
    Vector sum = Vector::Zero();
    for (std::size_t k = 0; k < gas.grain_count(); ++k)
      sum += gas.bodies().weight[k] * gas.bodies().velocity[k].template head<S::dim>();
    return sum;
  };
  const Vector before = momentum();
  double scale = 0, lost = 0;
  for (std::size_t k = 0; k < gas.grain_count(); ++k)
    scale += gas.bodies().weight[k] * gas.bodies().velocity[k].norm();
  std::size_t points = 0, elsewhere = 0;
  for (int k = 0; k < rounds(1000); ++k) {
    const auto report = gas.step(2e-4);
    points += report.points;
    lost += report.dissipation;
  }
  CHECK((momentum() - before).norm() < 1e-13 * scale);
  CHECK(points > 100);
  CHECK(lost > 0);
  for (const auto& pose : gas.bodies().pose)
    elsewhere += (gas.cell().wrap(pose.position) - pose.position).norm() > 1e-9;
  CHECK(elsewhere > gas.grain_count() / 3);
}

TEST_CASE_TEMPLATE("two grains hunt each other around the cell", ShapeT, Sphere<Space<3>>,
                   Sphere<Space<2>>) {
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
  // Each impact hands the velocity on. The first path is 0.3 long, the others all that is free on
  // the ring, 1 - 2 widths.
  int impacts = 0;
  bool runs = true;
  while (ring.time() < 20) {
    ring.step(h);
    const bool now = ring.bodies().velocity[runner.index()][0] > v / 2;
    impacts += now != runs;
    runs = now;
  }
  CHECK(std::abs(impacts - (1 + (20 - 0.3) / 0.6)) <= 1);
  const double travelled = ring.bodies().pose[runner.index()].position[0] - 0.2 +
                           ring.bodies().pose[target.index()].position[0] - 0.7;
  CHECK(travelled == doctest::Approx(20 * v).epsilon(1e-9));
  CHECK(ring.bodies().pose[runner.index()].position[0] > 8);
}

TEST_CASE_TEMPLATE("measures see contacts across the boundary", ShapeT, Sphere<Space<3>>,
                   Sphere<Space<2>>) {
  // A chain of three balls that closes through the boundary, squeezed by a shorter cell.
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  const double h = 1e-3, radius = 0.1, overlap = 1e-4;
  moreau::OverlapCorrectionOptions off;
  off.enabled = false;
  scenes::World<ShapeT> ring(0.2, moreau::Materials<Law>(1, Law(0.3)),
                             moreau::ColouredGaussSeidel(), {}, off);
  const double length = 3 * (2 * radius - overlap);
  ring.set_periodic(0, 0, length);
  const auto shape = ring.add_shape(ShapeT(radius));
  for (int k = 0; k < 3; ++k) {
    Pose<S> pose;
    pose.position[0] = 0.05 + (k - 4) * length / 3;  // outside of the cell
    ring.add_grain(shape, pose, 1000);
  }
  // Each pushes on the next: the velocities close all three contacts.
  ring.step(h);
  REQUIRE(ring.contacts().size() == 3);
  auto contacts = ring.contacts();
  for (Vector& impulse : contacts.impulses) impulse = 2 * Vector::UnitX();
  const auto is_grain = [](std::uint32_t) { return true; };
  Aabb<S> volume;
  volume.lower.setConstant(-0.5);
  volume.upper.setConstant(0.5);
  volume.lower[0] = 0.3;  // not the cell's own bounds
  volume.upper[0] = 0.3 + length;
  const auto stress =
      moreau::contact_stress(contacts, h, volume, position_of<S>(ring), is_grain, ring.cell());
  // A chain that carries the force f: f per cross-section.
  CHECK(stress(0, 0) == doctest::Approx(2 / h));
  moreau::CoordinationCounter<S> counter;
  CHECK(counter.count(contacts.points, contacts.impulses, 3, is_grain).neighbours == 2);
  std::vector<moreau::ContactSegment<S>> segments;
  moreau::force_chains(contacts, h, position_of<S>(ring), is_grain, segments, ring.cell());
  REQUIRE(segments.size() == 3);
  for (const auto& segment : segments) {
    CHECK((segment.to - segment.from).norm() == doctest::Approx(length / 3));
    CHECK((segment.from - segment.point).norm() < radius);
    CHECK((segment.to - segment.point).norm() < radius);
  }
  moreau::VelocityField<S> field(volume, 3, 1);
  for (std::uint32_t k = 0; k < 3; ++k)
    field.add(ring.bodies().pose[k].position, Vector::UnitX(), ring.cell());
  for (std::size_t column = 0; column < 3; ++column) CHECK(field.sample(column, 0).grains == 1);
}

TEST_CASE("bad cells are named") {
  using S = Space<3>;
  scenes::World<Sphere<S>> world(0.02, moreau::Materials<Law>(1));
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
  const auto large = world.add_shape(Sphere<S>(0.025)), small = world.add_shape(Sphere<S>(0.02));
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
