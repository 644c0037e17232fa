// SPDX-License-Identifier: MIT
// Small scenes whose answer is known, each in many variants: direction, shape, size, order of the bodies, step, in
// space and in the plane, in double and single precision, at default options.
#include "physics/kinds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include "physics/rows.hpp"
#include "rotation_between.hpp"
#include "sanitized.hpp"

using namespace kinds;

// Friction times the height of the centre is less than the distance to the nearest side: the reaction of the floor
// passes through the face.
TEST_CASE_TEMPLATE("kinds: a prism that lands flat while it flies along the floor does not turn",
                   ShapeT, Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937 random(5);
  for (int variant = 0; variant < 48; ++variant) {
    const int sides = 3 + variant % 6;
    const double size = std::pow(10.0, variant % 4 - 2);  // [m], 0.01 to 10
    const double height = (sides < 5 ? 0.15 : 0.3) * size;
    std::vector<double> half{size, 0.6 * size, height};
    if (!in_space<ShapeT>) half = {size, height};
    const typename S::Rotation tilt = tilt_to<S>(random, variant % 3 != 0);
    const Vector up = tilt * Vector::Unit(S::dim - 1);
    World<ShapeT> world = world_of<ShapeT>(size, 0.3, up);
    const auto floor = [&] {
      if (variant % 2 == 0) {
        world.add_wall(up, Vector::Zero());
        return;
      }
      Vector plate = Vector::Constant(T(20 * size));
      plate[S::dim - 1] = T(size);
      const auto shape = world.add_shape(scenes::cuboid<ShapeT>(plate));
      world.prescribe_motion(world.add_grain(shape, {Vector(-T(size) * up), tilt}, T(1000)));
    };
    const bool first = variant % 4 < 2;
    if (first) floor();
    const typename S::Rotation turn = S::exp(about_up<S>(0.7 * variant));
    const auto grain = world.add_grain(world.add_shape(prism<ShapeT>(sides, half, random)),
                                       {Vector(T(height * 1.0001) * up), tilt * turn}, T(2000));
    if (!first) floor();
    // As fast, in sizes, for each size.
    const double unit = std::sqrt(weight * size);
    const double angle = in_space<ShapeT> ? 2 * pi * variant / 17 : (variant % 5 < 2 ? 0 : pi);
    Vector along = Vector::Zero();
    along[0] = T(std::cos(angle));
    if (in_space<ShapeT>) along[1] = T(std::sin(angle));
    world.set_velocity(grain,
                       tilt * Vector(T(3 * unit) * along - T(unit) * Vector::Unit(S::dim - 1)));
    double spin = 0;
    int unsolved = 0;
    for (int k = 0; k < rounds(500); ++k) {
      unsolved += !world.step(T(1e-3 * size / unit)).solve.converged;
      spin = std::max(spin, double(world.spin(grain).norm()));
    }
    CAPTURE(variant);
    CHECK(unsolved == 0);
    CHECK(spin * size < bound<ShapeT>(1e-5, 1e-3) * unit);
    const Vector way = tilt.inverse() * world.pose(grain).position;
    const Vector aside = way - along * way.dot(along) - T(height) * Vector::Unit(S::dim - 1);
    CHECK(double(way.dot(along)) > 0.5 * size);
    CHECK(double(aside.norm()) < bound<ShapeT>(2e-4, 2e-3) * size);
  }
}

