// SPDX-License-Identifier: MIT
// One impact under spring-dashpot laws, integrated with small steps.
#include "moreau/law/regularized.hpp"

#include <cmath>
#include <doctest/doctest.h>

#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"

namespace {

using S = moreau::Space<2>;
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

TEST_CASE("the duration of an impact is that of the law") {
  const Springs law(1e5, 0, 0, 0.5);
  S::Vector memory = S::Vector::Zero();
  double x = 0, v = -1, time = 0, force = 1;
  for (const double h = 1e-7; force > 0 || time == 0; time += h) {
    x += h * v;
    force = law.force(moreau::ContactMotion<S>{x, S::Vector(v, 0), 1, 0.05, h}, memory)[0];
    v += h * force;
  }
  CHECK(time == doctest::Approx(law.duration(1)).epsilon(1e-3));
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
