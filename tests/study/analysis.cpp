// SPDX-License-Identifier: MIT
// The fits of the study, applied to data with known results.
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "../../examples/ratcheting/active_phase.hpp"
#include "../../examples/ratcheting/study/closed_form.hpp"
#include "../../examples/ratcheting/study/compaction_fit.hpp"
#include "../../examples/ratcheting/study/loop_distance.hpp"
#include "../../examples/ratcheting/study/power_law.hpp"
#include "../../examples/ratcheting/study/result.hpp"
#include "../../examples/ratcheting/study/wording.hpp"

using namespace study;
using ratcheting::active_phase;
using ratcheting::ActivePhase;
using ratcheting::time_before_minimum;

namespace {

const std::vector<double> frequencies{1, 2, 3.5, 5, 7, 8.5, 10, 12, 15, 20, 35, 60};

/// Samples of y = law(x), multiplied by a random factor of about 1 +- noise.
std::vector<Point> sampled(const auto& law, double noise = 0) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Point> points;
  for (const double nu : frequencies)
    points.push_back({nu, law(nu) * std::exp(noise * normal(random))});
  return points;
}

Push push(double thrust_over_fmax, double wall_mass = 14) {
  return {6000 * thrust_over_fmax, 0, 6000, 5, 28, wall_mass};
}

}  // namespace

TEST_CASE("a power law is found exactly, and within its error under noise") {
  const auto law = [](double nu) { return 0.0115 * std::pow(nu, -2); };
  const PowerLaw exact = fit_power_law(sampled(law));
  CHECK(exact.exponent == doctest::Approx(-2).epsilon(1e-12));
  CHECK(exact.prefactor == doctest::Approx(0.0115).epsilon(1e-12));
  CHECK(exact.exponent_error < 1e-12);
  const PowerLaw noisy = fit_power_law(sampled(law, 0.1));
  CHECK(std::abs(noisy.exponent + 2) < 3 * noisy.exponent_error);
  CHECK(noisy.exponent_error < 0.05);
  CHECK(noisy.exponent_error > 0.005);
}

TEST_CASE("points without a logarithm are left out, too few give no law") {
  std::vector<Point> points = sampled([](double nu) { return 3 * nu; });
  points.push_back({4, -1});
  points.push_back({0, 2});
  const PowerLaw law = fit_power_law(points);
  CHECK(law.points == frequencies.size());
  CHECK(law.exponent == doctest::Approx(1));
  CHECK(std::isnan(fit_power_law({{1, 2}}).exponent));
  CHECK(std::isnan(fit_power_law({{2, 2}, {2, 3}}).exponent));
  CHECK(std::isnan(fit_line({{0, 1}, {1, 2}}).slope_error));
}

TEST_CASE("the standard error of a slope is that of the textbook") {
  // y = 1, 3, 2, 5 at x = 0, 1, 2, 3 has the slope 1.1. The residuals are -0.1, 0.8, -1.3, 0.6,
  // with the variance 2.7 / 2.
  const Line line = fit_line({{0, 1}, {1, 3}, {2, 2}, {3, 5}});
  CHECK(line.slope == doctest::Approx(1.1));
  CHECK(line.intercept == doctest::Approx(1.1));
  CHECK(line.slope_error == doctest::Approx(std::sqrt(2.7 / 2 / 5)));
}

TEST_CASE("a proportion is the geometric mean, its scatter that of the logarithm") {
  const Proportion fit = fit_proportion({{1, 2}, {2, 8}});
  CHECK(fit.factor == doctest::Approx(2 * std::sqrt(2.0)));
  CHECK(fit.scatter == doctest::Approx(std::log(2.0) / 2));
}

TEST_CASE("both forms of the compaction rate give back their nu_c and prefactor") {
  const auto branches = [](double nu) { return 0.005 * two_branches(nu, 9.5); };
  const CompactionFit two = fit_compaction(sampled(branches), two_branches);
  CHECK(two.nu_c == doctest::Approx(9.5).epsilon(2e-3));
  CHECK(two.prefactor == doctest::Approx(0.005).epsilon(2e-3));
  CHECK_FALSE(two.at_edge);
  const Slopes slopes = slopes_about(sampled(branches), two.nu_c);
  CHECK(slopes.below.exponent == doctest::Approx(1));
  CHECK(slopes.above.exponent == doctest::Approx(-1));

  const auto single = [](double nu) { return 0.004 * single_form(nu, 12); };
  const CompactionFit one = fit_compaction(sampled(single), single_form);
  CHECK(one.nu_c == doctest::Approx(12).epsilon(2e-3));
  CHECK(one.prefactor == doctest::Approx(0.004).epsilon(2e-3));

  const CompactionFit noisy = fit_compaction(sampled(branches, 0.2), two_branches);
  CHECK(noisy.nu_c == doctest::Approx(9.5).epsilon(0.2));
  CHECK(noisy.scatter == doctest::Approx(0.2).epsilon(0.5));
}