// The pressure of a face that slides is even: friction gives no force while the face turns about its centre.
TEST_CASE_TEMPLATE("kinds: a prism that lands flat and spins about the vertical stays in its place",
                   ShapeT, Polyhedron<>, Polyhedron<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937 random(7);
  for (int variant = 0; variant < 40; ++variant) {
    // A base with an odd number of sides is not symmetric: its pressure has a force of friction in truth.
    const int sides = 4 + 2 * (variant % 5);
    const double size = variant % 3 == 0 ? 0.7 : 0.07, spin = variant % 2 == 0 ? 150 : -20;
    const double height = size * (variant % 4 == 0 ? 0.3 : 0.57);
    World<ShapeT> world = world_of<ShapeT>(2 * size, 0.4, Vector::UnitZ());
    world.add_wall(Vector::UnitZ(), Vector::Zero());
    const auto shape = world.add_shape(
        prism<ShapeT>(sides, {size, size * (variant % 7 == 0 ? 1 : 0.57), height}, random));
    const auto grain = world.add_grain(
        shape, {Vector(0, 0, T(height * 1.0001)), S::exp(about_up<S>(0.3 * variant))}, T(1000));
    world.set_velocity(grain, Vector(0, 0, T(-0.5)));
    world.set_spin(grain, about_up<S>(spin));
    const double h = variant % 8 < 4 ? 1e-3 : 2e-4;
    int unsolved = 0;
    double drift = 0;
    for (int k = 0; k < rounds(int(0.16 / h)); ++k) {
      unsolved += !world.step(T(h)).solve.converged;
      drift = std::max(drift, double(world.pose(grain).position.template head<2>().norm()));
    }
    CAPTURE(variant);
    CHECK(unsolved == 0);
    CHECK(drift < bound<ShapeT>(1e-3, 1e-2) * size);  // under uneven pressures up to 0.05 of it
  }
}

// The force on the wall holds less than the weight. The wall is from a thousandth to a thousand times as heavy as a block: its
// velocity without contacts is up to some hundred m/s, and the blocks fall with g h. In the plane some of the first steps of rows of three and six
// are not solved, and say so.
TEST_CASE_TEMPLATE("kinds: blocks that slide in a row between two walls do not turn", ShapeT,
                   Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1), across = Vector::UnitX();
  int variant = 0;
  for (const int count : {1, 2, 3, 6})
    for (const double h : {1e-3, 1.0 / 60})
      for (const double mass : {1e-3, 1e-2, 1.0, 1e3})
        for (const double share : {0.9, 0.5, 0.99}) {
          constexpr double sizes[] = {0.1, 1, 0.01};
          const double size = sizes[++variant % 3], friction = 0.5;
          World<ShapeT> world = world_of<ShapeT>(size, friction, up);
          const auto shape = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(size / 2))));
          double force = 0;
          for (int k = 0; k < count; ++k) {
            const auto grain =
                world.add_grain(shape, {Vector(T(size * (k + 0.5)) * across)}, T(1000));
            force += double(world.bodies().grain_mass[grain.index()]) * weight / (2 * friction);
          }
          world.add_wall(across, Vector::Zero());
          const auto wall = world.add_wall(-across, T(size * count) * across);
          world.set_wall_mass(wall, T(mass * std::pow(size / 0.1, S::dim)));
          world.set_force(wall, T(-share * force) * across);
          const int steps = rounds(int(0.3 / h));
          int unsolved = 0;
          for (int k = 0; k < steps; ++k) unsolved += !world.step(T(h)).solve.converged;
          CAPTURE(variant);
          CAPTURE(count);
          CHECK(unsolved <= (in_space<ShapeT> || count < 3 ? 0 : 10));
          if (unsolved > 0) continue;
          for (const auto grain : world.grains()) {
            CHECK(double((world.pose(grain).rotation.toRotationMatrix() - S::Matrix::Identity())
                             .norm()) < 1e-4);
            CHECK(-double(world.velocity(grain)[S::dim - 1]) ==
                  doctest::Approx(weight * (1 - share) * steps * h)
                      .epsilon(bound<ShapeT>(1e-4, 1e-3)));
          }
        }
}

// The same with random sizes, widths, masses, directions, steps and orders of the bodies. In single precision gaps that rounding
// leaves decided which points of a face bear the pressure: of 250 rows 21 turned by up to 1.8 rad without a word, and 7 were not solved.
TEST_CASE_TEMPLATE("kinds: random rows of blocks that slide between two walls do not turn", ShapeT,
                   Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using Vector = typename SpaceOf<ShapeT>::Vector;
  int unsolved_rows = 0;
  const auto check = [&](unsigned seed, double scale) {
    const rows::Result row = rows::slide<ShapeT>(
        seed,
        [](double size, double friction, const Vector& up) {
          return world_of<ShapeT>(size, friction, up);
        },
        scale);
    CAPTURE(seed);
    CAPTURE(scale);
    unsolved_rows += row.unsolved > 0;
    if (row.unsolved > 0) return;
    CHECK(row.turn < bound<ShapeT>(1e-4, 1e-3));
    CHECK(row.speed < bound<ShapeT>(1e-4, 1e-3));
  };
  for (unsigned seed = 1000; seed < 1080; ++seed) check(seed, 1);
  CHECK(unsolved_rows <= (in_space<ShapeT> ? 0 : 10));
  unsolved_rows = 0;
  if (is_double<ShapeT>) return;
  for (unsigned seed = 7000; seed < 7020; ++seed) check(seed, 1000);
  CHECK(unsolved_rows == 0);
}

