// SPDX-License-Identifier: MIT
// The fits of the study, applied to data with known results.
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <vector>

#include "ratcheting/active_phase.hpp"
#include "ratcheting/study/closed_form.hpp"
#include "ratcheting/study/line.hpp"
#include "ratcheting/study/result.hpp"

using namespace study;
using ratcheting::active_phase;
using ratcheting::ActivePhase;
using ratcheting::time_before_minimum;

namespace {

Push push(double thrust_over_fmax, double wall_mass = 14) {
  return {6000 * thrust_over_fmax, 0, 6000, 5, 28, wall_mass};
}

}  // namespace

TEST_CASE("the standard error of a slope is that of the textbook") {
  // y = 1, 3, 2, 5 at x = 0, 1, 2, 3 has the slope 1.1. The residuals are -0.1, 0.8, -1.3, 0.6,
  // with the variance 2.7 / 2.
  const Line line = fit_line({{0, 1}, {1, 3}, {2, 2}, {3, 5}});
  CHECK(line.slope == doctest::Approx(1.1));
  CHECK(line.intercept == doctest::Approx(1.1));
  CHECK(line.slope_error == doctest::Approx(std::sqrt(2.7 / 2 / 5)));
}

TEST_CASE("the closed form: the parabola is the sine's limit, and drifts as it is known to") {
  const auto drift = [](double share) {
    return sine_displacement(push(share), 1) / parabola_displacement(push(share), 1);
  };
  CHECK(drift(1e-4) == doctest::Approx(1).epsilon(1e-3));
  CHECK(drift(0.05) == doctest::Approx(1.02).epsilon(5e-3));
  CHECK(drift(0.25) == doctest::Approx(1.12).epsilon(5e-3));
  CHECK(drift(0.49) == doctest::Approx(1.40).epsilon(3e-2));
  CHECK(sine_displacement(push(0), 1) == 0);
  CHECK(std::isinf(sine_displacement(push(0.6), 1)));
}

TEST_CASE("the closed form is what integrating the wall gives") {
  const Push p = push(0.2);
  const double mass = p.moving_mass(0.5), omega = 2 * std::acos(-1.0) * p.frequency, h = 1e-7;
  double t = -std::acos(1 - 2 * 0.2) / omega, v = 0, x = 0;
  do {
    v += h * (p.thrust - p.fmax / 2 * (1 - std::cos(omega * (t + h / 2)))) / mass;
    x += h * v;
    t += h;
  } while (v > 0);
  CHECK(sine_displacement(p, 0.5) == doctest::Approx(x).epsilon(1e-4));
}

TEST_CASE(
    "the active phase begins where the falling force is the weight, numerical drift before it "
    "apart") {
  CHECK(time_before_minimum(0.5, 0, 1, 5) == doctest::Approx(0.05));
  CHECK(time_before_minimum(1e-6, 0, 1, 5) == doctest::Approx(1e-3 / (5 * std::acos(-1.0))));
  CHECK(time_before_minimum(0.5, 0.6, 1, 5) == 0);
  // The wall drifts by 0.2 until t = 1, moves out by 1 until t = 2, and returns to -1 until t = 3.
  std::vector<double> t, x, v, f_g;
  for (int k = 0; k <= 300; ++k) {
    t.push_back(0.01 * k);
    x.push_back(k <= 100 ? 0.002 * k : k <= 200 ? 0.2 + 0.01 * (k - 100) : 1.2 - 0.022 * (k - 200));
    v.push_back(k <= 100 ? 0.2 : k <= 200 ? 1 : -2.2);
    f_g.push_back(k <= 100 ? 50 : k <= 200 ? 7 : 90);
  }
  const ActivePhase phase = active_phase(t, x, v, f_g, 0, 1, 3);
  CHECK(phase.drift == doctest::Approx(0.2));
  CHECK(phase.dx == doctest::Approx(1));
  CHECK(phase.thrust == doctest::Approx(7));
  CHECK(phase.v_in_time.value() == doctest::Approx(2.01));
}

TEST_CASE("thrust and carried grains are found in the force of a wall that carries some") {
  // The equation of motion is M x'' = F - f with M = m_w + carried. The force on the wall itself is
  // f_g = F - carried x''.
  const double wall = 14, carried = 9, thrust = 80, h = 2e-4, omega = 2 * std::numbers::pi * 5;
  const auto force = [&](double time) { return 3000 * (1 - std::cos(omega * time)); };
  std::vector<double> t, x, v, f_g;
  double time = -std::acos(1 - thrust / 3000) / omega, speed = 0, place = 0;
  do {
    const double a = (thrust - force(time + h / 2)) / (wall + carried);
    time += h, speed += h * a, place += h * speed;
    t.push_back(time), x.push_back(place), v.push_back(speed), f_g.push_back(thrust - carried * a);
  } while (speed > 0);
  const ActivePhase phase = active_phase(t, x, v, f_g, t.front(), t.front(), t.back());
  CHECK(phase.carried.thrust == doctest::Approx(thrust).epsilon(1e-9));
  CHECK(phase.carried.mass == doctest::Approx(carried).epsilon(1e-9));
  CHECK(phase.carried.explained == doctest::Approx(1).epsilon(1e-9));
  // The displacement of the wall follows from the fitted values.
  const Push p{thrust, 0, 6000, 5, 28, wall};
  CHECK(sine_displacement(p, carried / 28) == doctest::Approx(phase.dx).epsilon(0.02));
  CHECK(std::isnan(ratcheting::carried_grains(t, v, f_g, 4, 5).mass));
}

TEST_CASE("rates of the first second: one window for all frequencies") {
  Result r{};
  CHECK(std::isnan(r.early_rate(&Jam::rho_inner)));
  // At 1 Hz the first period is used, although it ends after t = 1 s. At 5 Hz, in a run of five
  // seconds, the periods until the last jam before 1 s are used.
  r.jams = {{0.75, 0, 0.50, 0.60}, {1.75, 0, 0.52, 0.63}, {2.75, 0, 0.53, 0.64}};
  CHECK(r.early_rate(&Jam::rho_inner) == doctest::Approx(0.04));
  CHECK(r.early_rate(&Jam::rho_box) == doctest::Approx(0.05));
  r.jams.clear();
  for (int k = 0; k < 25; ++k) {
    const double t = 0.15 + 0.2 * k;
    r.jams.push_back({t, 0, t < 1 ? 0.5 * (1 + 0.1 * (t - 0.15)) : 0.9, 0.6});
  }
  CHECK(r.early_rate(&Jam::rho_inner) == doctest::Approx(0.1));
  CHECK(r.early_rate(&Jam::rho_box) == 0);
}
