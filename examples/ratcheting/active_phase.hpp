// SPDX-License-Identifier: MIT
// The opening displacement of the wall in a period, without the numerical drift of the jammed wall.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace ratcheting {

/// Fit of the force of the grains on the wall as a function of the wall's acceleration a: a
/// constant thrust minus the inertia of the grains that move along, f_g = thrust - mass a. nan if
/// there is no fit. SI units.
struct CarriedGrains {
  double thrust = std::nan("");     ///< [N]
  double mass = std::nan("");       ///< [kg]
  double explained = std::nan("");  ///< share of the variance of f_g that the fit explains
};

/// Fit by least squares over the steps first..last.
inline CarriedGrains carried_grains(const std::vector<double>& t, const std::vector<double>& v,
                                    const std::vector<double>& f_g, std::size_t first,
                                    std::size_t last) {
  const std::size_t begin = std::max<std::size_t>(first, 1);
  if (last < begin + 2) return {};
  const auto acceleration = [&](std::size_t k) { return (v[k] - v[k - 1]) / (t[k] - t[k - 1]); };
  const double n = double(last - begin + 1);
  double a = 0, f = 0;
  for (std::size_t k = begin; k <= last; ++k) {
    a += acceleration(k) / n;
    f += f_g[k] / n;
  }
  double aa = 0, af = 0, ff = 0;
  for (std::size_t k = begin; k <= last; ++k) {
    const double da = acceleration(k) - a, df = f_g[k] - f;
    aa += da * da;
    af += da * df;
    ff += df * df;
  }
  if (!(aa > 0 && ff > 0)) return {};
  return {f - af / aa * a, -af / aa, af * af / (aa * ff)};
}

/// The outward motion of the wall in a period. It is measured from the time when the falling force
/// equals the weight of the grains: the force is then still above the force of the grains on the
/// moving wall, so motion before this time is numerical drift. SI units.
struct ActivePhase {
  double drift = 0;   ///< numerical drift of the jammed wall: x at this time - x_j
  double dx = 0;      ///< opening displacement: largest x later - x at this time
  double thrust = 0;  ///< mean f_g while the wall moves out at more than a fifth of its largest
                      ///< outward speed; nan if it does not move out
  double onset = 0;   ///< start of the motion that leads to the largest x without a stop [s]
  double peak = 0;    ///< time of the largest x [s]
  double v_out = 0;   ///< largest outward speed before the peak
  double v_in = 0;    ///< largest inward speed after the peak
  /// Time of this speed [s]. Lines of the study's table written by earlier versions do not have it.
  std::optional<double> v_in_time;
  CarriedGrains carried;  ///< fit from onset to peak
};

/// Time between the moment when f falls below the weight and the minimum of f [s]: at most half a
/// period, 0 if f is never below the weight.
inline double time_before_minimum(double weight, double fmin, double fmax, double frequency) {
  const double share = std::clamp((weight - fmin) / (fmax - fmin), 0.0, 1.0);
  return std::acos(1 - 2 * share) / (2 * std::numbers::pi * frequency);
}

/// @param t,x,v,f_g        of the run, by rising t
/// @param start,from,finish force maximum before, where the phase begins, force maximum after [s]
inline ActivePhase active_phase(const std::vector<double>& t, const std::vector<double>& x,
                                const std::vector<double>& v, const std::vector<double>& f_g,
                                double start, double from, double finish) {
  const auto index = [&](double time) {
    const auto at = std::lower_bound(t.begin(), t.end() - 1, time - 1e-9);
    return std::size_t(at - t.begin());
  };
  const std::size_t jam = index(start), first = index(from), last = index(finish);
  std::size_t peak = first;
  for (std::size_t k = first; k <= last; ++k)
    if (x[k] > x[peak]) peak = k;
  ActivePhase phase;
  phase.drift = x[first] - x[jam];
  phase.dx = x[peak] - x[first];
  phase.peak = t[peak];
  for (std::size_t k = first; k <= peak; ++k) phase.v_out = std::max(phase.v_out, v[k]);
  for (std::size_t k = peak; k <= last; ++k)
    if (-v[k] > phase.v_in) {
      phase.v_in = -v[k];
      phase.v_in_time = t[k];
    }
  const double halfway = (x[first] + x[peak]) / 2;
  std::size_t onset = peak, moving = 0;
  while (onset > first && (x[onset - 1] > halfway || v[onset - 1] > 0.05 * phase.v_out)) --onset;
  phase.onset = t[onset];
  for (std::size_t k = first; k <= peak; ++k) {
    if (!(v[k] > 0.2 * phase.v_out)) continue;
    phase.thrust += f_g[k];
    ++moving;
  }
  phase.thrust = moving > 0 ? phase.thrust / double(moving) : std::nan("");
  phase.carried = carried_grains(t, v, f_g, onset + 1, peak);
  return phase;
}

}  // namespace ratcheting
