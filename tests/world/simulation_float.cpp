// SPDX-License-Identifier: MIT
#include <cmath>
#include <doctest/doctest.h>

#include "moreau/moreau.hpp"
#include "moreau/shape/ball.hpp"

#include "world/check_rest.hpp"

TEST_CASE_TEMPLATE("float: grains come to rest on each other, with bounded overlap", ShapeT,
                   moreau::Polyhedron<float>, moreau::Polygon<float>) {
  scenes::check_rest<ShapeT>();
}

TEST_CASE_TEMPLATE("small and large spheres keep their spin", T, float, double) {
  using Law = moreau::SignoriniCoulomb<T>;
  for (const double radius : {1e-4, 5e-4, 80.0}) {
    moreau::Simulation<moreau::Ball<T>, Law> world(static_cast<T>(2 * radius),
                                                   moreau::Materials<Law>(1, Law(T(0.5))));
    const auto grain =
        world.add_grain(world.add_shape(moreau::Ball<T>(static_cast<T>(radius))), {}, T(2650));
    world.set_spin(grain, {T(1), T(2), T(2)});
    for (int k = 0; k < 10; ++k) world.step(T(1e-4));
    CHECK(double(world.spin(grain).norm()) == doctest::Approx(3).epsilon(1e-5));
  }
}

TEST_CASE("float: the time and many turns lose no steps") {
  using S = moreau::Space<2, float>;
  using Law = moreau::SignoriniCoulomb<float>;
  moreau::Simulation<moreau::Disk<float>, Law> world(0.1f, moreau::Materials<Law>(1, Law(0.5f)));
  const auto drum = world.add_cylinder({0, 0}, S::Angular(1.0f), 1);
  world.set_pose(drum, {S::Vector::Zero(), S::exp(S::Angular(1100.0f))});
  world.set_spin(drum, S::Angular(1.0f));
  const int steps = 20000;
  for (int k = 0; k < steps; ++k) world.step(1e-4f);
  CHECK(world.time() == doctest::Approx(steps * 1e-4).epsilon(1e-6));
  const double turned =
      std::remainder(double(world.pose(drum).rotation.angle()) - 1102.0, 6.28318530718);
  CHECK(std::abs(turned) < 0.02);
}

TEST_CASE_TEMPLATE("loads as small as rounding errors are solved at once", T, float, double) {
  // Pairs of balls in touch fall freely. One ball of each pair spins.
  using S = moreau::Space<3, T>;
  using Vector = typename S::Vector;
  using Law = moreau::SignoriniCoulomb<T>;
  moreau::Simulation<moreau::Ball<T>, Law> world(T(0.02), moreau::Materials<Law>(1, Law(T(0.5))));
  const auto ball = world.add_shape(moreau::Ball<T>(T(0.01)));
  for (int k = 0; k < 8; ++k) {
    const Vector place(T(0.1) * T(k) + T(0.013), T(0.017), T(0.5));
    world.set_spin(world.add_grain(ball, {place, S::identity()}, T(2700)), {T(1), T(2), T(3)});
    const T distance = T(0.02) - T(1e-6);
    world.add_grain(ball, {place + distance * Vector(T(0.6), T(0.8), T(0)), S::identity()},
                    T(2700));
  }
  world.set_gravity({T(0), T(0), T(-9.81)});
  for (int k = 0; k < 5; ++k) {
    const auto report = world.step(T(5e-4));
    CHECK(report.points == 8);
    CHECK(report.solve.converged);
    CHECK(report.solve.sweeps < 100);
  }
}
