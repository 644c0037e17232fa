// SPDX-License-Identifier: MIT
// Bonded bodies in motion: they turn, keep their momentum, are one body until they break.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "moreau/measure/bond_state.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/sample/bonded_parts.hpp"
#include "moreau/sample/compound_ballast.hpp"
#include "moreau/shape/compound.hpp"

#include "world/bonded_rows.hpp"

using namespace moreau;
using namespace bonded;

TEST_CASE_TEMPLATE("bond: a bonded pair turns freely under the tension of its motion", X,
                   BOND_TYPES) {
  using World = Row<typename X::Shape, typename X::LawOf>;
  using S = typename World::S;
  using T = typename World::T;
  constexpr bool is_float = std::is_same_v<T, float>;
  World pair(2);
  pair.world.release(pair.grains[0]);
  const double rate = 20, h = 1e-4;
  for (const BodyId grain : pair.grains) {
    pair.world.set_spin(grain, World::about_z(rate));
    const double side = grain == pair.grains[0] ? -1 : 1;
    pair.world.set_velocity(grain,
                            typename S::Vector(T(side * rate * radius) * S::Vector::Unit(1)));
  }
  const Momentum<S> before = momentum(pair.world);
  const double tension_of_turn = double(pair.world.bodies().grain_mass[0]) * rate * rate * radius;
  for (int k = 0; k < 1600; ++k) {  // half a turn
    pair.world.step(T(h));
    if (!World::is_compliant && k < 5)
      CHECK(agree(double(pair.world.contact_impulse(pair.last()).norm()) / h, tension_of_turn,
                  is_float ? 0.1 : 0.01));
  }
  const Momentum<S> after = momentum(pair.world);
  const double scale = double(before.angular.norm());
  CHECK(double((after.angular - before.angular).norm()) < (is_float ? 1e-3 : 1e-6) * scale);
  const double mass = double(pair.world.bodies().grain_mass[0]);
  const auto pull = pair.world.contact_impulse(pair.last());
  CHECK(agree(double(double(pull.norm()) / h), mass * rate * rate * radius, is_float ? 0.1 : 0.01));
  CHECK(agree(double(double(
                  (pair.world.pose(pair.grains[0]).position - pair.world.pose(pair.last()).position)
                      .norm())),
              2 * radius, 1e-4));
  CHECK(pair.world.bonds().size() == 1);
}

TEST_CASE_TEMPLATE("bond: a grain keeps its place on a body that turns by prescription", X,
                   BOND_TYPES) {
  using World = Row<typename X::Shape, typename X::LawOf>;
  using S = typename World::S;
  using T = typename World::T;
  using Vector = typename S::Vector;
  constexpr bool is_float = std::is_same_v<T, float>;
  World pair(2);
  const double rate = 20, h = 2.5e-3, reach = 2 * radius;  // 0.05 rad per step
  pair.world.set_spin(pair.grains[0], World::about_z(rate));
  pair.world.set_spin(pair.last(), World::about_z(rate));
  pair.world.set_velocity(pair.last(), Vector(T(rate * reach) * Vector::Unit(1)));
  const double mass = double(pair.world.bodies().grain_mass[1]);
  double off = 0, wrong = 0, away = 0, first = 0;
  for (int k = 0; k < 252; ++k) {  // two turns
    // The position for which the contacts are detected; on a circle of it, the acceleration of the steps.
    const Vector middle =
        pair.world.pose(pair.last()).position + T(h / 2) * pair.world.velocity(pair.last());
    const double acceleration = 2 * (1 - std::cos(rate * h)) / (h * h) * double(middle.norm());
    pair.world.step(T(h));
    // The circle of the detections is that of the first one, to which the grain moves along the tangent.
    if (k == 0) first = double(middle.norm());
    if (k == 0 || (World::is_compliant && k < 60)) continue;  // until the springs have come to rest
    const Vector pull = pair.world.contact_impulse(pair.last()) / T(h);
    const double stretch = World::is_compliant ? double(pull.norm()) / stiffness : 0;
    off = std::max(off, std::abs(double(middle.norm()) - first - stretch) / reach);
    const double radius_after = double(pair.world.pose(pair.last()).position.norm());
    away = std::max(away, std::abs(radius_after - reach - stretch) / reach);
    wrong = std::max(wrong, std::abs(double(pull.norm()) / (mass * acceleration) - 1));
  }
  CHECK(off < (is_float ? 1e-6 : 1e-9));
  CHECK(away < 1e-6);  // of fourth order in the step
  CHECK(wrong < (is_float ? 1e-3 : 1e-6));
  CHECK(pair.world.bonds().size() == 1);
}

