// SPDX-License-Identifier: MIT
// Opening displacement of the wall under a constant thrust of the grains.
//
// With f = f0 + f1 (1 - cos w t), f0 = fmin, f1 = (fmax - fmin)/2, t from the minimum of f, and a
// constant thrust f_a, the wall of moving mass M starts at -t0, where f falls to f_a,
//     cos w t0 = 1 - (f_a - f0) / f1,
// has the speed
//     M v = (f_a - f0 - f1) (t + t0) + f1 (sin w t + sin w t0) / w,
// and turns where that is zero again. Near the minimum f is a parabola; then it turns at 2 t0, with
//     dx = 0.228 f_a^2 / (M fmax nu^2)          (f0 = 0; 0.228 = 9/(4 pi^2)).
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace study {

/// Force and masses of one run. SI units.
struct Push {
  double thrust, fmin, fmax, frequency, mass, wall_mass;

  /// Of the wall and the share beta of the grains that moves with it [kg].
  double moving_mass(double beta) const { return wall_mass + beta * mass; }
};

/// Opening displacement [m] with the parabola for f.
inline double parabola_displacement(const Push& p, double beta) {
  const double pi = std::numbers::pi, thrust = p.thrust - p.fmin;
  return 9 / (4 * pi * pi) * thrust * thrust /
         (p.moving_mass(beta) * (p.fmax - p.fmin) * p.frequency * p.frequency);
}

/// Motion of the wall under the full sine, for a thrust between the smallest and the mean force.
struct Flight {
  double omega, f1, drift, t0;

  explicit Flight(const Push& p)
      : omega(2 * std::numbers::pi * p.frequency),
        f1((p.fmax - p.fmin) / 2),
        drift(p.thrust - p.fmin - f1),
        t0(std::acos(-drift / f1) / omega) {}

  double momentum(double t) const {  ///< outward [N s]
    return drift * (t + t0) + f1 * (std::sin(omega * t) + std::sin(omega * t0)) / omega;
  }
  /// Integral of the momentum over time: moving mass times displacement [kg m].
  double way(double t) const {
    return drift * (t + t0) * (t + t0) / 2 +
           f1 / omega *
               ((std::cos(omega * t0) - std::cos(omega * t)) / omega +
                std::sin(omega * t0) * (t + t0));
  }
  /// Zero of a decreasing function of time.
  static double crossing(double low, double high, const auto& falls) {
    for (int k = 0; k < 200; ++k) {
      const double middle = (low + high) / 2;
      (falls(middle) > 0 ? low : high) = middle;
    }
    return low;
  }
  double turn()
      const {  ///< the time of the largest displacement; the wall slows down from t0 on [s]
    return crossing(t0, std::numbers::pi / omega + t0, [this](double t) { return momentum(t); });
  }
};

/// Opening displacement [m] with the full sine. Infinite if the thrust is above the mean force (the
/// wall does not return within the period), 0 if the thrust is not above the smallest force.
inline double sine_displacement(const Push& p, double beta) {
  if (!(p.thrust > p.fmin)) return 0;
  if (p.thrust >= (p.fmin + p.fmax) / 2) return std::numeric_limits<double>::infinity();
  const Flight flight(p);
  return flight.way(flight.turn()) / p.moving_mass(beta);
}

}  // namespace study
