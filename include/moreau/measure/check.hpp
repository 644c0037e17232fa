// SPDX-License-Identifier: MIT
// What would go unseen: settings of a simulation that give results which look right and are wrong.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "moreau/shape/concepts.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau {

/// Judges the last step of a simulation.
/// @param simulation after step()
/// @param report     what step() returned
/// @returns one sentence with numbers for each of the following faults; empty if there are none:
///          - the surfaces of a contact that was found approached by more than the margin
///            in the step: others may have been missed
///          - the smallest grain is five times smaller or larger than the grain size, to which all
///            tolerances are relative (for shapes that have a circumradius())
///          - an overlap beyond 1 % of the grain size: grains were added inside one another, the
///            step is too long, or compliant contacts are too soft
///          - the solver did not reach its tolerance
///          - compliant contacts: the residual is not small against relative_compliance, so that the
///            forces are not accurate to 10 %
template <class Simulation>
[[nodiscard]] std::vector<std::string> check(const Simulation& simulation,
                                             const StepReport& report) {
  std::vector<std::string> found;
  const auto say = [&](const auto&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    found.push_back(text.str());
  };
  const double size = double(simulation.grain_size());
  if (report.approach > 1)
    say("step too long: in one step the surfaces of a contact approach by ", report.approach,
        " times the margin; contacts can be missed. Use a step ", report.approach,
        " times shorter, or a larger margin");
  using Shape = std::decay_t<decltype(simulation.shape_of_grain(0))>;
  if constexpr (HasCircumradius<Shape>) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < simulation.grain_count(); ++k)
      smallest = std::min(smallest, 2 * double(simulation.shape_of_grain(k).circumradius()));
    if (simulation.grain_count() > 0 && !(smallest > 0.2 * size && smallest < 5 * size))
      say("grain size ", size, " m, but the smallest grain has a diameter of ", smallest,
          " m; all tolerances are relative to the grain size");
  }
  if (report.max_overlap > 0.01 * size)
    say("overlap of ", report.max_overlap, " m, ", report.max_overlap / size,
        " of the grain size. Use a shorter step or stiffer contacts, or add grains that do not "
        "overlap");
  if (report.solve.capped)
    say("the solver stopped after ", report.solve.sweeps, " sweeps at a residual of ",
        report.solve.residual, ", above its tolerance");
  if (report.solve.residual > 0.1 * report.relative_compliance && report.relative_compliance > 0)
    say("the residual ", report.solve.residual, " is ",
        report.solve.residual / report.relative_compliance,
        " of the relative compliance 1 / (k h^2 W_nn) = ", report.relative_compliance,
        " of the stiffest contact: its force is known only to about this part. Use a smaller "
        "tolerance, a shorter step or softer contacts");
  return found;
}

}  // namespace moreau
