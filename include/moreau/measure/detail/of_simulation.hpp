// SPDX-License-Identifier: MIT
// Questions of measures to a simulation: where a body is, and whether it is a grain.
#pragma once

#include <cstddef>

namespace moreau::detail {

/// Simulation::require_unit_of_step(), of a simulation that has it.
template <class Simulation>
void require_unit_of_step(const Simulation& simulation, typename Simulation::Scalar step,
                          const char* function) {
  if constexpr (requires { simulation.require_unit_of_step(step, function); })
    simulation.require_unit_of_step(step, function);
}

/// Function: index of a body -> its centre of mass in world axes [m]. Refers to the simulation.
template <class Simulation>
auto position_in(const Simulation& simulation) {
  return [&bodies = simulation.bodies()](std::size_t body) -> const typename Simulation::Vector& {
    return bodies.pose[body].position;
  };
}

/// Function: index of a body -> false for a wall. Refers to the simulation.
template <class Simulation>
auto grain_in(const Simulation& simulation) {
  return [&simulation](std::size_t body) { return simulation.is_grain(body); };
}

/// Function: index of a body -> false for a wall or an obstacle, a grain of prescribed motion. Refers to the simulation.
template <class Simulation>
auto free_grain_in(const Simulation& simulation) {
  return [&simulation](std::size_t body) {
    return simulation.is_grain(body) && !simulation.bodies().is_prescribed(body);
  };
}

}  // namespace moreau::detail
