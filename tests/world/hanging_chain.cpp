// SPDX-License-Identifier: MIT
// Grains that hang from a ceiling in a row, held by an attraction far above their weight: the errors of a step are
// relative to the weight that the contacts bear, not to the attraction.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <type_traits>
#include <vector>

#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

namespace {

constexpr double size = 0.02, gravity = 9.81, h = 1e-3;

/// What the last grain of the row did.
struct Fall {
  double fastest = 0;  ///< largest speed in the second half of the time, relative to g h [-]
  double sunk = 0;     ///< how far it is from its place at the end, relative to the size [-]
  int unsolved = 0;    ///< steps
  int islands = 0;     ///< that the direct method has solved in the last step
};

/// @param law_of function: weight of a grain [N] -> law
template <class ShapeT>
Fall hang(const auto& law_of, int grains, int steps) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const ShapeT shape(T(size / 2));
  constexpr T density = 2700;
  const double weight = double(shape.volume()) * density * gravity;
  const auto law = law_of(weight);
  Simulation<ShapeT, std::decay_t<decltype(law)>> world(T(size), law);
  const Vector up = Vector::Unit(S::dim - 1);
  const ShapeId id = world.add_shape(shape);
  std::vector<BodyId> row;
  Pose<S> place;
  for (int k = 0; k < grains; ++k) {
    place.position = -T(size) * (T(k) + T(0.5)) * up;
    row.push_back(world.add_grain(id, place, density));
  }
  world.add_wall(-up, Vector::Zero());
  world.set_gravity(-T(gravity) * up);
  Fall fall;
  for (int i = 0; i < steps; ++i) {
    const SolveReport report = world.step(T(h)).solve;
    fall.unsolved += !report.converged;
    fall.islands = report.islands;
    const double speed = double(world.velocity(row.back()).norm());
    if (2 * i >= steps) fall.fastest = std::max(fall.fastest, speed / (gravity * h));
  }
  fall.sunk = (-size * (grains - 0.5) - double(world.pose(row.back()).position[S::dim - 1])) / size;
  return fall;
}

template <class ShapeT>
void check(const auto& law_of, int grains, double speed, int islands = 0) {
  const Fall fall = hang<ShapeT>(law_of, grains, 300);
  CHECK(fall.islands == islands);
  CAPTURE(fall.fastest);
  CAPTURE(fall.sunk);
  CHECK(fall.unsolved == 0);
  CHECK(fall.fastest < speed);
  CHECK(std::abs(fall.sunk) < 1e-3);
}

}  // namespace

TEST_CASE("a row of balls hangs by an adhesion of up to a million times their weight") {
  using Law = Cohesive<SignoriniCoulomb<>>;
  for (const double bond : {1e2, 1e4, 1e6}) {
    CAPTURE(bond);
    check<Ball<double>>([&](double weight) { return Law(SignoriniCoulomb<>(0.4), bond * weight); },
                        20, 0.2, 1);
  }
}

TEST_CASE("a row of disks with resistance to rolling hangs in single precision") {
  using Law = Cohesive<RollingResistance<float>>;
  for (const double bond : {1e2, 1e3}) {
    CAPTURE(bond);
    check<Disk<float>>(
        [&](double weight) {
          return Law(RollingResistance<float>(0.4f, 0.1f), float(bond * weight));
        },
        10, 0.2, 1);
  }
}

TEST_CASE("a row of balls hangs by bridges") {
  using Law = Bridged<LinearCohesion<>, SignoriniCoulomb<>>;
  for (const double bond : {1e2, 1e4}) {
    CAPTURE(bond);
    check<Ball<double>>(
        [&](double weight) {
          return Law(LinearCohesion<>(bond * weight, 1e-4), SignoriniCoulomb<>(0.4));
        },
        20, 0.2, 1);
  }
}

// Impulses without a solution grow along a line that has no end. Moved on along it, they became so large that the rounding of
// velocities was all that was left (1e6 m/s), and the report called that solved.
TEST_CASE_TEMPLATE("attracting grains that walls squeeze: no step is solved, and none is thrown",
                   ShapeT, Ball<double>, Disk<double>, Ball<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Cohesive<SignoriniCoulomb<T>>;
  for (const int grains : {1, 2, 5})
    for (const bool islands : {true, false}) {
      // A row of disks that rounding makes crooked is squeezed out aside: they roll on each other.
      if (S::dim == 2 && grains > 1) continue;
      CAPTURE(grains);
      CAPTURE(islands);
      ColouredOptions options;
      options.islands = islands;
      const Materials<Law> law(1, Law(SignoriniCoulomb<T>(T(0.5)), T(10), T(1e-3)));
      Simulation<ShapeT, Law> world(T(size), law, ColouredGaussSeidel(options));
      const Vector up = Vector::Unit(S::dim - 1);
      const ShapeId id = world.add_shape(ShapeT(T(size / 2)));
      for (int k = 0; k < grains; ++k)
        world.add_grain(id, {Vector(T(size) * (T(k) + T(0.5)) * up)}, T(2700));
      world.add_wall(up, Vector::Zero());
      const BodyId lid = world.add_wall(-up, T(size * grains) * up);
      world.set_velocity(lid, T(-0.1) * up);
      world.set_gravity(-T(gravity) * up);
      int claimed = 0;
      T fastest = 0;
      for (int i = 0; i < 50; ++i) {
        claimed += world.step(T(h)).solve.converged;
        for (const BodyId grain : world.grains())
          fastest = std::max(fastest, world.velocity(grain).norm());
      }
      CHECK(claimed == 0);
      CHECK(fastest < T(1));
    }
}

TEST_CASE_TEMPLATE(
    "the adhesion is that of a contact point: a face holds as many times as it has points", ShapeT,
    Disk<>, Ball<>, Polygon<>, Polyhedron<>, Polygon<float>, Ball<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Cohesive<SignoriniCoulomb<T>>;
  const Vector up = Vector::Unit(S::dim - 1);
  constexpr bool is_round = !Polytope<ShapeT>;
  const ShapeT shape = [] {
    if constexpr (is_round)
      return ShapeT(T(size / 2));
    else
      return cuboid<ShapeT>(Vector(Vector::Constant(T(size / 2))));
  }();
  const double weight = double(shape.volume()) * 2700 * gravity;
  const int points = is_round ? 1 : S::dim == 2 ? 2 : 4;
  for (const bool holds : {true, false}) {
    const double adhesion = (holds ? 1.05 : 0.95) * weight / points;
    Simulation<ShapeT, Law> world(T(size), Law(SignoriniCoulomb<T>(T(0.5)), T(adhesion)));
    const BodyId grain =
        world.add_grain(world.add_shape(shape), Pose<S>(Vector(T(-size / 2) * up)), T(2700));
    world.add_wall(-up, Vector::Zero());
    world.set_gravity(T(-gravity) * up);
    for (int k = 0; k < 200; ++k) world.step(T(h));
    const double sunk = -size / 2 - double(world.pose(grain).position[S::dim - 1]);
    CHECK((sunk < 1e-4 * size) == holds);
  }
}
