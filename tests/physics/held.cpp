// SPDX-License-Identifier: MIT
// Blocks in a row between two flat walls, one of which is pressed. Friction alone holds them. Of the pressures that solve
// the rigid problem most lie off the centre and turn the blocks about the normal of the walls; the even one does not.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

#include "sanitized.hpp"
#include "world/assemblies.hpp"

namespace {

using moreau::Polygon;
using moreau::Polyhedron;
constexpr double size = 0.1, weight = 9.81, friction = 0.5;

/// A row of cubes, in the plane squares, along x.
template <class ShapeT>
struct Row {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  scenes::World<ShapeT> world{
      T(size), moreau::Materials<scenes::LawOf<ShapeT>>(1, scenes::LawOf<ShapeT>(T(friction)))};
  moreau::BodyId wall;
  double force = 0;  ///< on the wall by which the row just does not slide [N]

  explicit Row(int count, double wall_mass = 1) {
    const auto cube = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(size / 2))));
    for (int k = 0; k < count; ++k)
      world.add_grain(cube, {Vector(Vector::UnitX() * T(size * (k + 0.5)))}, T(1000));
    world.add_wall(Vector::UnitX(), Vector::Zero());
    wall = world.add_wall(-Vector::UnitX(), Vector(Vector::UnitX() * T(size * count)));
    world.set_wall_mass(wall, T(wall_mass));
    for (const auto grain : world.grains())
      force += double(world.bodies().grain_mass[grain.index()]) * weight / (2 * friction);
  }
  /// Steps under a share of the force and of gravity.
  void run(int steps, double h, double of_force, double of_gravity) {
    world.set_force(wall, Vector(-Vector::UnitX() * T(of_force * force)));
    world.set_gravity(Vector(-Vector::Unit(up) * T(of_gravity * weight)));
    for (int k = 0; k < steps; ++k) CHECK(world.step(T(h)).solve.converged);
  }
  /// The largest fall of a block [m], and the largest turn [rad].
  void check(double fall, double turn) const {
    double fallen = 0, turned = 0;
    for (const auto grain : world.grains()) {
      const auto& pose = world.pose(grain);
      fallen = std::max(fallen, -double(pose.position[up]));
      turned = std::max(turned,
                        double((pose.rotation.toRotationMatrix() - S::Matrix::Identity()).norm()));
    }
    CHECK(fallen <= fall);
    CHECK(turned <= turn);
  }
};

}  // namespace

TEST_CASE_TEMPLATE("blocks that friction alone holds between flat walls stay", ShapeT, Polyhedron<>,
                   Polygon<>) {
  for (const int count : {1, 2, 3, 6})
    for (const double h : {1e-3, 1.0 / 60})
      for (const double share : {1.02, 1.09}) {
        CAPTURE(count);
        CAPTURE(h);
        CAPTURE(share);
        const int steps = rounds(static_cast<int>(std::lround(0.5 / h)));
        Row<ShapeT> at_once(count);
        at_once.run(steps, h, share, 1);
        at_once.check(1e-3 * size, 1e-3);
        Row<ShapeT> slowly(count);
        for (int k = 1; k <= 20; ++k) slowly.run(1, h, share * k / 20, 0);
        slowly.run(steps, h, share, 1);
        slowly.check(1e-3 * size, 1e-3);
      }
}

// Where the row slides, the blocks may be turned a little by then: nothing turns them back.
TEST_CASE_TEMPLATE("blocks that slide between flat walls fall straight", ShapeT, Polyhedron<>,
                   Polygon<>) {
  constexpr double share = 0.9, duration = 0.4;
  for (const int count : {1, 2, 6})
    for (const double h : {1e-3, 1.0 / 60}) {
      CAPTURE(count);
      CAPTURE(h);
      Row<ShapeT> row(count);
      const int steps = static_cast<int>(std::lround(duration / h));
      row.run(steps, h, share, 1);
      const double speed = weight * (1 - share) * steps * h;
      for (const auto grain : row.world.grains())
        CHECK(-double(row.world.velocity(grain)[Row<ShapeT>::up]) ==
              doctest::Approx(speed).epsilon(1e-3));
      row.check(size, 3e-3);
    }
}
