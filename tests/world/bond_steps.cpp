// SPDX-License-Identifier: MIT
// Rigid bonds when the step changes, and in steps in which positions hardly move beyond their rounding.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <numbers>
#include <random>

#include "moreau/io/snapshot.hpp"
#include "moreau/law/bonded.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#include "types.hpp"

using namespace moreau;

namespace {

/// Six grains in a row along x, each 0.1 m wide with a weight of 3 N, held at the first one or free.
template <class ShapeT>
struct Beam {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Bonded<T>;
  static constexpr double size = 0.1, mass = 3 / 9.81;
  static constexpr int count = 6;

  Simulation<ShapeT, Law> world;

  explicit Beam(bool held, double strength = 2000)
      : world(T(size), Materials<Law>(1, Law(BondStrength<T>{T(strength), T(strength),
                                                             T(0.4 * strength), T(0)},
                                             T(0.4)))) {
    constexpr double radius = size / 2, pi = std::numbers::pi;
    const double volume = S::dim == 2 ? pi * radius * radius : 4 * pi / 3 * std::pow(radius, 3);
    const ShapeId shape = world.add_shape(ShapeT(T(radius)));
    for (int k = 0; k < count; ++k)
      world.add_grain(shape, Pose<S>(Vector(T(size * k) * Vector::UnitX())), T(mass / volume));
    CHECK(world.bond_touching(T(1e-5)) == std::size_t(count - 1));
    if (!held) return;
    world.prescribe_motion(world.grains().front());
    world.set_gravity(Vector(T(-9.81) * Vector::Unit(S::dim - 1)));
  }
  /// The largest couple of a bond in the last step [N m], of a force [N].
  double couple(T step) const {
    double most = 0;
    for (const auto& impulse : world.contacts().impulses)
      most = std::max(most, double(angular<S>(impulse).norm() / step));
    return most;
  }
  double force(T step) const {
    double most = 0;
    for (const auto& impulse : world.contacts().impulses)
      most = std::max(most, double(linear<S>(impulse).norm() / step));
    return most;
  }
  /// How far the last grain is from where it was [m].
  double sag() const {
    const Vector there = T(size * (count - 1)) * Vector::UnitX();
    return double((world.pose(world.grains().back()).position - there).norm());
  }
};

}  // namespace

// A correction of what a long step leaves must not load the bonds more than it did in the long step: with the tolerance
// of 1e-4 by some percent.
TEST_CASE_TEMPLATE("bond: a held row bears its weight alone while steps change", ShapeT,
                   MOREAU_TYPES((Disk<double>, Ball<float>), (Ball<double>, Disk<float>))) {
  using Row = Beam<ShapeT>;
  using T = typename Row::T;
  const double weight = 3, couple = weight * Row::size * (0.5 + 1.5 + 2.5 + 3.5 + 4.5);
  const auto run = [&](int steps, const auto& step_of) {
    Row row(true);
    double most = 0;
    int unsolved = 0;
    for (int k = 0; k < steps && row.world.bonds().size() == Row::count - 1; ++k) {
      const T h = T(step_of(k));
      unsolved += !row.world.step(h).solve.converged;
      most = std::max(most, row.couple(h));
    }
    CHECK(row.world.bonds().size() == Row::count - 1);
    CHECK(unsolved == 0);
    CHECK(most < 1.2 * couple);
  };
  SUBCASE("a shorter step") {
    run(400, [](int k) { return k < 100 ? 7.3e-4 : 1.8e-5; });
  }
  SUBCASE("a much shorter step") {
    run(400, [](int k) { return k < 100 ? 1e-2 : 1e-5; });
  }
  SUBCASE("steps of any length") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> exponent(-5, -3);
    run(800, [&](int) { return std::pow(10, exponent(random)); });
  }
  SUBCASE("short steps") {
    run(400, [](int) { return 1.8e-5; });
  }
}

TEST_CASE_TEMPLATE("bond: what a long step left is corrected in the shorter steps", ShapeT,
                   MOREAU_TYPES((Disk<double>), (Ball<double>))) {
  Beam<ShapeT> row(true);
  for (int k = 0; k < 20; ++k) row.world.step(7.3e-4);
  const double left = row.sag();
  CHECK(left > 1e-8);
  // The time in which errors are corrected falls by a twentieth of the time that goes by.
  for (int k = 0; k < 40 * 20; ++k) row.world.step(3.65e-5);
  CHECK(row.sag() < 0.02 * left);
}

// Bodies come to the first detection along tangents, half a step h: arcs leave a stretch of (w h / 2)^2 size / 2 there, which a new
// bond remembers, and which is an error in a shorter step. Its correction, a fifth over h^2, accelerates the bodies: the couple is at most
// mass w^2 size / 40 with the lever of a grain.
TEST_CASE_TEMPLATE("bond: a row that turns bears the force of its turning while steps change",
                   ShapeT, MOREAU_TYPES((Disk<double>), (Ball<double>))) {
  using Row = Beam<ShapeT>;
  using S = typename Row::S;
  using Vector = typename Row::Vector;
  const double spin = 10, force = Row::mass * spin * spin * Row::size * (0.5 + 1.5 + 2.5);
  const double moved = Row::mass * spin * spin * Row::size / 40 * Row::size;
  for (const bool falls : {true, false}) {
    CAPTURE(falls);
    Row row(false);
    typename S::Angular w = S::Angular::Zero();
    w[S::angular_dim - 1] = spin;
    for (const BodyId grain : row.world.grains()) {
      row.world.set_spin(grain, w);
      const double x = row.world.pose(grain).position[0] - 2.5 * Row::size;
      row.world.set_velocity(grain, Vector(spin * x * Vector::UnitY()));
    }
    double most = 0, couple = 0;
    for (int k = 0; k < 300; ++k) {
      const double h = (k < 100) == falls ? 1e-3 : 1e-5;
      CHECK(row.world.step(h).solve.converged);
      most = std::max(most, row.force(h));
      couple = std::max(couple, row.couple(h));
    }
    CHECK(row.world.bonds().size() == Row::count - 1);
    CHECK(most < 1.05 * force);
    CHECK(couple < moved);
  }
}

TEST_CASE("bond: a snapshot after the step has fallen") {
  Beam<Disk<double>> row(true), copy(true);
  for (int k = 0; k < 30; ++k) row.world.step(k < 20 ? 1e-3 : 1e-5);
  restore_snapshot(snapshot(row.world), copy.world);
  for (int k = 0; k < 30; ++k) row.world.step(1e-5), copy.world.step(1e-5);
  CHECK(snapshot(row.world) == snapshot(copy.world));
}
