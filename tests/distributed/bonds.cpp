// SPDX-License-Identifier: MIT
// Bonds, bridges and cohesion over several processes: the motion is that of one process, bonds and breakages move with
// their grains, also through a restart over the processes.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"

#include "distributed/worlds.hpp"

using namespace distributed_test;

namespace {

using Glue = Bonded<>;
using SoftGlue = Compliant<Bonded<>>;
using SoftSticky = Compliant<Cohesive<Rigid>>;
using SoftWet = Compliant<Bridged<CapillaryBridge<>, Rigid>>;

/// A block of grains that touch, turned against the floor that it falls on; grains bonded in rows, with springs all
/// that touch. Half of the block is faster, so that it tears.
/// @param height of the lowest grain above the floor [m]
/// @param seed   of the differences of their velocities
template <class ShapeT, class Law>
Simulation<ShapeT, Law> block(const Law& law, double speed, double height, unsigned seed = 3) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  ColouredOptions options;
  options.tolerance = 1e-12;
  options.max_sweeps = 20000;
  Tolerances tolerances;
  tolerances.narrows = false;
  Simulation<ShapeT, Law> world(size, Materials<Law>(1, law), ColouredGaussSeidel(options),
                                tolerances);
  OverlapCorrectionOptions correction;
  correction.enabled = false;
  world.set_correction(correction);
  if (rank() != 0) return world;
  const ShapeId shape = world.add_shape(ShapeT(size / 2));
  const int side = S::dim == 2 ? 7 : 4, count = S::dim == 2 ? side * side : side * side * side;
  const auto turn = S::exp(S::Angular::Constant(0.4));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  std::vector<BodyId> grains;
  for (int k = 0; k < count; ++k) {
    Vector x = Vector::Zero(), v = Vector::Zero();
    for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= side)
      x[axis] = size * (rest % side);
    grains.push_back(world.add_grain(shape, Pose<S>(turn * x), 2700));
    for (int axis = 0; axis < S::dim; ++axis) v[axis] = speed * noise(random);
    v[S::dim - 1] -= speed;
    v[0] += k % side < side / 2 ? 0.0 : speed;
    world.set_velocity(grains.back(), v);
  }
  const Vector up = Vector::Unit(S::dim - 1);
  double lowest = 0;
  for (const BodyId grain : grains) lowest = std::min(lowest, world.pose(grain).position.dot(up));
  world.add_wall(up, Vector((lowest - height) * up));
  if constexpr (CompliantLaw<Law, S> && BondingLaw<Law, S>) {
    world.bond_touching(1e-6);
  } else if constexpr (BondingLaw<Law, S>) {
    for (int k = 0; k < count; ++k)
      if (k % side != 0) world.bond(grains[std::size_t(k - 1)], grains[std::size_t(k)]);
  }
  return world;
}

/// Compares some steps with those of one process; in the middle the simulation is gathered and distributed again.
/// @returns on rank 0 the simulation at the end
template <class World>
std::optional<World> check_motion(const World& scene, int steps) {
  constexpr bool bonds = BondingLaw<LawIn<World>, typename World::S>;
  World alone = scene;
  std::optional<World> result;
  std::size_t redistributions = 0, broken = 0;
  std::optional<DistributedSimulation<World>> packing;
  packing.emplace(MPI_COMM_WORLD, scene);
  double scale = 0, worst = 0, fracture = 0;
  for (int k = 0; k < steps; ++k) {
    if (k == steps / 2) {
      redistributions += packing->distribution().redistributions;
      std::optional<World> whole = packing->gather();
      packing.emplace(MPI_COMM_WORLD, whole ? *whole : scene);
    }
    const StepReport report = packing->step(step);
    result = packing->gather();
    if (!result) continue;
    const StepReport expected = alone.step(step);
    CHECK(report.points == expected.points);
    CHECK(report.bonds == expected.bonds);
    CHECK(report.broken_bonds == expected.broken_bonds);
    broken += expected.broken_bonds;
    fracture += report.fracture - expected.fracture;
    scale += expected.fracture;
    for (const BodyId grain : alone.grains())
      worst = std::max(worst, (alone.pose(grain).position - result->pose(grain).position).norm());
    if constexpr (bonds) {
      REQUIRE(result->bonds().size() == alone.bonds().size());
      for (std::size_t i = 0; i < alone.bonds().size(); ++i) {
        const auto &mine = result->bonds()[i], &other = alone.bonds()[i];
        CHECK(mine.a == other.a);
        CHECK(mine.b == other.b);
        CHECK(mine.strength_left == doctest::Approx(other.strength_left).epsilon(1e-5));
      }
    }
  }
  redistributions += packing->distribution().redistributions;
  if (!result) return result;
  CHECK(redistributions > 5);
  CHECK(worst < 1e-6 * size);
  CHECK(std::abs(fracture) <= 1e-5 * scale);
  if constexpr (bonds) {
    CHECK(broken > 3);
    REQUIRE(result->breakages().size() == alone.breakages().size());
    for (std::size_t i = 0; i < alone.breakages().size(); ++i) {
      const Breakage &mine = result->breakages()[i], &other = alone.breakages()[i];
      CHECK(mine.time == doctest::Approx(other.time));
      CHECK(std::pair(mine.a, mine.b) == std::pair(other.a, other.b));
    }
  }
  MESSAGE(ranks(), " processes: largest difference ", worst / size, " diameters, ", broken,
          " bonds broke, ", redistributions, " redistributions");
  return result;
}

