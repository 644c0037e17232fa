// SPDX-License-Identifier: MIT
// Cylinders that are rollers under planks, and that lie in the groove of two others.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/cylinder.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

namespace {

using namespace moreau;

using S = Space<3>;
using Vector = S::Vector;
using Law = SignoriniCoulomb<double>;
using World = Simulation<OneOf<Cylinder<>, Polyhedron<>>, Law>;

const S::Rotation across = S::exp({0, 0, std::numbers::pi / 2});

}  // namespace

TEST_CASE("a plank on cylinders that turn takes their speed and does not sink") {
  struct Case {
    double spin, h, bound;
  };
  for (const Case& c : {Case{10, 5e-3, 1e-6}, Case{10, 1e-3, 1e-7}, Case{50, 1e-3, 1e-5}})
    for (const double half_length : {0.1, 0.3}) {  // narrower and wider than the plank
      CAPTURE(c.spin);
      CAPTURE(c.h);
      CAPTURE(half_length);
      World world(0.1, Materials<Law>(1, Law(0.3)));
      world.set_gravity({0, 0, -9.81});
      const ShapeId roller = world.add_shape(Cylinder<>(half_length, 0.1));
      for (int k = 0; k < 12; ++k) {
        const BodyId body = world.add_grain(roller, {{0.3 * k, 0, 0}, across}, 1000);
        world.prescribe_motion(body);
        world.set_spin(body, {0, c.spin, 0});
      }
      const BodyId plank = world.add_grain(world.add_shape(cuboid<Polyhedron<>>({0.5, 0.15, 0.05})),
                                           {{0.75, 0, 0.15}, S::identity()}, 1000);
      int unsolved = 0;
      for (int k = 0; k < int(0.6 / c.h); ++k) unsolved += !world.step(c.h).solve.converged;
      const double speed = std::min(0.1 * c.spin, 0.3 * 9.81 * 0.6);
      CHECK(unsolved == 0);
      CHECK(std::abs(world.pose(plank).position[2] - 0.15) < c.bound);
      CHECK(std::abs(world.pose(plank).position[1]) < c.bound);
      CHECK(std::abs(world.velocity(plank)[0] - speed) < 1e-3 * speed);
    }
}

TEST_CASE("a cylinder in the groove of two that turn stays there") {
  for (const double turn : {0.0, 1.3e-2}) {
    CAPTURE(turn);
    constexpr double h = 1e-3, radius = 0.1;
    World world(0.1, Materials<Law>(1, Law(0.3)));
    world.set_gravity({0, 0, -9.81});
    const ShapeId shape = world.add_shape(Cylinder<>(0.2, radius));
    for (const double x : {-1.0, 1.0}) {
      const BodyId body = world.add_grain(shape, {{1.1 * radius * x, 0, 0}, across}, 1000);
      world.prescribe_motion(body);
      world.set_spin(body, {0, turn / h, 0});
    }
    const double height = std::sqrt(4 * radius * radius - 1.21 * radius * radius);
    const BodyId top = world.add_grain(shape, {{0, 0, height}, across}, 1000);
    int unsolved = 0;
    for (int k = 0; k < 1000; ++k) unsolved += !world.step(h).solve.converged;
    CHECK(unsolved == 0);
    CHECK((world.pose(top).position - Vector(0, 0, height)).norm() < 1e-4 * radius);
  }
}
