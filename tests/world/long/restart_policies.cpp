// SPDX-License-Identifier: MIT
// Restarts with every kind of stored state that a law, a shape or a boundary has.
#include <doctest/doctest.h>

#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/io/snapshot.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/moreau.hpp"
#include "moreau/parallel/thread_team.hpp"

using namespace moreau;

namespace {

using Plane = Space<2>;
using Vector = Plane::Vector;

Polygon<> square(double side) {
  const std::vector<Vector> corners{{0, 0}, {side, 0}, {side, side}, {0, side}};
  return Polygon<>(corners);
}
template <class ShapeT>
ShapeT grain(int) {
  return ShapeT(0.01);
}
template <>
CapsuleIn<Plane> grain(int k) {
  return CapsuleIn<Plane>(0.004 + 0.001 * (k % 3), 0.004);
}
using Mixed = OneOf<Disk<>, Polygon<>, CapsuleIn<Plane>, Rounded<Polygon<>>>;
template <>
Mixed grain(int k) {
  switch (k % 4) {
    case 0:
      return Disk<>(0.009);
    case 1:
      return square(0.015);
    case 2:
      return CapsuleIn<Plane>(0.005, 0.004);
    default:
      return Rounded<Polygon<>>(square(0.01), 0.003);
  }
}

/// Grains that fall onto a moving floor or into a cylinder; optionally periodic along x.
template <class World>
void build(World& world, bool periodic) {
  using ShapeT = std::remove_cvref_t<decltype(world.shape_of_grain(0))>;
  for (int k = 0; k < 16; ++k) {
    const ShapeId shape = world.add_shape(grain<ShapeT>(k));
    Pose<Plane> pose{{0.013 + 0.025 * (k % 4) + 0.001 * (k % 3), 0.015 + 0.022 * (k / 4)},
                     Eigen::Rotation2D<double>(0.7 * k)};
    world.add_grain(shape, pose, 2000, MaterialId(std::size_t(k % 2)));
  }
  if (periodic) {
    world.add_wall({0, 1}, {0, 0});
    world.set_periodic(0, 0, 0.104);
    world.set_velocity(world.walls()[0], {0.05, 0});
  } else {
    const BodyId drum = world.add_cylinder({0.05, 0.06}, Plane::Angular(1), 0.085);
    world.set_spin(drum, Plane::Angular(2));
  }
  world.set_gravity({0.5, -9.81});
}

template <class ShapeT, class Law, class Integrator, class Broad, class Solver>
void check(Simulation<ShapeT, Law, Integrator, Broad, Solver> world, double step, int steps) {
  for (const bool periodic : {false, true}) {
    auto one = world, other = world;
    build(one, periodic);
    for (int k = 0; k < steps; ++k) one.step(step);
    restore_snapshot(snapshot(one), other);
    REQUIRE(snapshot(other) == snapshot(one));
    std::size_t points = 0;
    for (int k = 0; k < steps; ++k) points += one.step(step).points;
    for (int k = 0; k < steps; ++k) other.step(step);
    CHECK(snapshot(other) == snapshot(one));
    CHECK(points > std::size_t(10 * steps));
  }
}
template <class Law>
Materials<Law> two(const Law& first, const Law& second) {
  Materials<Law> materials(2, first);
  materials.set(MaterialId(1), MaterialId(1), second);
  return materials;
}

}  // namespace

TEST_CASE("static friction, of disks, capsules and mixtures") {
  using Law = SignoriniCoulomb<>;
  const auto laws = two(Law(0.3, 0.2, 0.5), Law(0.1));
  check(Simulation<Disk<>, Law>(0.01, laws), 5e-4, 400);
  check(Simulation<CapsuleIn<Plane>, Law>(0.01, laws), 5e-4, 400);
  check(Simulation<Mixed, Law>(0.01, laws), 5e-4, 400);
}

TEST_CASE("springs, whose tangential stretch is remembered") {
  using Spring = LinearSpringDashpot<>;
  check(
      Simulation<Disk<>, Spring>(0.01, two(Spring(1e5, 5e4, 0.4, 0.5), Spring(2e5, 1e5, 0.2, 0.3))),
      2e-5, 4000);
  using Hertz = HertzMindlin<>;
  check(Simulation<Disk<>, Hertz>(0.01, Materials<Hertz>(2, Hertz(1e7, 5e6, 0.4, 0.3))), 2e-5,
        4000);
}

TEST_CASE("cohesion and rolling resistance") {
  using Sticky = Cohesive<SignoriniCoulomb<>>;
  check(
      Simulation<Disk<>, Sticky>(0.01, Materials<Sticky>(2, Sticky(SignoriniCoulomb<>(0.3), 0.5))),
      5e-4, 400);
  using Rolling = RollingResistance<>;
  check(Simulation<Disk<>, Rolling>(0.01, Materials<Rolling>(2, Rolling(0.4, 0.1))), 5e-4, 400);
}

TEST_CASE("the number of threads is not in a snapshot") {
  using Law = SignoriniCoulomb<>;
  const Materials<Law> laws(2, Law(0.4));
  // Other broad phases and solvers than the defaults may be compiled in a different translation
  // unit with different flags.
  using World = Simulation<Disk<>, Law, MoreauJean, CellGrid<Plane>>;
  World alone(0.01, laws), team(0.01, laws);
  team.set_team(ThreadTeam(2));
  build(alone, false);
  for (int k = 0; k < 300; ++k) alone.step(5e-4);
  restore_snapshot(snapshot(alone), team);
  for (int k = 0; k < 300; ++k) {
    alone.step(5e-4);
    team.step(5e-4);
  }
  CHECK(snapshot(team) == snapshot(alone));
}
