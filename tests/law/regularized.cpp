// SPDX-License-Identifier: MIT
// One impact under spring-dashpot laws, integrated with small steps.
#include "moreau/law/regularized.hpp"

#include <cmath>
#include <doctest/doctest.h>

#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

namespace {

using namespace moreau;
using S = Space<2>;
using Springs = moreau::LinearSpringDashpot<double>;
using Hertz = moreau::HertzMindlin<double>;

/// A point mass of 1 kg hits a wall with a normal speed of 1 m/s and a tangential velocity `slip`
/// [m/s].
/// @returns velocity at the end of the impact, normal component first [m/s]
template <class Law>
S::Vector impact(const Law& law, double slip) {
  S::Vector x(0, 0), v(-1, slip), memory = S::Vector::Zero();
  const double h = 1e-6;
  do {
    x += h / 2 * v;
    const moreau::ContactMotion<S> motion{x[0], v, 1, 0.05, h};
    v += h * law.force(motion, memory);
    x += h / 2 * v;
  } while (x[0] < 0);
  return v;
}

}  // namespace

TEST_CASE("springs and dashpots give the restitution that they were asked for") {
  for (const double e : {0.2, 0.5, 0.8, 1.0}) {
    CAPTURE(e);
    CHECK(impact(Springs(1e5, 0, 0, e), 0)[0] == doctest::Approx(e).epsilon(1e-3));
    CHECK(impact(Hertz(1e7, 0, 0, e), 0)[0] == doctest::Approx(e).epsilon(1e-3));
  }
  CHECK(impact(Springs(1e5, 0, 0, 0.0), 0)[0] == doctest::Approx(std::exp(-2)).epsilon(1e-3));
}

TEST_CASE("a contact that slides throughout carries mu times the normal impulse") {
  const auto check = [](const S::Vector& v) {
    CHECK(100 - v[1] == doctest::Approx(0.3 * (1 + v[0])).epsilon(1e-6));
  };
  check(impact(Springs(1e5, 3e4, 0.3, 0.5), 100));
  check(impact(Hertz(1e7, 2e6, 0.3, 0.5), 100));
}

TEST_CASE_TEMPLATE("the arguments of a simulation are those of one under a set-valued law", ShapeT,
                   Disk<>, Ball<>) {
  using Law = LinearSpringDashpot<>;
  Tolerances tolerances;
  tolerances.margin = 0.1;
  const Simulation<ShapeT, Law> world(0.02, Law(1e5), {}, tolerances), short_form(0.02, Law(1e5)),
      without_solver(0.02, Law(1e5), tolerances);
  CHECK(world.tolerances().margin == 0.1);
  CHECK(without_solver.tolerances().margin == 0.1);
  CHECK(short_form.tolerances().margin == Tolerances().margin);
}

TEST_CASE("the duration of an impact is that of the law") {
  const auto last = [](const auto& law, double v) {
    S::Vector memory = S::Vector::Zero();
    double x = 0, time = 0, force = 1;
    for (const double h = 1e-7; force > 0 || time == 0; time += h) {
      x += h * v;
      force = law.force(moreau::ContactMotion<S>{x, S::Vector(v, 0), 1, 0.05, h}, memory)[0];
      v += h * force;
    }
    return time;
  };
  const Springs springs(1e5, 0, 0, 0.5);
  CHECK(last(springs, -1) == doctest::Approx(springs.duration(1)).epsilon(1e-3));
  for (const double speed : {0.01, 1.0}) {
    const Hertz bouncing(1e7), damped(1e7, 0, 0, 0.3);
    CHECK(last(bouncing, -speed) ==
          doctest::Approx(bouncing.duration(1, 0.05, speed)).epsilon(1e-3));
    CHECK(last(damped, -speed) ==
          doctest::Approx(1.25 * damped.duration(1, 0.05, speed)).epsilon(0.05));
  }
}

TEST_CASE("friction takes energy after a step whose normal force was cut to zero") {
  const Springs law(1e6, 5e5, 0.5, 0.5);
  S::Vector memory = S::Vector::Zero();
  // It leaves so fast that the dashpot would pull, and slides.
  const moreau::ContactMotion<S> leaving{-1e-7, {0.5, 0.2}, 0.01, 0.005, 1e-6};
  CHECK(law.force(leaving, memory).norm() == 0);
  CHECK(memory[1] == 0);
  const moreau::ContactMotion<S> pressed{-1e-5, {-0.05, 0.01}, 0.01, 0.005, 1e-6};
  CHECK(law.force(pressed, memory)[1] < 0);
}