TEST_CASE_TEMPLATE("bond: a free rod keeps its momentum to rounding, whatever the strength", X,
                   BOND_TYPES) {
  using World = Row<typename X::Shape, typename X::LawOf>;
  using S = typename World::S;
  using T = typename World::T;
  const double rate = 4, speed = 0.1;
  const int steps = 300;
  for (double scale = 0.1; scale < 2e5; scale *= 10)
    for (const double zone : {0.0, 1e-2 * scale}) {
      CAPTURE(scale);
      CAPTURE(zone);
      World rod(4, zone, 1000, scale);
      rod.world.release(rod.grains[0]);
      for (std::size_t k = 0; k < rod.grains.size(); ++k) {
        typename S::Vector v = T(rate * 2 * radius * (double(k) - 1.5)) * S::Vector::Unit(1);
        v[0] = T(speed);
        rod.world.set_velocity(rod.grains[k], v);
        rod.world.set_spin(rod.grains[k], World::about_z(rate));
      }
      const Momentum<S> before = momentum(rod.world);
      const double energy = kinetic_energy(rod.world).total();
      for (int k = 0; k < steps; ++k) rod.world.step(T(1e-4));
      const Momentum<S> after = momentum(rod.world);
      const double rounding = 4 * double(std::numeric_limits<T>::epsilon()) * steps;
      CHECK(double((after.linear - before.linear).norm()) <
            rounding * double(before.linear.norm()));
      CHECK(double((after.angular - before.angular).norm()) <
            rounding * double(before.angular.norm()));
      CHECK(rod.world.bonds().size() == 3);
      if (!std::is_same_v<T, float>) CHECK(agree(kinetic_energy(rod.world).total(), energy, 1e-3));
    }
}

