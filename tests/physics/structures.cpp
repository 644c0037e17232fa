// SPDX-License-Identifier: MIT
// Structures that stand according to statics. Larger structures, which take minutes, are in
// long/structures.cpp.
#include <cmath>
#include <limits>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "physics/standing.hpp"
#include "sanitized.hpp"
#include "types.hpp"

using moreau::Polygon;
using moreau::Polyhedron;

namespace {
constexpr double step = 5e-3;
constexpr int settle = 20, second = rounds(200);
}  // namespace

TEST_CASE_TEMPLATE("a column of 10 boxes stands", ShapeT, Polyhedron<>, Polygon<>) {
  auto structure = masonry::column<ShapeT>(10);
  masonry::check_stands(structure, step, settle, second);
}

TEST_CASE_TEMPLATE("a wall of 12 bricks stands", ShapeT, Polyhedron<>, Polygon<>) {
  auto structure = masonry::wall<ShapeT>(3, 4);
  masonry::check_stands(structure, step, settle, second);
}

TEST_CASE_TEMPLATE("a card house of two storeys stands", ShapeT, Polyhedron<>, Polygon<>) {
  auto structure = masonry::card_house<ShapeT>(1.5 * masonry::card_friction);
  masonry::check_stands(structure, step, settle, second);
}

TEST_CASE_TEMPLATE("a semicircular arch of 17 voussoirs stands", ShapeT, Polyhedron<>, Polygon<>) {
  auto structure = masonry::arch<ShapeT>(17, 0.2);
  masonry::check_stands(structure, step, settle, second);
}

// Errors of rounding tilt the light block, and the load drives it out along the wedge: after 7 s with impulses of the
// rounding of compliances, after 20 s with velocities by impulses, which have the rounding of the heavy block.
TEST_CASE_TEMPLATE("a light block holds a heavy one without friction", ShapeT, Polyhedron<>,
                   Polygon<>) {
  constexpr double h = 1.0 / 60;
  for (const double ratio : {1e2, 1e3})
    masonry::check_stands_by_default(masonry::stack<ShapeT>(2, 0, 0, ratio), h, rounds(3900));
}

TEST_CASE_TEMPLATE("blocks of all masses on each other: the error of velocities is reported",
                   ShapeT, Polyhedron<>, Polygon<>) {
  constexpr int count = rounds(20);
  for (const double ratio : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6})
    for (const int blocks : {2, 3})
      for (const double jitter : {0.0, 0.005}) {
        CAPTURE(ratio);
        CAPTURE(blocks);
        CAPTURE(jitter);
        masonry::check_reported_errors(masonry::stack<ShapeT>(blocks, 0.5, jitter, ratio), 1e-3,
                                       count);
      }
}

TEST_CASE_TEMPLATE("structures stand with the default options", ShapeT, Polyhedron<>, Polygon<>) {
  constexpr int count = rounds(40);
  for (const double h : {1e-3, 1.0 / 60}) {
    for (const int cubes : {2, 10, 20, 30})
      for (const double jitter : {0.0, 0.005})
        masonry::check_stands_by_default(masonry::stack<ShapeT>(cubes, 0.5, jitter), h, count);
    for (const double ratio : {1e3, 1e-3})
      for (const double friction : {0.0, 0.5})
        masonry::check_stands_by_default(masonry::stack<ShapeT>(2, friction, 0, ratio), h, count);
    masonry::check_stands_by_default(masonry::arch<ShapeT>(11, 0.2), h, count);
    masonry::check_stands_by_default(masonry::arch<ShapeT>(31, 0.2), h, count);
    masonry::check_stands_by_default(masonry::wall<ShapeT>(3, 4), h, count);
    masonry::check_stands_by_default(masonry::card_house<ShapeT>(1.5 * masonry::card_friction), h,
                                     count);
  }
}

// What is left of their relative velocities is the rounding of their speed.
TEST_CASE_TEMPLATE("a stack that is thrown flies as one body, and steps are solved", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polygon<float>))) {
  using Scalar = typename moreau::SpaceOf<ShapeT>::Scalar;
  using Vector = typename moreau::SpaceOf<ShapeT>::Vector;
  constexpr double h = 1e-3;
  for (const int blocks : {2, 3, 6})
    for (const double friction : {0.0, 0.5})
      for (const double ratio : {1.0, 1000.0})
        for (const double speed : {0.5, 7.3, 61.7}) {
          CAPTURE(blocks);
          CAPTURE(friction);
          CAPTURE(ratio);
          CAPTURE(speed);
          auto structure = masonry::stack<ShapeT>(blocks, friction, 0, ratio);
          auto& simulation = structure.simulation;
          simulation.set_solver(moreau::ColouredGaussSeidel());
          for (const moreau::BodyId block : simulation.grains())
            simulation.set_velocity(block, Vector(Vector::Unit(structure.up) * Scalar(speed)));
          int unsolved = 0;
          constexpr int steps = rounds(30);
          for (int k = 0; k < steps; ++k) unsolved += !simulation.step(Scalar(h)).solve.converged;
          CHECK(unsolved == 0);
          const double end = speed - masonry::gravity * h * steps;
          const double allowed =
              1e-3 * masonry::gravity * h + steps * std::numeric_limits<Scalar>::epsilon() * speed;
          for (const moreau::BodyId block : simulation.grains())
            CHECK(std::abs(double(simulation.velocity(block)[structure.up]) - end) < allowed);
        }
}

// Their contacts bore a load in the step before, and bear none now.
TEST_CASE_TEMPLATE(
    "the upper part of a stack that loses a block falls freely, and steps are solved", ShapeT,
    MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polygon<float>))) {
  using Scalar = typename moreau::SpaceOf<ShapeT>::Scalar;
  constexpr double h = 1e-3;
  constexpr int settle_steps = rounds(100), falls = 5;
  for (const int blocks : {3, 4, 6})
    for (const double friction : {0.0, 0.5})
      for (const double ratio : {1.0, 100.0})
        for (const int removed : {0, 1}) {
          CAPTURE(blocks);
          CAPTURE(friction);
          CAPTURE(ratio);
          CAPTURE(removed);
          auto structure = masonry::stack<ShapeT>(blocks, friction, 0, ratio);
          auto& simulation = structure.simulation;
          simulation.set_solver(moreau::ColouredGaussSeidel());
          std::vector<moreau::BodyId> upper;
          for (int k = removed + 1; k < blocks; ++k)
            upper.push_back(simulation.grain(std::size_t(k)));
          for (int k = 0; k < settle_steps; ++k) simulation.step(Scalar(h));
          simulation.remove_grain(simulation.grain(std::size_t(removed)));
          for (int k = 1; k <= falls; ++k) {
            CHECK(simulation.step(Scalar(h)).solve.converged);
            for (const moreau::BodyId block : upper) {
              const double fall = masonry::gravity * h * k;
              CHECK(std::abs(double(simulation.velocity(block)[structure.up]) + fall) <
                    100 * moreau::ColouredOptions().velocity_tolerance * masonry::gravity * h);
            }
          }
        }
}
