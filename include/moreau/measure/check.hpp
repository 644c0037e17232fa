// SPDX-License-Identifier: MIT
// Settings of a simulation that give results which look right and are wrong.
#pragma once

#include <string>
#include <vector>

#include "moreau/measure/detail/check_report.hpp"
#include "moreau/measure/detail/check_units.hpp"
#include "moreau/measure/detail/lost_grain.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

/// Judges the last step of a simulation.
///
///     for (const std::string& sentence : moreau::check(simulation, report))
///       std::cerr << sentence << '\n';
///
/// @param simulation after step()
/// @param report     what step() returned
/// @returns one sentence with numbers for each of the following faults; empty if there are none:
///          - the surfaces of a contact that was found approached by more than the margin
///            in the step: others may have been missed
///          - the smallest grain is five times smaller or larger than the grain size, to which all
///            tolerances are relative
///          - an overlap beyond 1 % of the grain size: grains were added inside one another, the
///            step is too long, or compliant contacts are too soft; two bodies are named
///          - the displacement of bodies by the overlap correction was limited
///          - the solver did not reach its tolerance
///          - small structures (islands) whose velocities have an error above the tolerance
///          - compliant contacts: the residual is not small against relative_compliance, so that the
///            forces are not accurate to 10 %
///          - numbers that look like other units. With a gravity between 9 and 11 m/s^2: a density below
///            12 (2.7 g/cm^3 are 2700 kg/m^3), grains all wider than 4 m (mm). A density above 25,000, a
///            gravity of 981 or 9810 (cm/s^2, mm/s^2), a friction from 5 to 90 (degrees). A step so
///            long that gravity moves a grain at rest by more than a fifth of its size (ms)
///          - gravity points along the last axis, and no wall and no obstacle lies there
///          - a grain is lost: far from all others, or so far from the origin that the scalar holds its
///            position only to more than a thousandth of the grain size
template <class Simulation>
[[nodiscard]] std::vector<std::string> check(const Simulation& simulation,
                                             const StepReport& report) {
  detail::Findings found;
  detail::check_report(found, report, double(simulation.grain_size()));
  detail::check_units(found, simulation, report.step);
  detail::check_lost(found, simulation);
  return found.sentences;
}

}  // namespace moreau
