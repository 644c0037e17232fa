// SPDX-License-Identifier: MIT
// What must hold of every step, also of a problem without a solution.
#pragma once

#include <cmath>

#include "moreau/motion/bodies.hpp"
#include "moreau/world/step_report.hpp"

namespace validation {

/// Whether every number of the report is finite, and whether it says either that the solver has
/// converged or that it has reached its cap.
inline bool is_sane(const moreau::StepReport& report) {
  const moreau::SolveReport& solve = report.solve;
  for (const double value :
       {report.max_overlap, report.mean_overlap, report.dissipation, solve.residual,
        solve.worst_velocity, solve.worst_cone, solve.worst_complementarity,
        solve.wrong_sign_dissipation, report.correction.work, report.correction.largest_shift})
    if (!std::isfinite(value)) return false;
  return solve.converged != solve.capped && solve.residual >= 0;
}

/// Whether all poses and velocities are finite.
template <class S>
bool is_finite(const moreau::Bodies<S>& bodies) {
  for (const auto& pose : bodies.pose)
    if (!pose.is_finite()) return false;
  for (const auto& velocity : bodies.velocity)
    if (!velocity.allFinite()) return false;
  return true;
}

}  // namespace validation
