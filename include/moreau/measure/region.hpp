// SPDX-License-Identifier: MIT
// The content of a control volume, in one call: solid fraction, stress, and mean velocity of its grains, in the
// plane and in space.
#pragma once

#include <cstddef>

#include "moreau/core/double_sum.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/measure/control_volume.hpp"
#include "moreau/measure/solid_fraction.hpp"
#include "moreau/measure/stress.hpp"

namespace moreau {

/// The state of the grains in a control volume after a step. The stress is that of the contacts: the stress of the
/// fluctuations of velocities, which matters in gases of grains, is not part of it.
template <class S>
struct Region {
  using Scalar = typename S::Scalar;

  std::size_t grains = 0;     ///< number of grains whose centre lies in the control volume
  Scalar solid_fraction = 0;  ///< volume of grains over volume, clipped exactly [-]
  typename S::Matrix stress =
      S::Matrix::Zero();  ///< contact_stress(), compression > 0 [Pa; in the plane N/m]
  typename S::Vector velocity =
      S::Vector::Zero();  ///< momentum over mass of these grains, world axes [m/s]; 0 without
                          ///< grains; relative to a cell that deforms

  Scalar pressure() const {
    return stress.trace() / S::dim;
  }  ///< mean of the normal stresses [Pa; N/m]
};

/// Measures the grains of a simulation in a control volume, also in a periodic cell. Grains whose motion is
/// prescribed count; in the stress they count as walls.
/// @param simulation     a Simulation
/// @param step           length of its last step [s], > 0
/// @param control_volume world axes [m]; for the stress it must end a grain diameter inside the walls, see
///                       contact_stress()
/// @throws std::invalid_argument if the step is not positive, or the control volume is empty, inverted, not
///         finite, or longer than the periodic cell
template <class Simulation>
Region<typename Simulation::S> measure_region(const Simulation& simulation,
                                              typename Simulation::Scalar step,
                                              const Aabb<typename Simulation::S>& control_volume) {
  using S = typename Simulation::S;
  Region<S> region;
  region.stress = contact_stress(simulation, step, control_volume);
  region.solid_fraction = solid_fraction(simulation, control_volume);
  detail::DoubleSum<typename S::Vector> momentum;
  double mass = 0;
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const std::size_t i = simulation.grain(k).index();
    const auto& bodies = simulation.bodies();
    if (!control_volume.contains(
            simulation.cell().image_in(control_volume, bodies.pose[i].position)))
      continue;
    ++region.grains;
    mass += double(bodies.grain_mass[i]);
    momentum += bodies.grain_mass[i] * linear<S>(bodies.velocity[i]);
  }
  if (mass > 0) region.velocity = momentum.over(mass);
  return region;
}

}  // namespace moreau
