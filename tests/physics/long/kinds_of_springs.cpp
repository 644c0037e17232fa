// SPDX-License-Identifier: MIT
// Laws with springs in small scenes whose answer is known, each in many variants: shape, size, direction, step, in
// space and in the plane, in double and single precision, at default options.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <type_traits>
#include <vector>

#include "moreau/law/compliant.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/measure/energy.hpp"
#include "moreau/motion/moreau_jean.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/world/simulation.hpp"

#include "sanitized.hpp"

using namespace moreau;

namespace {

constexpr double pi = std::numbers::pi;

/// A prism about the last axis; in the plane a box.
template <class ShapeT>
ShapeT prism(int sides, double radius, double half) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  std::vector<typename SpaceOf<ShapeT>::Vector> corners;
  for (int k = 0; k < sides; ++k)
    for (const double z : {-half, half}) {
      const double angle = 2 * pi * (k + 0.5) / sides;
      if constexpr (SpaceOf<ShapeT>::dim == 3)
        corners.push_back({T(radius * std::cos(angle)), T(radius * std::sin(angle)), T(z)});
      else if (k < 2)
        corners.push_back({T(k == 0 ? -radius : radius), T(z)});
    }
  return ShapeT(std::span<const typename SpaceOf<ShapeT>::Vector>(corners));
}

}  // namespace

// Springs in world axes forget 2 pi F / k per turn, F being the force of friction.
TEST_CASE_TEMPLATE("kinds: springs hold a grain in its place on a turning floor", T, double,
                   float) {
  using ShapeT = Polyhedron<T>;
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  using Coulomb = SignoriniCoulomb<T>;
  using Law = Compliant<Coulomb>;
  int variant = 0;
  for (const int sides : {3, 4, 6})
    for (const double stiffness : {1e3, 1e4})
      for (const double spin : {5.0, -3.0})
        for (const double radius : {0.12, 0.05}) {
          ++variant;
          const double half = 0.01, h = variant % 2 == 0 ? 2e-4 : 4e-4;
          Simulation<ShapeT, Law> world(T(2 * half),
                                        Materials<Law>(1, Law(Coulomb(T(2)), T(stiffness))));
          const auto table = world.add_wall(Vector::UnitZ(), Vector::Zero());
          const auto grain =
              world.add_grain(world.add_shape(prism<ShapeT>(sides, half, half)),
                              {Vector(T(radius), 0, T(half)), S::identity()}, T(1000));
          world.set_gravity({0, 0, T(-9.81)});
          const double turn = 2 * pi / std::abs(spin);
          double angle = 0, before = 0;
          const auto relative = [&] {
            const Vector x = world.pose(grain).position;
            return std::remainder(std::atan2(double(x[1]), double(x[0])) - angle, 2 * pi);
          };
          int unsolved = 0;
          const auto run = [&](double duration, bool starts) {
            const int steps = rounds(int(duration / h));
            for (int k = 0; k < steps; ++k) {
              const double s = starts ? (k + 0.5) / steps : 1, rate = spin * s * s * (3 - 2 * s);
              world.set_spin(table, {0, 0, T(rate)});
              unsolved += !world.step(T(h)).solve.converged;
              angle += rate * h;
            }
          };
          run(0.5, true);
          run(turn, false);
          before = relative();
          run(2 * turn, false);
          const double mass = double(world.bodies().grain_mass[grain.index()]);
          const double forgotten = 2 * pi * mass * spin * spin * radius / stiffness;
          // A step along the tangent in place of the arc lags by (spin h)^3 / 12 on each side.
          const double chord = radius * turn / h * std::pow(std::abs(spin) * h, 3) / 6;
          CAPTURE(sides);
          CAPTURE(stiffness);
          CAPTURE(spin);
          CAPTURE(radius);
          CHECK(unsolved == 0);
          const double creep = std::abs(std::remainder(relative() - before, 2 * pi)) * radius / 2;
          CHECK(creep <
                0.02 * forgotten + 2 * chord + (std::is_same_v<T, float> ? 1e-4 * radius : 0.0));
        }
}

// At the end of an impact the overlap is what a step leaves: the energy has an error that falls with the square of the
// step, and more where the number of points changes within the impact.
TEST_CASE_TEMPLATE(
    "kinds: springs without loss keep the energy of an impact, with loss they take it", ShapeT,
    Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Law = LinearSpringDashpot<T>;
  using Vector = typename S::Vector;
  const Vector up = Vector::Unit(S::dim - 1);
  for (const int sides : {3, 4, 6})
    for (const double flat : {1.0, 0.3})
      for (const double tilt : {0.0, 1e-3, 0.02, 0.3})
        for (const double restitution : {1.0, 0.5})
          for (const double friction : {0.0, 0.5}) {
            if (S::dim == 2 && sides != 4) continue;
            const double radius = 0.01, half = flat * radius;
            const Law law(T(1e6), T(friction > 0 ? 7e5 : 0), T(friction), T(restitution));
            Simulation<ShapeT, Law> world(T(0.02), Materials<Law>(1, law));
            world.add_wall(up, Vector::Zero());
            typename S::Angular turn = S::Angular::Zero();
            turn[0] = T(tilt);
            if (S::angular_dim > 1) turn[1] = T(0.7 * tilt);
            const auto grain = world.add_grain(
                world.add_shape(prism<ShapeT>(sides, radius, half)),
                {Vector(T(half + 1e-4 + 1.5 * radius * tilt) * up), S::exp(turn)}, T(1000));
            world.set_velocity(grain, -up);
            const auto energy = [&] {
              const auto kinetic = kinetic_energy(world);
              return double(kinetic.translation) + double(kinetic.rotation);
            };
            const double start = energy();
            const T mass = T(world.bodies().grain_mass[grain.index()]);
            const double h = double(law.duration(mass)) / 400;
            double most = 0;
            for (int k = 0; k < rounds(int(8e-3 / h)); ++k) {
              world.step(T(h));
              most = std::max(most, energy());
            }
            CAPTURE(sides);
            CAPTURE(flat);
            CAPTURE(tilt);
            CAPTURE(restitution);
            CAPTURE(friction);
            CHECK(most <= start * (1 + 1e-3));
            if (restitution == 1 && friction == 0) CHECK(energy() >= start * (1 - 1e-3));
            if (restitution < 1) CHECK(energy() < 0.9 * start);
          }
}

