// SPDX-License-Identifier: MIT
// Bonds whose strength and whose stretch are near rounding, in single and double precision.
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "moreau/law/bonded.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

using namespace moreau;

namespace {

constexpr double radius = 0.01;

/// Balls in a row along x, bonded to their neighbours.
template <class ShapeT>
struct Chain {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Bonded<T>;

  Simulation<ShapeT, Law> world;
  std::vector<BodyId> grains;

  Chain(int count, T energy, T density, const Vector& origin)
      : world(T(2 * radius),
              Materials<Law>(1, Law(BondStrength<T>{T(20), T(12), T(8), energy}, T(0.4)))) {
    const ShapeId shape = world.add_shape(ShapeT(T(radius)));
    for (int k = 0; k < count; ++k) {
      Vector x = origin;
      x[0] += T(2 * radius * k);
      grains.push_back(world.add_grain(shape, Pose<S>(x), density));
    }
    world.prescribe_motion(grains.front());
    CHECK(world.bond_touching(T(1e-5)) == std::size_t(count - 1));
  }
};

}  // namespace

TEST_CASE_TEMPLATE("bond: a partly softened bond that bears nothing needs no further solution",
                   ShapeT, Disk<float>, Ball<float>, Disk<double>, Ball<double>) {
  using Pair = Chain<ShapeT>;
  using T = typename Pair::T;
  using Vector = typename Pair::Vector;
  for (const int pulled : {3, 11, 17, 26, 37}) {
    CAPTURE(pulled);
    Pair pair(2, T(1e-3), T(1e12), Vector::Zero());
    auto& world = pair.world;
    // It opens by a hundredth of what breaks it in each step.
    world.set_velocity(pair.grains[0], Vector(-T(1e-2) * Vector::UnitX()));
    for (int k = 0; k < pulled; ++k) world.step(T(1e-4));
    REQUIRE(world.bonds().size() == 1);
    const double left = double(world.bonds()[0].strength_left);
    CHECK(left < 1 - 0.005 * pulled);
    CHECK(left > 0);
    world.set_velocity(pair.grains[0], Vector(Vector::Zero()));
    world.set_velocity(pair.grains[1], Vector(Vector::Zero()));
    for (int k = 0; k < 20; ++k) {
      const StepReport report = world.step(T(1e-4) * T(1 + 0.03 * k));
      CHECK(report.solve.converged);
      if (k > 2) CHECK(report.solve.sweeps <= 20);
    }
    CHECK(double(world.bonds()[0].strength_left) == left);
  }
}

TEST_CASE_TEMPLATE("bond: a closed row far from the origin bears its weight alone", ShapeT,
                   Disk<float>, Ball<float>, Disk<double>, Ball<double>) {
  using Row = Chain<ShapeT>;
  using S = typename Row::S;
  using T = typename Row::T;
  using Vector = typename Row::Vector;
  for (const double away : {0.0, 10.0}) {
    CAPTURE(away);
    Row row(5, T(0), T(100), Vector(T(away) * Vector::Ones()));
    auto& world = row.world;
    world.prescribe_motion(row.grains.back());
    Vector gravity = Vector::Zero();
    gravity[S::dim - 1] = T(-9.81);
    world.set_gravity(gravity);
    const double weight = 9.81 * double(world.bodies().grain_mass[row.grains[1].index()]);
    double largest = 0;
    int unsolved = 0;
    const T h = T(1e-4);
    for (int k = 0; k < 200; ++k) {
      unsolved += world.step(h).solve.converged ? 0 : 1;
      if (k < 20) continue;
      for (const auto& impulse : world.contacts().impulses)
        largest = std::max(largest, double(linear<S>(impulse).norm() / h));
    }
    CAPTURE(largest);
    CHECK(unsolved == 0);
    CHECK(largest < 1.6 * weight);
    CHECK(world.bonds().size() == 4);
  }
}

