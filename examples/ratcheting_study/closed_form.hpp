// SPDX-License-Identifier: MIT
// How far the wall moves out under a constant thrust of the grains.
//
// With f = f0 + f1 (1 - cos w t), f0 = fmin, f1 = (fmax - fmin)/2, t from the minimum of f, and a
// constant thrust f_a, the wall of moving mass M starts at -t0, where f falls to f_a,
//     cos w t0 = 1 - (f_a - f0) / f1,
// has the speed
//     M v = (f_a - f0 - f1) (t + t0) + f1 (sin w t + sin w t0) / w,
// and stops where that is zero again. Near the minimum f is a parabola; then it stops at 2 t0, with
//     dx = 0.228 f_a^2 / (M fmax nu^2)          (f0 = 0; 0.228 = 9/(4 pi^2)).
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "power_law.hpp"

namespace study {

/// Force and masses of one run. SI units.
struct Push {
  double thrust, fmin, fmax, frequency, mass, wall_mass;

  /// Of the wall and the share beta of the grains that moves with it [kg].
  double moving_mass(double beta) const { return wall_mass + beta * mass; }
};

/// Largest displacement [m] by the parabola.
inline double parabola_displacement(const Push& p, double beta) {
  const double pi = std::numbers::pi, thrust = p.thrust - p.fmin;
  return 9 / (4 * pi * pi) * thrust * thrust /
         (p.moving_mass(beta) * (p.fmax - p.fmin) * p.frequency * p.frequency);
}

/// Largest displacement [m] by the full sine; infinite if the thrust is above the mean force (the
/// wall does not come back within the period), 0 if it is not above the smallest force.
inline double sine_displacement(const Push& p, double beta) {
  const double omega = 2 * std::numbers::pi * p.frequency;
  const double f1 = (p.fmax - p.fmin) / 2, excess = p.thrust - p.fmin;
  if (!(excess > 0)) return 0;
  if (excess >= f1) return std::numeric_limits<double>::infinity();
  const double t0 = std::acos(1 - excess / f1) / omega;
  const double drift = excess - f1;
  const auto momentum = [&](double t) {
    return drift * (t + t0) + f1 * (std::sin(omega * t) + std::sin(omega * t0)) / omega;
  };
  // The wall slows down from t0 on; by bisection.
  double low = t0, high = std::numbers::pi / omega + t0;
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (momentum(middle) > 0 ? low : high) = middle;
  }
  const double t = low;
  const double way =
      drift * (t + t0) * (t + t0) / 2 +
      f1 / omega *
          ((std::cos(omega * t0) - std::cos(omega * t)) / omega + std::sin(omega * t0) * (t + t0));
  return way / p.moving_mass(beta);
}

/// A run's push and the displacement that was measured.
struct Pushed {
  Push push;
  double displacement;
};

/// beta in [0, 2], the only parameter, for which the measured displacements deviate least from the
/// predicted ones, and what is left.
struct MovingShare {
  double beta = std::nan("");
  Proportion measured_over_predicted;
};

inline MovingShare fit_moving_share(const std::vector<Pushed>& runs) {
  MovingShare best;
  for (int k = 0; k <= 400 && !runs.empty(); ++k) {
    const double beta = 0.005 * k;
    std::vector<Point> points;
    for (const Pushed& run : runs)
      points.push_back({sine_displacement(run.push, beta), run.displacement});
    const Proportion fit = fit_proportion(points);
    if (k == 0 || fit.deviation < best.measured_over_predicted.deviation) best = {beta, fit};
  }
  return best;
}

}  // namespace study
