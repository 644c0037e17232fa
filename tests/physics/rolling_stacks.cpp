// SPDX-License-Identifier: MIT
// Structures under laws with couples stand with the default options: their islands are solved by the direct method, also beside
// bonds.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/law/bonded.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "physics/rows.hpp"
#include "sanitized.hpp"
#include "types.hpp"

using namespace moreau;

namespace {

constexpr double size = 0.01, gravity = 9.81;

template <class ShapeT, class LawT = RollingResistance<typename SpaceOf<ShapeT>::Scalar>>
struct Stack {
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = LawT;
  static constexpr int up = S::dim - 1;

  Simulation<ShapeT, Law> simulation;
  std::vector<Vector> start;

  Stack(double friction, double rolling) : Stack(Law(Scalar(friction), Scalar(rolling))) {}
  explicit Stack(const Law& law) : simulation(Scalar(size), Materials<Law>(1, law)) {
    simulation.add_wall(Vector::Unit(up), Vector::Zero());
    simulation.set_gravity(-Scalar(gravity) * Vector::Unit(up));
  }
  /// @param place across, in sizes; random displacements are added to it
  void add(ShapeId shape, double across, double height, double jitter, std::mt19937_64& random) {
    std::uniform_real_distribution<double> aside(-jitter, jitter);
    Pose<S> pose;
    pose.position = Vector::NullaryExpr([&] { return Scalar(size * aside(random)); });
    pose.position[0] += Scalar(size * across);
    pose.position[up] = Scalar(size * height);
    simulation.add_grain(shape, pose, Scalar(1000));
    start.push_back(pose.position);
  }
  double moved() const {
    double most = 0;
    for (std::size_t k = 0; k < start.size(); ++k)
      most =
          std::max(most, double((simulation.pose(simulation.grain(k)).position - start[k]).norm()));
    return most;
  }
};

/// Steps a stack. No block may move by 1 % of its size, and after the step in which the load arrives at most a hundredth of
/// the steps may be unsolved.
template <class ShapeT, class Law>
void check_stands(Stack<ShapeT, Law>& stack, double step, int count) {
  using Scalar = typename SpaceOf<ShapeT>::Scalar;
  int islands = 0, unsolved = 0;
  double error = 0;
  for (int k = 0; k < count; ++k) {
    const SolveReport report = stack.simulation.step(Scalar(step)).solve;
    islands = std::max(islands, report.islands);
    unsolved += !report.converged;
    if (report.converged) error = std::max(error, report.velocity_error);
  }
  CHECK(islands == 1);
  CHECK(unsolved <= 2 + count / 100);
  CHECK(error <= 100 * ColouredOptions{}.velocity_tolerance);
  CHECK(stack.moved() < 0.01 * size);
}

}  // namespace

// By sweeps to the default residual a stack of 50 cubes fell within a second, and every step was reported as solved.
TEST_CASE_TEMPLATE("stacks stand under rolling resistance", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  using Scalar = typename Stack<ShapeT>::Scalar;
  std::mt19937_64 random(3);
  for (const int blocks : {2, 10, 50})
    for (const double h : {1e-3, 1.0 / 60})
      for (const double jitter : {0.0, 0.005})
        for (const double rolling : {0.0, 0.1}) {
          CAPTURE(blocks);
          CAPTURE(h);
          CAPTURE(jitter);
          CAPTURE(rolling);
          Stack<ShapeT> stack(0.5, rolling);
          const ShapeId block = stack.simulation.add_shape(regular_shape<ShapeT>(Scalar(size)));
          for (int k = 0; k < blocks; ++k) stack.add(block, 0, k + 0.5, jitter, random);
          check_stands(stack, h, rounds(60));
        }
}

TEST_CASE_TEMPLATE("a wall of blocks stands under rolling resistance", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Polygon<>), (Polyhedron<float>, Polygon<float>))) {
  using Scalar = typename Stack<ShapeT>::Scalar;
  std::mt19937_64 random(3);
  for (const double h : {1e-3, 1.0 / 60}) {
    Stack<ShapeT> wall(0.5, 0.1);
    const ShapeId block = wall.simulation.add_shape(regular_shape<ShapeT>(Scalar(size)));
    // A triangle: each block stands on two, half a size aside. The gaps are those between blocks of one course.
    for (int course = 0; course < 5; ++course)
      for (int k = course; k < 5; ++k)
        wall.add(block, 1.02 * (k - 0.5 * course), course + 0.5, 0, random);
    check_stands(wall, h, rounds(60));
  }
}

