// SPDX-License-Identifier: MIT
// The mean stress of an assembly from its contact forces.
#pragma once

#include <cstddef>

#include "moreau/contact/contact.hpp"
#include "moreau/core/double_sum.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/value.hpp"
#include "moreau/measure/control_volume.hpp"
#include "moreau/measure/detail/of_simulation.hpp"

namespace moreau {

/// Love-Weber stress sigma_ij = (1/V) sum over contact points of l_i f_j. Here f is the force on b,
/// and l is the branch vector from the centre of a to the centre of b, both in world axes.
/// Compression is positive. A contact point that lies in the control volume counts with its whole
/// branch vector, even if a centre lies outside. At a wall, which has no centre, the branch vector
/// ends at the contact point. The tensor is symmetric if no grain has an angular acceleration. In
/// the plane it is per unit of thickness.
///
/// The control volume must not end on a wall. Contact points on the wall can then lie outside, because
/// of a gap, an overlap or rounding, and their forces are missing: the stress is too small by up to the
/// ratio of a grain diameter to the length of the control volume. Let the control volume end at least one
/// grain diameter inside the walls. Or let it end beyond all walls of the container and multiply the
/// result by its volume / volume of the container: if the grains are at rest without gravity, this is
/// the stress that follows from the forces on the walls.
/// @param step           length of the step [s], > 0, by which impulses are divided
/// @param control_volume world axes [m]
/// @param position_of    function: index of a body -> its centre of mass in world axes [m]
/// @param is_grain       function: index of a body (BodyId::index()) -> false for a wall or an obstacle
/// @param cell           periodic cell of the simulation. A point is counted if one of its images
///                       lies in the control volume, which must not be longer than the cell. The
///                       positions may be those of any image, because branch vectors are computed
///                       as differences of levers
/// @returns stress tensor, D x D, world axes [Pa], in the plane [N/m]
/// @throws std::invalid_argument if the step is not positive, or the control volume is empty,
///         inverted, not finite, or longer than the periodic cell
/// Source: J. Weber, Bull. Liaison Ponts-et-Chaussees 20 (1966); B. Cambou, C. R. Acad. Sci.
/// (1998).
template <class S, int Rows>
Value<typename S::Matrix> contact_stress(const Contacts<S, Rows>& contacts, typename S::Scalar step,
                                         const Aabb<S>& control_volume, const auto& position_of,
                                         const auto& is_grain, const PeriodicCell<S>& cell = {}) {
  using Vector = typename S::Vector;
  require_positive(step, "contact_stress", "step");
  require_control_volume(control_volume, "contact_stress");
  require_within(cell, control_volume, "contact_stress");
  detail::DoubleSum<typename S::Matrix> sum;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact<S>& contact = contacts.points[c];
    const bool a_is_grain = is_grain(contact.a), b_is_grain = is_grain(contact.b);
    const Vector point = cell.image_in(
        control_volume, a_is_grain ? Vector(position_of(contact.a) + contact.lever_a)
                                   : Vector(position_of(contact.b) + contact.lever_b));
    if (!control_volume.contains(point)) continue;
    Vector branch = Vector::Zero();
    if (a_is_grain) branch += contact.lever_a;
    if (b_is_grain) branch -= contact.lever_b;
    sum += branch * (contact.frame * contacts.impulse(c)).transpose();
  }
  return sum.over(double(step) * double(volume(control_volume)));
}

/// The same for the grains of a simulation and its last step, also in a periodic cell. An obstacle, a grain of prescribed
/// motion, counts as a wall: the forces on it do not balance, and the branch vector ends at the contact point.
/// @param simulation a Simulation
/// @param step       length of its last step [s], > 0
/// @throws std::invalid_argument also if the step is a hundred times longer or shorter than the last one
template <class Simulation>
Value<typename Simulation::S::Matrix> contact_stress(
    const Simulation& simulation, typename Simulation::Scalar step,
    const Aabb<typename Simulation::S>& control_volume) {
  require_positive(step, "contact_stress", "step");
  detail::require_unit_of_step(simulation, step, "contact_stress");
  return contact_stress(simulation.contacts(), step, control_volume,
                        detail::position_in(simulation), detail::free_grain_in(simulation),
                        simulation.cell());
}

}  // namespace moreau