// Single precision without friction: a light block under a heavy one is driven out within seconds (limits.md).
TEST_CASE_TEMPLATE("kinds: blocks of very different masses stand on each other", ShapeT,
                   Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  int variant = 0;
  for (const double ratio : {1e-3, 1e-2, 1e2, 1e3})
    for (const double friction : {0.0, 0.5})
      for (const double h : {1e-3, 1.0 / 60})
        for (const double size : {0.01, 1.0}) {
          ++variant;
          if (!is_double<ShapeT> && friction == 0 && ratio > 1) continue;
          if (h > 1e-3 && size < 0.1) continue;  // gravity moves by a quarter of the size in a step
          World<ShapeT> world = world_of<ShapeT>(size, friction, up);
          const auto shape = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(size / 2))));
          std::vector<BodyId> grains;
          if (variant % 3 == 0) world.add_wall(up, Vector::Zero());
          for (int k = 0; k < 2; ++k)
            grains.push_back(world.add_grain(shape, {Vector(T(size * (k + 0.5)) * up)},
                                             T(k == 0 ? 1000 : 1000 * ratio)));
          if (variant % 3 != 0) world.add_wall(up, Vector::Zero());
          int unsolved = 0;
          for (int k = 0; k < rounds(int(2 / h)); ++k)
            unsolved += !world.step(T(h)).solve.converged;
          CAPTURE(ratio);
          CAPTURE(friction);
          CAPTURE(h);
          CAPTURE(size);
          CHECK(unsolved == 0);
          for (int k = 0; k < 2; ++k)
            CHECK(double((world.pose(grains[std::size_t(k)]).position -
                          Vector(T(size * (k + 0.5)) * up))
                             .norm()) < 1e-3 * size);
        }
}

TEST_CASE_TEMPLATE("kinds: stacks stand", ShapeT, Polyhedron<>, Polygon<>, Polyhedron<float>,
                   Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  std::mt19937 random(3);
  for (const std::size_t count : {3u, 8u, 20u})
    for (const double size : {0.01, 1.0})
      for (const double friction : {0.3, 0.8})
        for (const double jitter : {0.0, 0.005}) {
          const double h = size < 0.1 ? 1e-3 : 1.0 / 60;
          World<ShapeT> world = world_of<ShapeT>(size, friction, up);
          const auto shape = world.add_shape(scenes::cuboid<ShapeT>(Vector::Constant(T(size / 2))));
          std::uniform_real_distribution<double> number(-jitter, jitter);
          std::vector<Vector> start;
          std::vector<std::size_t> order;
          for (std::size_t k = 0; k < count; ++k) {
            start.push_back(T(size * (double(k) + 0.5)) * up);
            for (int axis = 0; axis < S::dim - 1; ++axis) start[k][axis] = T(size * number(random));
            order.push_back(k);
          }
          std::shuffle(order.begin(), order.end(), random);
          for (const std::size_t k : order) world.add_grain(shape, {start[k]}, T(1000));
          world.add_wall(up, Vector::Zero());
          int unsolved = 0;
          for (int k = 0; k < rounds(1000); ++k) unsolved += !world.step(T(h)).solve.converged;
          CAPTURE(count);
          CAPTURE(size);
          CAPTURE(friction);
          CAPTURE(jitter);
          CHECK(unsolved == 0);
          double moved = 0;
          for (std::size_t k = 0; k < count; ++k)
            moved = std::max(
                moved, double((world.pose(world.grain(k)).position - start[order[k]]).norm()));
          CHECK(moved < 1e-3 * size);
        }
}
