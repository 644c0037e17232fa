// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace study {

/// What a run tells of itself: sample, solver, build. SI units.
struct Facts {
  std::string versions;  ///< of library, Eigen and compiler, one line
  bool settled = false;  ///< in the preparation
  using Range = std::array<std::size_t, 2>;
  std::optional<Range> vertices, faces;                     ///< fewest and most of a grain
  std::vector<std::pair<double, std::size_t>> circumradii;  ///< [m], with the number of grains

  std::size_t steps = 0, capped_steps = 0;
  double mean_sweeps = 0, worst_residual = 0;
  double mean_overlap = 0, max_overlap = 0;  ///< over d

  /// Velocity field at the wall's largest inward speed; nan without one.
  double roll = std::nan(""), roll_strength = std::nan(""), roll_agreement = std::nan("");
};

/// What a run took: another number on another day.
struct WallClock {
  double prepare = 0, vibrate = 0;  ///< [s]
  double median_ms = 0;             ///< of a step
};

}  // namespace study
