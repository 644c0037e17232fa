// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "moreau/measure/energy.hpp"

namespace scenes {

/// Kinetic energy of all grains of a simulation [J].
template <class Simulation>
double kinetic_energy(const Simulation& simulation) {
  using S = typename Simulation::S;
  const auto& bodies = simulation.bodies();
  return moreau::kinetic_energy<S>(simulation.grain_count(),
                                   [&](std::size_t k) {
                                     const std::size_t i = simulation.grain(k).index();
                                     return moreau::BodyMotion<S>{
                                         bodies.grain_mass[i],
                                         bodies.inertia(i, bodies.pose[i].rotation),
                                         bodies.pose[i].position, bodies.velocity[i]};
                                   })
      .total();
}

}  // namespace scenes