// The couples at their limit: a face that spins is slowed by them, and by friction. The load is m g, R the distance of a corner.
TEST_CASE("the couple of a block that turns on a floor is at its limit") {
  using ShapeT = Polyhedron<>;
  std::mt19937_64 random(3);
  constexpr double rolling = 0.1, h = 1e-3, spin = 20;
  Stack<ShapeT> stack(0, rolling);
  const ShapeId block = stack.simulation.add_shape(regular_shape<ShapeT>(size));
  stack.add(block, 0, 0.5, 0, random);
  auto& simulation = stack.simulation;
  const BodyId grain = simulation.grain(0);
  for (int k = 0; k < 5; ++k) simulation.step(h);
  simulation.set_spin(grain, spin * Eigen::Vector3d::UnitZ());
  const double mass = 1000 * size * size * size, inertia = mass * size * size / 6,
               radius = size * std::sqrt(0.75);
  constexpr int count = 20;
  int attempted =
      0;  // the first step, whose warm start is that of a block at rest, is left to the sweeps
  for (int k = 0; k < count; ++k) {
    const SolveReport report = simulation.step(h).solve;
    CHECK(report.converged);
    attempted += report.islands;
  }
  CHECK(attempted > count / 2);
  const double slower = rolling * radius * mass * gravity * count * h / inertia;
  const double now = angular<Space<3>>(simulation.bodies().velocity[grain.index()])[2];
  CHECK(spin - now == doctest::Approx(slower).epsilon(1e-3));
}

// Without the direct method a stack of 50 squares moved by 0.7 of its size in 3 s.
TEST_CASE_TEMPLATE("blocks without bonds stand under a law with bonds", ShapeT,
                   MOREAU_TYPES((Polygon<>), (Polyhedron<>, Polyhedron<float>, Polygon<float>))) {
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Bonds = Stack<ShapeT, Bonded<Scalar>>;
  constexpr double friction = 0.4;
  const Scalar weight =
                   regular_shape<ShapeT>(Scalar(size)).mass_properties(1000).mass * Scalar(gravity),
               strength = 100 * weight;
  const Bonded<Scalar> law({strength, strength, strength}, Scalar(friction));
  const auto fill = [](auto& stack, std::mt19937_64 random) {
    const ShapeId block = stack.simulation.add_shape(regular_shape<ShapeT>(Scalar(size)));
    for (int k = 0; k < 20; ++k) stack.add(block, 0, k + 0.5, 0.005, random);
    return block;
  };
  SUBCASE("as under Coulomb's law") {
    for (const double h : {1e-3, 1.0 / 60}) {
      CAPTURE(h);
      Bonds stack(law);
      Stack<ShapeT, SignoriniCoulomb<Scalar>> coulomb{SignoriniCoulomb<Scalar>(Scalar(friction))};
      fill(stack, std::mt19937_64(3));
      fill(coulomb, std::mt19937_64(3));
      check_stands(stack, h, rounds(300));
      check_stands(coulomb, h, rounds(300));
    }
  }
  SUBCASE("on springs") {
    using Springs = Compliant<Bonded<Scalar>>;
    Stack<ShapeT, Springs> stack{Springs(law, Scalar(1e8))};
    fill(stack, std::mt19937_64(3));
    check_stands(stack, 1e-3, rounds(300));
  }
  SUBCASE("beside a bonded beam") {
    const double h = 1e-3;
    Bonds stack(law);
    std::mt19937_64 random(3);
    const ShapeId block = fill(stack, random);
    const std::size_t free = stack.start.size();
    // Five cubes in a row, of which the first is held.
    std::vector<BodyId> beam;
    auto& simulation = stack.simulation;
    for (int k = 0; k < 5; ++k) {
      stack.add(block, 2 + k, 3, 0, random);
      beam.push_back(simulation.grain(free + std::size_t(k)));
    }
    simulation.prescribe_motion(beam.front());
    REQUIRE(simulation.bond_touching(Scalar(1e-3 * size), beam) == 4);
    int islands = 0, unsolved = 0;
    for (int k = 0; k < rounds(300); ++k) {
      const StepReport report = simulation.step(Scalar(h));
      islands = std::max(islands, report.solve.islands);
      unsolved += !report.solve.converged;
      CHECK(report.bonds == 4);
    }
    CHECK(islands == 1);  // the stack, and not the beam
    CHECK(unsolved <= 2);
    CHECK(stack.moved() < 0.01 * size);
  }
}

// Gaps of the size of rounding decided which points of a sliding face bear the pressure: these rows turned by 2e-3 to 1.5 rad,
// and all steps were reported as solved.
TEST_CASE("rows of blocks slide straight under rolling resistance") {
  using ShapeT = Polyhedron<>;
  using Law = RollingResistance<double>;
  for (const unsigned seed : {1007u, 1013u, 1036u})
    for (const double rolling : {0.0, 0.1}) {
      const rows::Result row =
          rows::slide<ShapeT>(seed, [&](double height, double friction, const Eigen::Vector3d& up) {
            Simulation<ShapeT, Law> world(height, Materials<Law>(1, Law(friction, rolling)));
            world.set_gravity(-kinds::weight * up);
            return world;
          });
      CAPTURE(seed);
      CAPTURE(rolling);
      CHECK(row.unsolved == 0);
      CHECK(row.turn < 1e-4);
      CHECK(row.speed < 1e-4);
    }
}
