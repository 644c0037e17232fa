// SPDX-License-Identifier: MIT
// The periods of the wall's trajectory.
#pragma once

#include <vector>

#include "active_phase.hpp"
#include "parameters.hpp"

namespace ratcheting {

/// One line of wall.csv, SI units.
struct WallSample {
  double t, f, x, v, f_g;
  double elastic_energy = 0;  ///< of compliant contacts; not in wall.csv
};

/// One extension of the wall, between two maxima of the force. f is smallest at t = (k + 1/4)/nu
/// and largest at (k + 3/4)/nu.
struct Period {
  double start = 0, finish = 0;  ///< times of the force maxima before and after [s]
  double force_minimum = 0;      ///< time of the minimum of f [s]
  double jam_before = 0;         ///< x_j: position at the force maximum before [m]
  double jam_after = 0;          ///< x_j': position at the force maximum after [m]
  double dx_max = 0;             ///< largest x - jam_before [m]
  /// Energy of the springs of compliant contacts at the force maximum before [J].
  double elastic_energy = 0;
  ActivePhase active;  ///< from its onset to its peak

  double delay() const { return active.peak - force_minimum; }             ///< delta t_r [s]
  double x_peak() const { return jam_before + active.drift + active.dx; }  ///< largest x [m]
};

/// The complete periods from the first force maximum on. The extension before it belongs to the
/// filling of the box and is left out.
/// @param weight of the grains, m g [N]
std::vector<Period> find_periods(const std::vector<WallSample>& wall, const Parameters& p,
                                 double weight);

}  // namespace ratcheting