// A block on its springs, which is kicked up, down or along its floor, and does not leave it: whatever the steps, its kinetic
// energy never exceeds that of the kick.
TEST_CASE_TEMPLATE("kinds: springs make no energy, however the step changes", ShapeT, Polyhedron<>,
                   Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Compliant<SignoriniCoulomb<T>>;
  constexpr double mass = 10, half = 0.05, weight = 9.81;
  const Vector up = Vector::Unit(S::dim - 1);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(0, 1);
  for (const double omega : {30.0, 300.0})
    for (const double theta : {0.5, 0.8})
      for (const int direction : {0, 1, 2})
        for (int pattern = 0; pattern < 9; ++pattern) {
          // Rare long steps, two in a row, and steps that are drawn.
          const double least = (pattern < 4 ? 0.07 : 0.01) / omega;
          const double growth = std::pow(10.0, 1 + pattern % 4);
          const auto length = [&](int k) {
            if (pattern == 8) return 0.01 / omega * std::pow(10.0, 4 * number(random));
            return k % 20 < (pattern < 4 ? 19 : 18) ? least : least * growth;
          };
          const double stiffness = mass * omega * omega;
          Simulation<ShapeT, Law> world(
              T(2 * half),
              Materials<Law>(1, Law(SignoriniCoulomb<T>(T(5)), T(stiffness), T(stiffness / 2))));
          world.set_integrator(MoreauJean(theta));
          const auto block =
              world.add_grain(world.add_shape(cuboid<ShapeT>(Vector::Constant(T(half)))),
                              {Vector(T(half - weight / omega / omega) * up)},
                              T(mass / std::pow(2 * half, S::dim)));
          world.add_wall(up, Vector::Zero());
          world.set_gravity(T(-weight) * up);
          for (int k = 0; k < 20; ++k) world.step(T(10 / omega));
          const double speed = 0.2 * weight / omega;
          const Vector kick = direction == 0   ? Vector(up)
                              : direction == 1 ? Vector(-up)
                                               : Vector(Vector::UnitX());
          world.set_velocity(block, T(speed) * kick);
          double most = 0;
          for (int k = 0; k < rounds(1500); ++k) {
            world.step(T(length(k)));
            const auto kinetic = kinetic_energy(world);
            most = std::max(most, double(kinetic.translation) + double(kinetic.rotation));
          }
          CAPTURE(omega);
          CAPTURE(theta);
          CAPTURE(direction);
          CAPTURE(pattern);
          CHECK(most <= mass * speed * speed / 2 * (1 + (std::is_same_v<T, float> ? 1e-3 : 1e-9)));
        }
}

// Steps that grow have a larger theta; bodies in flight do not feel it.
TEST_CASE_TEMPLATE("kinds: flight beside springs is exact, however the step changes", ShapeT,
                   Polyhedron<>, Polygon<>, Polyhedron<float>, Polygon<float>) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Law = Compliant<SignoriniCoulomb<T>>;
  const Vector up = Vector::Unit(S::dim - 1);
  Simulation<ShapeT, Law> world(T(0.1),
                                Materials<Law>(1, Law(SignoriniCoulomb<T>(T(0.5)), T(1e5))));
  const auto shape = world.add_shape(cuboid<ShapeT>(Vector::Constant(T(0.05))));
  world.add_grain(shape, {Vector(T(0.05) * up)}, T(1000));
  const auto grain = world.add_grain(shape, {Vector(T(1) * Vector::UnitX() + T(5) * up)}, T(1000));
  world.set_velocity(grain, Vector(T(2) * Vector::UnitX() + T(3) * up));
  world.add_wall(up, Vector::Zero());
  world.set_gravity(T(-10) * up);
  double time = 0;
  for (int k = 0; k < 300; ++k) {
    const double h = k % 7 == 0 ? 1e-2 : k % 3 == 0 ? 1e-3 : 1e-4;
    world.step(T(h));
    time += h;
  }
  const Vector expected =
      T(1 + 2 * time) * Vector::UnitX() + T(5 + 3 * time - 5 * time * time) * up;
  CHECK(double((world.pose(grain).position - expected).norm()) <
        (std::is_same_v<T, float> ? 1e-4 : 1e-12));
}