TEST_CASE_TEMPLATE("bond: a stone of bonded parts is one body until it breaks", X, BOND_TYPES) {
  using ShapeT = typename X::Shape;
  using Law = typename X::LawOf;
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const Compound<ShapeT> stone = [] {
    if constexpr (Polytope<ShapeT>) {
      std::mt19937_64 random(3);
      return ballast_shapes<Compound<ShapeT>>(1, random)[0].scaled(T(0.02));
    } else {  // a triangle of balls
      const ShapeT ball{T(radius)};
      const Vector x = T(2 * radius) * Vector::UnitX(),
                   y = x / 2 + T(std::sqrt(3.) * radius) * Vector::Unit(1);
      return Compound<ShapeT>({{ball, {}}, {ball, Pose<S>(x)}, {ball, Pose<S>(y)}});
    }
  }();
  Simulation<ShapeT, Law> world(T(0.01), Materials<Law>(1, Make<Law>::law()),
                                tight(std::is_same_v<T, float>));
  const Pose<S> pose(Vector(Vector::Constant(T(0.1))), S::exp(S::Angular::Constant(T(0.7))));
  const Pose<S> apart(Vector(Vector::Constant(T(0.2))));
  const auto parts = add_bonded_parts(world, stone, pose, T(1000), MaterialId(0), T(1e-5));
  const auto other = add_bonded_parts(world, stone, apart, T(1000), MaterialId(0), T(1e-5));
  const std::size_t count = stone.parts().size();
  REQUIRE(parts.size() == count);
  // A gap above the margin, and a place where another stone is: no part stays.
  const Pose<S> third(Vector(Vector::Constant(T(0.3))));
  CHECK_THROWS_WITH_AS(add_bonded_parts(world, stone, third, T(1000), MaterialId(0), T(1)),
                       doctest::Contains("Simulation::bond_touching: gap = 1"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(add_bonded_parts(world, stone, apart, T(1000), MaterialId(0), T(1e-5)),
                       doctest::Contains("Simulation::bond_touching: overlap"),
                       std::invalid_argument);
  CHECK(world.grain_count() == 2 * count);
  const BondState before = bond_state(world);
  CHECK(before.fragments == 2);
  CHECK(before.bonds >= 2 * (count - 1));
  CHECK(before.coordination == doctest::Approx(double(before.bonds) / double(count)));
  CHECK(before.least_strength == 1);
  auto held = world;  // an obstacle is no fragment, and has no mean of its own
  for (const BodyId part : parts) held.prescribe_motion(part);
  CHECK(bond_state(held).fragments == 1);
  CHECK(bond_state(held).coordination == doctest::Approx(before.coordination));
  CHECK(before.strength_left == doctest::Approx(1));
  // Forces on one part alone, far below the strength, move the stone as the rigid body of the compound.
  const auto properties = stone.mass_properties(T(1000));
  world.set_force(parts[0], Vector(T(0.1) * properties.mass * Vector::UnitX()));
  const T h = T(1e-4);
  for (int k = 0; k < 100; ++k) world.step(h);
  double speed = 0;
  for (const BodyId part : parts)
    speed += double(world.bodies().grain_mass[part.index()] * world.velocity(part)[0]);
  CHECK(agree(speed, 0.1 * 100 * 1e-4 * double(properties.mass), 1e-4));
  const auto turn = (world.spin(parts[0]) - world.spin(parts[1])).norm();
  // By the rounding of rotations, of which bond_rounding.cpp has the derivation: 9.0 of three disks.
  const double rounding = 9 * double(std::numeric_limits<T>::epsilon()) / double(h);
  CHECK(double(turn) < (CompliantLaw<Law, S> ? 0.2 : 2e-3) * double(world.spin(parts[0]).norm()) +
                           std::max(1e-6, rounding));
  CHECK(bond_state(world).fragments == 2);
  // Pulled apart, it falls to pieces, which are not bonded to anything.
  const Vector centre = pose.position;
  for (int k = 0; k < 400 && bond_state(world).fragments < count + 1; ++k) {
    for (const BodyId part : parts)
      world.set_force(part, Vector(T(20 * tension * std::min(1., k / 100.)) *
                                   (world.pose(part).position - centre).normalized()));
    world.step(h);
  }
  const BondState after = bond_state(world);
  CHECK(after.fragments == count + 1);
  CHECK(after.bonds == before.bonds / 2);
  CHECK(world.breakages().size() == before.bonds / 2);
}

TEST_CASE_TEMPLATE("the rotation between two frames, up to half a turn", S, Space<2>, Space<3>,
                   Space<2, float>, Space<3, float>) {
  using T = typename S::Scalar;
  using Matrix = typename S::Matrix;
  using Angular = typename S::Angular;
  const T rounding = 32 * std::numeric_limits<T>::epsilon(), pi = std::numbers::pi_v<T>;
  Angular tilt = Angular::Constant(T(0.3));
  tilt[0] = T(-1.1);
  std::vector<Angular> axes{Angular(tilt.normalized())};
  for (int k = 0; k < S::angular_dim; ++k) axes.push_back(Angular::Unit(k));
  for (const Matrix& from : {Matrix(Matrix::Identity()), Matrix(S::exp(tilt).toRotationMatrix())})
    for (const Angular& axis : axes)
      for (const T angle : {T(0), T(1e-5), T(1), T(1.6), T(3), T(3.1415), pi - 3 * rounding, pi}) {
        CAPTURE(angle);
        const Matrix turn = S::exp(angle * axis).toRotationMatrix();
        const Angular found = detail::rotation_between<S>(from, turn * from);
        CHECK(std::abs(found.norm() - angle) < rounding);
        CHECK((S::exp(found).toRotationMatrix() - turn).norm() < rounding);
      }
  // Exactly half a turn.
  Matrix half = -Matrix::Identity();
  if (S::dim > 2) half(S::dim - 1, S::dim - 1) = 1;
  Angular found = detail::rotation_between<S>(Matrix::Identity(), half);
  CHECK(std::abs(found[S::angular_dim - 1]) == pi);
  CHECK(found.norm() == pi);
}

TEST_CASE_TEMPLATE("bond: a body that was turned by 180 degrees turns back", X,
                   MOREAU_TYPES((Case<Circle, Soft>, Case<Globe, Rigid>),
                                (Case<Circle, Rigid>, Case<Globe, Soft>,
                                 Case<BallIn<Space<2, float>>, Bonded<float>>,
                                 Case<BallIn<Space<3, float>>, Bonded<float>>))) {
  using Law = typename X::LawOf;
  using R = Row<typename X::Shape, Law>;
  using S = typename R::S;
  using T = typename R::T;
  for (const T sign : {T(1), T(-1)}) {
    R row(2, 0, 1000, 1e6);
    Pose<S> pose = row.world.pose(row.last());
    typename S::Angular turn = S::Angular::Zero();
    // In space about the bond, which does not bend. In the plane half a turn puts the middle of the bond into the centre
    // of the disk, where a couple has no lever.
    turn[0] = sign * std::numbers::pi_v<T> * (S::dim == 2 ? T(0.99) : T(1));
    pose.rotation = S::exp(turn);
    row.world.set_pose(row.last(), pose);
    for (int k = 0; k < 60; ++k) {
      row.world.step(T(1e-3));
      REQUIRE(row.world.pose(row.last()).is_finite());
      REQUIRE(row.world.bonds().size() == 1);
    }
    pose = row.world.pose(row.last());
    if (!R::is_compliant)
      CHECK((pose.rotation.toRotationMatrix() - S::Matrix::Identity()).norm() < 0.01);
  }
}
