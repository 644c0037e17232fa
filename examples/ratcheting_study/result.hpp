// SPDX-License-Identifier: MIT
// What one run says, read from its folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "../ratcheting/periods.hpp"
#include "closed_form.hpp"
#include "facts.hpp"
#include "plan.hpp"

namespace study {

/// Before this time of the first jam of the baseline the box is filling [s].
constexpr double filling_time = 0.15;

/// Means over the periods of a run; nan without one. SI units.
struct Result {
  Case c;
  Facts facts;
  double mass, wall_mass, length, height;
  double weight;  ///< m g [N]

  std::vector<ratcheting::Period> periods;  ///< that begin jammed, at filling_time or after
  double dx_max, dx_spread;                 ///< mean, standard deviation over periods [m]
  double v_max;                             ///< passive, mean [m/s]
  double delay;                             ///< delta t_r [s]
  double dx_active, creep, thrust;          ///< see ActivePhase; thrust: f_a [N]
  double net_contraction;                   ///< (first x_j - last x_j') per period [m]
  std::size_t contracting;                  ///< periods with x_j' < x_j
  double rho_initial, rho_0, rho_final;     ///< inner; rho_0 at 0.2 s [-]
  double box_initial, box_final;            ///< of the whole box [-]
  double rate;                              ///< d rho / (rho_0 dt) from jam to jam [1/s]
  double compaction_per_period;             ///< the same per period [-]
  double constant;                          ///< C of row 17, with m + m_w

  Push push() const;
  double scaled_load() const;  ///< (m g)^2 / ((m + m_w) fmax nu^2) [m]
};

/// @returns nothing if the case is not done
/// @throws std::runtime_error if a file of a complete run cannot be read
std::optional<Result> read_result(const std::filesystem::path& output, const Case& c);

/// All that is done, in the order of the plan.
std::vector<Result> read_results(const std::filesystem::path& output,
                                 const std::vector<Case>& plan);

}  // namespace study
