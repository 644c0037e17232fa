// SPDX-License-Identifier: MIT
// What the wall's trajectory says, period by period.
#pragma once

#include <algorithm>
#include <vector>

#include "active_phase.hpp"
#include "parameters.hpp"

namespace ratcheting {

/// One line of wall.csv, SI units.
struct WallSample {
  double t, f, x, v, f_g;
};

/// One extension of the wall, between two maxima of the force. f is smallest at t = (k + 1/4)/nu
/// and largest at (k + 3/4)/nu. What is active begins where the falling force is the weight of the
/// grains: see ActivePhase.
struct Period {
  double start = 0, finish = 0;  ///< times of the force maxima before and after [s]
  double jam_before = 0;         ///< x_j: position at the force maximum before [m]
  double jam_after = 0;          ///< x_j': position at the force maximum after [m]
  double onset = 0;              ///< a: start of the active motion [s]
  double force_minimum = 0;      ///< time of the minimum of f [s]
  double peak = 0;               ///< b: time of the largest x [s]
  double dx_max = 0;             ///< largest x - jam_before [m]
  double creep = 0;              ///< what x grows before the active phase [m]
  double dx_active = 0;          ///< largest x - x at the beginning of the active phase [m]
  double v_max_active = 0;       ///< largest outward speed in the active phase [m/s]
  double v_max_passive = 0;      ///< largest inward speed after the peak [m/s]
  double f_g_active = 0;  ///< mean force of the grains on the wall while it moves outward in the
                          ///< active phase [N]; nan if it does not

  double delay() const { return peak - force_minimum; }  ///< delta t_r [s]

  /// The active motion ends in the peak, if there is one at all.
  void take(const ActivePhase& phase) {
    onset = std::min(phase.onset, peak);
    creep = phase.creep;
    dx_active = phase.dx;
    v_max_active = phase.v_max;
    f_g_active = phase.thrust;
  }
};

/// Whole periods from the first force maximum on; the first extension is part of the filling
/// transient and is left out.
/// @param weight of the grains, m g [N]
std::vector<Period> find_periods(const std::vector<WallSample>& wall, const Parameters& p,
                                 double weight);

}  // namespace ratcheting
