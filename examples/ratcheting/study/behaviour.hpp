// SPDX-License-Identifier: MIT
// What happens within a period: loops, stresses, roll, solid fraction (rows 7 to 12 and 14).
#pragma once

#include <cmath>
#include <vector>

#include "../periods.hpp"
#include "line.hpp"
#include "table.hpp"

namespace study {

/// Means over the settled periods of a run. SI units.
struct Behaviour {
  double early_share = std::nan("");  ///< x at 0.1 s over x at the first force maximum
  double onset_lead = std::nan("");   ///< from onset to minimum of f, as a share of the period

  double passive_force = std::nan("");  ///< f_g while x falls by 90 % of its way [N]
  double active_slope = std::nan("");   ///< of f_g over x while x grows [N/m]
  double passive_slope = std::nan("");  ///< of f_g over x while x falls so far [N/m]
  double loop_work = std::nan("");      ///< of the grains on the wall, from x_j to x_j' [J]

  double jammed_xx = std::nan(""),
         jammed_zz = std::nan("");  ///< stresses at the force maximum [Pa]
  double active_xx = std::nan(""), active_zz = std::nan("");  ///< while x grows [Pa]
  double roll = std::nan(""), roll_strength = std::nan("");   ///< while x falls [rad/s, -]

  double rho_extension = std::nan("");    ///< inner, change while x grows [-]
  double rho_contraction = std::nan("");  ///< inner, change while x falls by 90 % of its way [-]
  double box_extension = std::nan("");    ///< whole box, change [-]
};

/// The tables of a run: wall.csv, state.csv, packing.csv.
struct Tables {
  Table wall, state, packing;
};

/// @param periods those that are settled
Behaviour behaviour_of(const Tables& run, const std::vector<ratcheting::Period>& periods,
                       double frequency);

/// The mean period in the phase plane, (x - x_j, v), at equal steps of the phase from jam to jam.
/// @returns nothing without a period
std::vector<Point> mean_loop(const Table& wall, const std::vector<ratcheting::Period>& periods);

}  // namespace study