TEST_CASE("a rate that only rises has no nu_c within the frequencies") {
  const CompactionFit fit = fit_compaction(sampled([](double nu) { return nu; }), two_branches);
  CHECK(fit.at_edge);
}

TEST_CASE("the paper's two forms differ by 1.42 at half of nu_c") {
  CHECK(single_form(5, 10) / two_branches(5, 10) == doctest::Approx(1.42).epsilon(2e-3));
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

TEST_CASE("speed of the way back") {
  const Push p = push(0.05);
  // Integrates the motion with small steps, from the time at which the force falls below the
  // thrust.
  const double omega = 2 * std::numbers::pi * p.frequency, mass = p.moving_mass(0.5), h = 1e-7;
  double t = -std::acos(1 - 2 * p.thrust / p.fmax) / omega, x = 0, v = 0, at_start = 0;
  const double inward = 2 * sine_displacement(p, 0.5);
  for (; x > -inward; t += h) {
    v += h * (p.thrust - p.fmax / 2 * (1 - std::cos(omega * (t + h / 2)))) / mass;
    x += h * v;
    if (x > 0) at_start = -v;
  }
  CHECK(returning_speed(p, 0, 0.5) == doctest::Approx(at_start).epsilon(1e-3));
  CHECK(returning_speed(p, inward, 0.5) == doctest::Approx(-v).epsilon(1e-3));
  CHECK(thrust_of_displacement(p, sine_displacement(p, 0.5), 0.5) ==
        doctest::Approx(p.thrust).epsilon(1e-9));

  // In the limit in which the force is a parabola, the displacement is proportional to 1/nu^2 and
  // the speed to 1/nu.
  Push slow = push(0.001), fast = slow;
  fast.frequency *= 4;
  CHECK(returning_speed(slow, 0, 1) / returning_speed(fast, 0, 1) == doctest::Approx(4));
}

TEST_CASE("the share of the grains that moves is found from different wall masses") {
  std::vector<Pushed> runs;
  for (const double wall : {2.8, 14.0, 28.0, 56.0, 112.0})
    runs.push_back({push(0.013, wall), sine_displacement(push(0.013, wall), 0.4)});
  const MovingShare share = fit_moving_share(runs);
  CHECK(share.beta == doctest::Approx(0.4));
  CHECK(share.measured_over_predicted.factor == doctest::Approx(1));
  CHECK(share.measured_over_predicted.scatter < 1e-12);
}

TEST_CASE("distance of loops: none to itself, the shift in units of the range to a shifted one") {
  std::vector<Point> circle, shifted;
  for (int k = 0; k < 400; ++k) {
    const double angle = 2 * std::acos(-1.0) * k / 400;
    circle.push_back({2 * std::cos(angle), 5 * std::sin(angle)});
    shifted.push_back({2 * std::cos(angle) + 0.4, 5 * std::sin(angle)});
  }
  CHECK(loop_distance(circle, circle) == doctest::Approx(0));
  CHECK(loop_distance(circle, shifted) == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(std::isnan(loop_distance(circle, {})));
}

TEST_CASE("verdicts and their wording") {
  CHECK(within(-2.1, -2.1, -1.9) == true);
  CHECK(within(-1.89, -2.1, -1.9) == false);
  CHECK_FALSE(within(std::nan(""), 0, 1).has_value());
  CHECK(text_of(-2.034) == "−2.03");
  CHECK(text_of(std::nan("")).empty());
  CHECK(text_of(estimate({1, 2, 3, std::nan("")})) == "2 ± 1 (3)");
  CHECK(text_of(estimate({0.5})) == "0.5");
  CHECK(text_of(estimate({})).empty());
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
  CHECK(phase.creep == doctest::Approx(0.2));
  CHECK(phase.dx == doctest::Approx(1));
  CHECK(phase.thrust == doctest::Approx(7));
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
