// SPDX-License-Identifier: MIT
// The part of check() that looks for bodies that cannot move as they are told to, or that move too far in a step.
#pragma once

#include <cstddef>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// Names a body whose force has no effect, a grain that moves by more than a grain size in the step although no contact
/// shows it, and a simulation in which the motion of all bodies is prescribed.
template <class Simulation>
MOREAU_INLINED inline void check_motion(Findings& found, const Simulation& simulation,
                                        const StepReport& report) {
  using S = typename Simulation::S;
  const auto& bodies = simulation.bodies();
  std::size_t in_vain = bodies.size(), fastest = bodies.size();
  double most = double(simulation.grain_size()) / report.step;
  bool any_free = simulation.grain_count() == 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.exists(i)) continue;
    if (bodies.is_prescribed(i)) {
      if (in_vain == bodies.size() && !bodies.force[i].isZero(0)) in_vain = i;
      if (!simulation.is_grain(i)) continue;  // a half-space may move along itself at any speed
    } else {
      any_free = true;
    }
    const auto speed = double(linear<S>(bodies.velocity[i]).norm());
    if (speed > most) fastest = i, most = speed;
  }
  if (in_vain < bodies.size())
    found.say(
        "the force or torque of body % has no effect: its motion is prescribed. Call "
        "set_wall_mass() for a wall, "
        "release() for a grain",
        {double(in_vain)});
  if (fastest < bodies.size() && report.approach <= 1)
    found.say(
        "body % moves by % m in the step, % times the grain size: it can pass through others. Use "
        "a shorter step; if "
        "its velocity of % is in mm/s, type it in m/s",
        {double(fastest), most * report.step, most * report.step / double(simulation.grain_size()),
         most});
  if (!any_free)
    found.say(
        "the motion of all bodies is prescribed, and no force moves one. Call release() for grains "
        "that shall move",
        {});
}

}  // namespace moreau::detail
