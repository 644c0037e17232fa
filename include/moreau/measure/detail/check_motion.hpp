// SPDX-License-Identifier: MIT
// The part of check() that looks for bodies that cannot move as they are told to, or that move too far in a step.
#pragma once

#include <cstddef>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/measure/detail/check_report.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// Names a wall with a mass that has passed another one.
template <class Simulation>
MOREAU_INLINED inline void check_walls(Findings& found, const Simulation& simulation) {
  using Vector = typename Simulation::S::Vector;
  using Scalar = typename Simulation::S::Scalar;
  const auto& bodies = simulation.bodies();
  for (const BodyId wall : simulation.walls())
    for (const BodyId other : simulation.walls()) {
      const std::size_t i = wall.index(), k = other.index();
      const Vector normal = bodies.axes(i).col(0), facing = bodies.axes(k).col(0);
      const Vector way = bodies.pose[k].position - bodies.pose[i].position;
      if (bodies.is_prescribed(i) || normal.dot(way) >= 0 || normal.dot(facing) >= Scalar(-0.9999))
        continue;
      return found.say(
          "wall % has passed wall %, which it faces: two walls never touch, whatever their masses",
          {double(i), double(k)});
    }
}

/// Names a body whose force has no effect, or only a part of it, a grain that moves by more than a grain size in the step
/// although no contact shows it, and a simulation in which the motion of all
/// bodies is prescribed.
template <class Simulation>
MOREAU_INLINED inline void check_motion(Findings& found, const Simulation& simulation,
                                        const StepReport& report) {
  using S = typename Simulation::S;
  using Vector = typename S::Vector;
  using Scalar = typename S::Scalar;
  const auto& bodies = simulation.bodies();
  const auto normal_of = [&](std::size_t wall) -> Vector { return bodies.axes(wall).col(0); };
  std::size_t in_vain = bodies.size(), fastest = bodies.size();
  double most = double(simulation.grain_size()) / report.step;
  bool any_free = simulation.grain_count() == 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies.exists(i)) continue;
    if (!bodies.rotates(i)) {
      // The motion of a wall with a mass is prescribed but for its normal, the first of its axes.
      const bool moves = !bodies.inverse_mass[i].isZero(0);
      Vector force = linear<S>(bodies.force[i]);
      const Scalar rounding = moves ? Scalar(1e-3) * force.norm() : Scalar(0);
      if (moves) force -= force.dot(normal_of(i)) * normal_of(i);
      if (in_vain == bodies.size() &&
          (force.norm() > rounding || !angular<S>(bodies.force[i]).isZero(0)))
        in_vain = i;
      any_free = any_free || moves;
      if (!moves && !simulation.is_grain(i))
        continue;  // a half-space may move along itself at any speed
    } else {
      any_free = true;
    }
    const auto speed = double(linear<S>(bodies.velocity[i]).norm());
    if (speed > most) fastest = i, most = speed;
  }
  check_walls(found, simulation);
  if (in_vain < bodies.size())
    found.say(
        bodies.is_prescribed(in_vain)
            ? "the force or torque of body % has no effect: its motion is prescribed. Call "
              "set_wall_mass() for a wall, release() for a grain"
            : "the force or torque of body % has no effect, or a part of it: a wall with a mass "
              "moves along its normal only",
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