TEST_CASE_TEMPLATE("bond: a large load elsewhere does not change the fracture energy", ShapeT,
                   Disk<double>, Ball<double>) {
  using Pair = Chain<ShapeT>;
  using S = typename Pair::S;
  using Vector = typename Pair::Vector;
  double energy[2];
  for (const bool beside : {false, true}) {
    Pair pair(2, 1e-3, 1e12, Vector::Zero());
    auto& world = pair.world;
    if (beside) {
      const Vector up = Vector::Unit(S::dim - 1);
      world.add_wall(up, Vector(-up));
      const ShapeId shape = world.add_shape(ShapeT(radius));
      const Vector place = 3 * Vector::UnitX() + (radius - 1) * up;
      world.set_force(world.add_grain(shape, Pose<S>(place), 1000), Vector(-1e9 * up));
    }
    world.set_velocity(pair.grains[0], Vector(-0.05 * Vector::UnitX()));
    for (int k = 0; k < 60 && !world.bonds().empty(); ++k) world.step(1e-4);
    REQUIRE(world.breakages().size() == 1);
    energy[beside] = world.breakages()[0].energy;
  }
  CHECK(energy[0] == doctest::Approx(1e-3).epsilon(1e-2));
  CHECK(energy[1] == doctest::Approx(energy[0]).epsilon(2e-3));
}

TEST_CASE_TEMPLATE("bond: a body that is moved by whole cells keeps its bond", ShapeT, Disk<double>,
                   Ball<double>) {
  using Pair = Chain<ShapeT>;
  using S = typename Pair::S;
  using Vector = typename Pair::Vector;
  Pair pair(2, 0, 1000, Vector(0.1 * Vector::Ones()));
  auto& world = pair.world;
  typename S::Matrix vectors = 0.3 * S::Matrix::Identity();
  world.set_cell(vectors);
  world.step(1e-4);
  Pose<S> pose = world.pose(pair.grains[1]);
  pose.position += vectors.col(0) - 2 * vectors.col(1);
  world.set_pose(pair.grains[1], pose);
  world.step(1e-4);
  vectors.col(1) += vectors.col(0);  // the same lattice
  world.set_cell(vectors);
  pose.position = 0.1 * Vector::Ones() + 2 * radius * Vector::UnitX() + vectors.col(1) +
                  vectors.col(S::dim - 1);
  world.set_pose(pair.grains[1], pose);
  for (int k = 0; k < 3; ++k) world.step(1e-4);
  CHECK(world.bonds().size() == 1);
  CHECK(world.velocity(pair.grains[1]).norm() < 1e-9);
}

TEST_CASE_TEMPLATE("bond: an axis that a bond reaches across keeps its length", ShapeT,
                   Disk<double>, Ball<double>, Disk<float>, Ball<float>) {
  using Pair = Chain<ShapeT>;
  using S = typename Pair::S;
  using T = typename Pair::T;
  using Vector = typename Pair::Vector;
  constexpr T length = T(0.25), infinity = std::numeric_limits<T>::infinity();
  Pair pair(2, 0, 1000, Vector(T(0.1) * Vector::Ones()));
  auto& world = pair.world;
  world.set_periodic(0, 0, length);
  world.set_periodic(0, 0, 2 * length);  // no bond reaches across it
  world.set_periodic(0, 0, length);
  const Pose<S> start = world.pose(pair.grains[1]);
  world.set_pose(pair.grains[1], Pose<S>(Vector(start.position - 3 * length * Vector::UnitX())));
  CHECK_THROWS_WITH_AS(world.set_periodic(0, 0, 2 * length),
                       doctest::Contains("Simulation::set_periodic: axis = 0 must stay as it is"),
                       std::invalid_argument);
  CHECK_THROWS_AS(world.set_periodic(0, -infinity, infinity), std::invalid_argument);
  CHECK(world.cell().length()[0] == length);
  world.set_periodic(0, T(0.01), T(0.01) + length);
  world.set_periodic(1, 0, 2 * length);
  for (int k = 0; k < 3; ++k) world.step(T(1e-4));
  CHECK(world.bonds().size() == 1);
  CHECK(world.velocity(pair.grains[1]).norm() < (std::is_same_v<T, float> ? 1e-3 : 1e-9));
  world.set_pose(pair.grains[1], start);
  world.set_periodic(0, -infinity, infinity);
  world.step(T(1e-4));
  CHECK(world.bonds().size() == 1);
}

TEST_CASE_TEMPLATE(
    "bond: a cell that has become too small is named by the function that was called", ShapeT,
    Disk<double>, Ball<double>) {
  using Pair = Chain<ShapeT>;
  using S = typename Pair::S;
  using Vector = typename Pair::Vector;
  Pair pair(2, 0, 1000, Vector(0.1 * Vector::Ones()));
  auto& world = pair.world;
  world.set_cell(typename S::Matrix(0.3 * S::Matrix::Identity()));
  CellControl<S> control;
  control.rate(0, 1) = 20;
  control.rate(1, 1) = -10;
  world.control_cell(control);
  const auto run = [&] {
    for (int k = 0; k < 1000; ++k) world.step(1e-3);
  };
  CHECK_THROWS_WITH_AS(run(), doctest::Contains("Simulation::step: height of the cell = "),
                       std::invalid_argument);
  const typename S::Matrix before = world.cell().vectors();
  CHECK_THROWS_WITH_AS(world.bond_touching(1e-5),
                       doctest::Contains("Simulation::bond_touching: height of the cell = "),
                       std::invalid_argument);
  CHECK(world.cell().vectors() == before);
}

