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
constexpr double weight = 9.81, friction = 0.5;

/// A row of cubes, in the plane squares, along x.
template <class ShapeT>
struct Row {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;

  double size;  ///< of a block [m]
  scenes::World<ShapeT> world{
      T(size), moreau::Materials<scenes::LawOf<ShapeT>>(1, scenes::LawOf<ShapeT>(T(friction)))};
  moreau::BodyId wall;
  double force = 0;  ///< on the wall by which the row just does not slide [N]

  explicit Row(int count, double wall_mass = 1, double of_size = 0.1) : size(of_size) {
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
  /// The moment of the pressures of a pair of bodies about the middle of their face, at most, relative to their sum and the
  /// size: about the vertical, which lies in the face.
  double largest_unevenness() const {
    const auto& contacts = world.contacts();
    double largest = 0;
    for (std::size_t first = 0, last; first < contacts.size(); first = last) {
      last = moreau::detail::end_of_pair(contacts, first);
      double sum = 0, moment = 0;
      for (std::size_t c = first; c < last; ++c) {
        const double pressure = double(contacts.impulses[c][0]);
        sum += pressure;
        moment += pressure * double(contacts.points[c].lever_a[1]);
      }
      if (sum > 0) largest = std::max(largest, std::abs(moment) / (sum * size));
    }
    return largest;
  }
  /// The largest fall of a block, in sizes [-], and the largest turn [rad].
  void check(double fall, double turn) const {
    double fallen = 0, turned = 0;
    for (const auto grain : world.grains()) {
      const auto& pose = world.pose(grain);
      fallen = std::max(fallen, -double(pose.position[up]));
      turned = std::max(turned,
                        double((pose.rotation.toRotationMatrix() - S::Matrix::Identity()).norm()));
    }
    CHECK(fallen <= fall * size);
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
        at_once.check(1e-3, 1e-3);
        Row<ShapeT> slowly(count);
        for (int k = 1; k <= 20; ++k) slowly.run(1, h, share * k / 20, 0);
        slowly.run(steps, h, share, 1);
        slowly.check(1e-3, 1e-3);
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
      row.check(1, 3e-3);
    }
}

// The gaps of the points have the rounding of positions and what errors of velocities have left, 1e-15 to 1e-10 of the size.
// The motions that close them contradict each other; the pressure must not follow from that.
TEST_CASE_TEMPLATE(
    "the pressure of a row that slides is even, whatever the mass of the wall and the size", ShapeT,
    Polyhedron<>) {
  struct Case {
    int count;
    double h, mass, share, size;  // of the wall in kg/(0.1 m)^3; of the force
  };
  for (const auto& one : {Case{2, 1e-3, 1e3, 0.9, 1}, Case{2, 1e-3, 1e3, 0.5, 0.01},
                          Case{2, 1.0 / 60, 1e-3, 0.5, 0.01}, Case{3, 1e-3, 1e-3, 0.99, 0.1},
                          Case{3, 1e-3, 1e3, 0.5, 0.01}, Case{3, 1.0 / 60, 1, 0.5, 0.01},
                          Case{6, 1.0 / 60, 1e-3, 0.5, 0.01}, Case{6, 1.0 / 60, 1e-2, 0.5, 0.01}}) {
    // Not a structured binding, which lambdas of clang++ 14 do not capture.
    const int count = one.count;
    const double h = one.h, mass = one.mass, share = one.share, size = one.size;
    CAPTURE(count);
    CAPTURE(h);
    CAPTURE(mass);
    CAPTURE(size);
    Row<ShapeT> row(count, mass * std::pow(size / 0.1, 3), size);
    const int steps = rounds(static_cast<int>(std::lround(0.3 / h)));
    row.run(steps, h, share, 1);
    CHECK(row.largest_unevenness() < 1e-3);
    for (const auto grain : row.world.grains())
      CHECK(-double(row.world.velocity(grain)[Row<ShapeT>::up]) ==
            doctest::Approx(weight * (1 - share) * steps * h).epsilon(1e-6));
    row.check(100, 1e-5);
  }
}

// A pad can move along the squeeze only, so that any share of it between the ends of the plank is in balance; most of them
// turn the plank. Under tolerances near rounding the direct method ends in rounding. Its even pressures shall be taken
// nevertheless, and not those of the sweeps, which also solve the problem.
TEST_CASE_TEMPLATE("a plank between light pads does not swing down, however small the tolerance",
                   ShapeT, Polyhedron<>, Polygon<>) {
  using S = moreau::SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = scenes::LawOf<ShapeT>;
  constexpr int up = S::dim - 1, along = S::dim == 3 ? 1 : up;
  for (const double ratio : {1e-3, 0.1, 1.0})
    for (const double tolerance : {0.0, 1e-8, 1e-10, 1e-12, 1e-13})
      for (int k = 0; k < rounds(12); ++k) {
        const double size = std::pow(10, 0.7 * k - 5.5), share = 1e-3 * std::pow(10, k % 4 / 3.0),
                     load = 1.1 * std::pow(10, k % 5 / 2.5), h = share * std::sqrt(size / weight);
        CAPTURE(ratio);
        CAPTURE(tolerance);
        CAPTURE(k);
        scenes::World<ShapeT> world(T(size), moreau::Materials<Law>(1, Law(T(0.7))));
        moreau::ColouredOptions options;
        if (tolerance > 0) options.tolerance = options.velocity_tolerance = tolerance;
        if (tolerance > 0) options.max_sweeps = 2000;
        world.set_solver(moreau::ColouredGaussSeidel(options));
        world.set_gravity(Vector(-Vector::Unit(up) * T(weight)));
        Vector half = Vector::Constant(T(size / 2));
        half[along] *= T(5);
        const auto plank =
            world.add_grain(world.add_shape(scenes::cuboid<ShapeT>(half)), {}, T(1000));
        const auto mass = double(world.bodies().grain_mass[plank.index()]);
        for (const double side : {-1.0, 1.0}) {
          const Vector out = Vector::UnitX() * T(side);
          const auto pad = world.add_wall(Vector(-out), Vector(out * T(size / 2)));
          world.set_wall_mass(pad, T(ratio * mass));
          world.set_force(pad, Vector(-out * T(load * mass * weight)));
        }
        for (int step = 0; step < 3; ++step)
          CHECK((world.step(T(h)).solve.converged || tolerance > 0));
        const double fall = double(world.velocity(plank).norm()),
                     turn = double(world.spin(plank).norm()) * size;
        CHECK(fall + turn < 1e-4 * weight * h);
      }
}
