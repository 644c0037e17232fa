// SPDX-License-Identifier: MIT
// How far the wall moves out under a constant thrust of the grains, and how fast it comes back.
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

/// The wall's free motion under the full sine, for a thrust between the smallest and the mean
/// force.
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
  /// The integral of the momentum, the moving mass times the place [kg m].
  double way(double t) const {
    return drift * (t + t0) * (t + t0) / 2 +
           f1 / omega *
               ((std::cos(omega * t0) - std::cos(omega * t)) / omega +
                std::sin(omega * t0) * (t + t0));
  }
  /// Where a falling function of time crosses zero.
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

/// Largest displacement [m] by the full sine; infinite if the thrust is above the mean force (the
/// wall does not come back within the period), 0 if it is not above the smallest force.
inline double sine_displacement(const Push& p, double beta) {
  if (!(p.thrust > p.fmin)) return 0;
  if (p.thrust >= (p.fmin + p.fmax) / 2) return std::numeric_limits<double>::infinity();
  const Flight flight(p);
  return flight.way(flight.turn()) / p.moving_mass(beta);
}

/// The thrust that moves the wall out by so much [N]; the thrust of the push is not read.
inline double thrust_of_displacement(Push p, double displacement, double beta) {
  return Flight::crossing(p.fmin, (p.fmin + p.fmax) / 2, [&](double thrust) {
    p.thrust = thrust;
    return displacement - sine_displacement(p, beta);
  });
}

/// Speed on the way back [m/s] where the wall is so far inward of its start, with nothing but the
/// thrust against it; the largest speed of the flight if it does not come so far.
/// @param inward  of the start [m], >= 0
inline double returning_speed(const Push& p, double inward, double beta) {
  const Flight flight(p);
  const double mass = p.moving_mass(beta), period = 2 * std::numbers::pi / flight.omega;
  const double t = Flight::crossing(flight.turn(), period - flight.t0,
                                    [&](double at) { return flight.way(at) / mass + inward; });
  return -flight.momentum(t) / mass;
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