namespace {

// The spin by which the parts of a free stone turn against each other, times h. Let t be the rotation of a bond.
//
//   1. A step adds some rounding d to t, and the correction takes a fifth of |t| - e off, with the rounding e of t as it is
//      computed. So |t| grows until a fifth of |t| - e is d, and the spin is at most (d + e / 5) / h.
//   2. e = 4 epsilon: the axes of both bodies, and their products with the two frames of the bond.
//   3. d: two bodies move twice in a step. In the plane the angle, here below 2, is rounded: epsilon / 2 each time. In space
//      a quaternion is: a product of four terms, 4 epsilon of the four numbers, and its length, epsilon; the rotation has
//      twice the error of the quaternion.
//   4. The solver leaves velocities that are a fifth of the rounding over h, of all n bonds together: that of the stretch is 4
//      radius epsilon (two levers, and the distance of the centres), which turns by its ratio to the effective radius,
//      half a radius: 8 epsilon. With e this is sqrt(n (8^2 + 4^2)) epsilon / 5. It is in the spin, and in d.
//
// Positions have a much larger rounding, which grows with the distance to the origin. It is not in this bound: stretches are
// differences of positions, and those of a closed row of bonds add up to nothing.
template <class S>
double spin_of_rounding(std::size_t parts) {
  const double epsilon = double(std::numeric_limits<typename S::Scalar>::epsilon());
  const double bonds = double(parts * (parts - 1) / 2), moves = S::dim == 2 ? 0.5 : 2 * (4 + 1);
  const double solver = std::sqrt(bonds * (8 * 8 + 4 * 4)) / 5;
  return (4 * moves + 4. / 5 + 2 * solver) * epsilon;
}

}  // namespace

TEST_CASE_TEMPLATE("bond: the parts of a free stone turn with it, wherever it is", ShapeT,
                   Disk<float>, Ball<float>, Disk<double>, Ball<double>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Bonded<T>;
  const T h = T(1e-4);
  for (const double away : {0.0, 0.1, 1.0, 10.0})
    for (const double angle : {0.7, 1.9}) {
      CAPTURE(away);
      CAPTURE(angle);
      Simulation<ShapeT, Law> world(
          T(2 * radius), Materials<Law>(1, Law(BondStrength<T>{T(20), T(12), T(8), T(0)}, T(0.4))));
      const ShapeId shape = world.add_shape(ShapeT(T(radius)));
      // A triangle, in space a tetrahedron: each part has a bond with each other part.
      const auto turn = S::exp(typename S::Angular(S::Angular::Constant(T(angle))));
      std::vector<BodyId> parts;
      for (int k = 0; k <= S::dim; ++k) {
        Vector x = Vector::Zero();
        if (k > 0) x[0] = T(k == 1 ? 2 * radius : radius);
        if (k > 1) x[1] = T(std::sqrt(k == 2 ? 3. : 1 / 3.) * radius);
        if (k > 2) x[S::dim - 1] = T(std::sqrt(8 / 3.) * radius);
        parts.push_back(world.add_grain(
            shape, Pose<S>(Vector(T(away) * Vector::Ones() + turn * x), turn), T(1000)));
      }
      CHECK(world.bond_touching(T(1e-5)) == std::size_t(S::dim * (S::dim + 1) / 2));
      const double mass = double(world.bodies().grain_mass[parts[0].index()]);
      world.set_force(parts[0], Vector(T(0.3 * mass) * Vector::UnitX()));
      double largest = 0;
      for (int k = 0; k < 400; ++k) {
        CHECK(world.step(h).solve.converged);
        for (const BodyId part : parts)
          largest = std::max(largest, double((world.spin(part) - world.spin(parts[0])).norm()));
      }
      CHECK(world.bonds().size() == std::size_t(S::dim * (S::dim + 1) / 2));
      CHECK(largest < spin_of_rounding<S>(parts.size()) / double(h));
    }
}