/// To distribute and to gather leaves the state as it is, after steps of several lengths and with materials that were
/// replaced after the last of them.
/// @param replacing law of the steps to come
template <class World>
void check_round_trip(const World& scene, const LawIn<World>& replacing) {
  World start = scene;
  if (rank() == 0)
    for (int k = 0; k < 60; ++k) start.step(k % 20 < 10 ? step : step / 20);
  start.set_materials(Materials<LawIn<World>>(1, replacing));
  DistributedSimulation<World> packing(MPI_COMM_WORLD, start);
  std::optional<World> whole = packing.gather();
  if (!whole) return;
  for (const double factor : {0.0, 0.2, 1.0}) {
    if (factor > 0) {
      whole->step(factor * step);
      start.step(factor * step);
    }
    CHECK(state(*whole) == state(start));
  }
  if constexpr (BondingLaw<LawIn<World>, typename World::S>) {
    CHECK(start.bonds().size() > 3);
    CHECK(start.breakages().size() > 0);
  }
}

}  // namespace

TEST_CASE("Rigid bonds over processes hold and break as in one") {
  check_motion(block<Disk<>>(Glue({3e3, 2e3, 2e3}, 0.4), 1, 2.6 * size), 120);
}

// While a bond is at its strength, its impulses can move along a line, by the same amount in each sweep, until another limit
// is reached. Phases of acceleration of constant length began this motion anew each time.
TEST_CASE("Rigid bonds that break are solved, however the motion of the grains differs") {
  long sweeps = 0;
  int most = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    DistributedSimulation<Simulation<Disk<>, Glue>> packing(
        MPI_COMM_WORLD, block<Disk<>>(Glue({3e3, 2e3, 2e3}, 0.4), 1, 2.6 * size, seed));
    const StepReport report = packing.step(step);
    CAPTURE(seed);
    CHECK(report.solve.converged);
    CHECK(report.broken_bonds > 3);
    sweeps += report.solve.sweeps;
    most = std::max(most, report.solve.sweeps);
  }
  if (rank() == 0) MESSAGE(ranks(), " processes: ", sweeps / 40, " sweeps, at most ", most);
}

TEST_CASE("Bonds with springs and a fracture energy soften and break over processes as in one") {
  check_motion(block<Ball<>>(SoftGlue(Glue({20, 15, 15, 2e-4}, 0.4), 1e5), 1, 0.7 * size), 120);
}

TEST_CASE("Bridges with springs form, hold and break over processes as in one") {
  const CapillaryBridge<> bridge(1e-9, 50);  // reaches farther than the margin
  const auto scene = block<Ball<>>(
      SoftWet(Bridged<CapillaryBridge<>, Rigid>(bridge, Rigid(0.4)), 1e5), 1, 0.7 * size);
  const auto result = check_motion(scene, 120);
  if (!result) return;
  CHECK(bridge.rupture_distance() > 1.5 * Tolerances().margin * size);
  std::size_t apart = 0;  // contacts that a bridge holds over a gap above the margin
  for (const auto& point : result->contacts().points)
    apart += point.gap > Tolerances().margin * size;
  CHECK(apart > 0);
}

TEST_CASE("Cohesion with springs holds, breaks and forms over processes as in one") {
  const auto scene = block<Ball<>>(SoftSticky(Cohesive<Rigid>(Rigid(0.4), 5), 1e5), 1, 0.7 * size);
  const auto result = check_motion(scene, 120);
  if (!result) return;
  std::size_t held = 0, broken = 0, formed = 0;  // pairs of grains; of a grain and the floor
  const auto grains = scene.grains();
  const auto distance = [&](const auto& world, std::size_t i, std::size_t k) {
    return (world.pose(grains[i]).position - world.pose(grains[k]).position).norm() / size;
  };
  for (std::size_t i = 0; i < grains.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (!(distance(scene, i, k) < 1.001)) continue;
      held += distance(*result, i, k) < 1.001;
      broken += distance(*result, i, k) > 1.05;  // beyond the margin
    }
  for (const auto& point : result->contacts().points) formed += point.b >= grains.size();
  CHECK(held > 30);
  CHECK(broken > 3);
  CHECK(formed > 3);
  MESSAGE(held, " pairs hold, ", broken, " broke, ", formed, " formed");
}

TEST_CASE("To distribute and to gather changes no memory of bonds, bridges and cohesion") {
  check_round_trip(block<Disk<>>(Glue({3e3, 2e3, 2e3}, 0.4), 1, 2.6 * size),
                   Glue({4e3, 3e3, 3e3}, 0.3));
  check_round_trip(block<Ball<>>(SoftGlue(Glue({20, 15, 15, 2e-4}, 0.4), 1e5), 1, 0.7 * size),
                   SoftGlue(Glue({30, 20, 20, 2e-4}, 0.3), 2e5));
  const CapillaryBridge<> bridge(1e-9, 50);
  using Wet = Bridged<CapillaryBridge<>, Rigid>;
  check_round_trip(block<Ball<>>(SoftWet(Wet(bridge, Rigid(0.4)), 1e5), 1, 0.7 * size),
                   SoftWet(Wet(CapillaryBridge<>(1e-9, 40), Rigid(0.3)), 1e5));
  check_round_trip(block<Ball<>>(SoftSticky(Cohesive<Rigid>(Rigid(0.4), 5), 1e5), 1, 0.7 * size),
                   SoftSticky(Cohesive<Rigid>(Rigid(0.4), 3), 1e5));
}
