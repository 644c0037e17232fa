// SPDX-License-Identifier: MIT
// When the sweeps of a solver end.
#pragma once

#include <algorithm>

#include "moreau/core/error.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau {

/// Which quantity must fall below the tolerance.
enum class StopTest {
  natural_map,  ///< SolveReport::residual
  /// LMGC90's criterion: quad_dv, quad_dvr <= tolerance and maxm_dv, maxm_dvr <= 16.67 tolerance.
  /// It measures the change per sweep, not the error: it can stop before the residual does, or after it.
  qm16,
};

/// LMGC90's criterion QM/16, evaluated on a report.
/// @param tolerance relative [-]
inline bool passes_qm16(const SolveReport& report, double tolerance) {
  return std::max(report.quad_dv, report.quad_dvr) <= tolerance &&
         std::max(report.maxm_dv, report.maxm_dvr) <= 16.67 * tolerance;
}

namespace detail {

/// Whether the remaining approach velocity is small enough for a solution to count as converged.
inline bool is_closed(const SolveReport& report) {
  return report.relative_approach <= SolveReport::max_relative_approach;
}

/// @param solver the public name that the exception gives
/// @throws std::invalid_argument if a tolerance or a count is out of range
void require_stopping(const auto& options, const char* solver) {
  require_positive(options.tolerance, solver, "tolerance");
  require(options.max_sweeps >= 1, solver, "max_sweeps", options.max_sweeps, "must be at least 1");
  require(options.check_interval >= 1, solver, "check_interval", options.check_interval,
          "must be at least 1");
}

}  // namespace detail

}  // namespace moreau
