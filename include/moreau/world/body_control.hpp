// SPDX-License-Identifier: MIT
// Write access to the bodies of a simulation: forces, velocities, and whether a motion is prescribed.
#pragma once

#include <cmath>

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/world/body_access.hpp"

namespace moreau {

/// The functions of Simulation that set forces and motions of bodies; Simulation inherits them. They
/// throw std::invalid_argument, which names function, argument and value, for an id that is not of
/// this simulation, or of a grain that was removed, and for a value that is not finite. The simulation
/// is then unchanged.
///
/// A grain whose motion is prescribed is an obstacle: part of a rough floor, an insert, an intruder
/// that is pulled through a bed.
///
///     const moreau::BodyId intruder = simulation.add_grain(shape, pose, 2700);
///     simulation.prescribe_motion(intruder);
///     simulation.set_velocity(intruder, {0.1, 0});
///
/// @tparam ShapeT shape of the grains
template <GrainShape ShapeT>
class BodyControl : public BodyAccess<ShapeT> {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Prescribes the motion of a grain: neither forces nor contacts change its velocity and spin. It
  /// keeps those that it has until set_velocity() and set_spin() set others. It has contacts with
  /// grains that are free and with walls that have a mass. It has none with other bodies of
  /// prescribed motion, and can pass through them.
  ///
  /// contact_impulse() gives the impulse that it received from bodies that move. A contact with another
  /// body of prescribed motion, such as the floor on which it stands, does not exist: no measure and no
  /// list of contacts has it, its force is not determined. Its mass still counts in the measures. No
  /// effect on a grain whose motion is prescribed already.
  /// @throws std::invalid_argument for a body that is not a grain of this simulation
  void prescribe_motion(BodyId grain) {
    assembly_.number_of_grain(grain, "Simulation::prescribe_motion");
    if (assembly_.bodies().is_prescribed(grain.index())) return;
    assembly_.bodies().prescribe_motion(grain.index());
    assembly_.set_changed();
  }
  /// Makes a grain move under forces and contacts again, with its mass and inertia; its velocity does
  /// not change. The inverse of prescribe_motion(). No effect on a grain whose motion is not
  /// prescribed.
  /// @throws std::invalid_argument for a body that is not a grain of this simulation
  void release(BodyId grain) {
    assembly_.number_of_grain(grain, "Simulation::release");
    Bodies<S>& bodies = assembly_.bodies();
    const std::size_t i = grain.index();
    if (!bodies.is_prescribed(i)) return;
    bodies.set_mass(i, bodies.grain_mass[i], bodies.inertia_body[i]);
    assembly_.note_placed(i);
  }
  /// Makes a wall move along one axis as a body of this mass, under set_force() and its contacts: a
  /// half-space along its normal, a mesh wall along the first axis of its frame, which its pose turns.
  /// Gravity does not act on walls. With an infinite mass its motion is prescribed again. No effect on a
  /// wall that has this mass. Two walls have no contact, whatever their masses: they pass through each other.
  /// @param wall a half-space or a mesh wall; a cylinder cannot have a mass
  /// @param mass [kg], > 0
  /// @throws std::invalid_argument for a body that is neither in walls() nor in mesh_walls(), or a mass
  ///         that is not positive
  void set_wall_mass(BodyId wall, Scalar mass) {
    assembly_.require_wall(wall, "Simulation::set_wall_mass");
    require(mass > 0 && std::isfinite(1 / mass), "Simulation::set_wall_mass", "mass", mass,
            "must be > 0, with a finite inverse");
    const Vector inverse = Vector::UnitX() / mass;
    if (assembly_.bodies().inverse_mass[wall.index()] == inverse) return;
    assembly_.bodies().inverse_mass[wall.index()] = inverse;
    assembly_.note_placed(wall.index());
  }
  /// Sets the external force on a body at its centre of mass, world axes [N]. It adds to gravity,
  /// and acts until it is set again. It does not move a body whose motion is prescribed, such
  /// as a wall without set_wall_mass().
  /// @throws std::invalid_argument for a body of another simulation or a force that is not finite
  void set_force(BodyId body, const VectorArgument<S>& force) {
    assembly_.require_body(body, "Simulation::set_force", "force", force);
    linear<S>(assembly_.bodies().force[body.index()]) = force;
  }
  /// Sets the external torque on a body about its centre of mass, world axes [N m]: a vector in space; in
  /// the plane a number, > 0 from x to y. It acts until it is set again. It does not turn a body without
  /// inertia, such as a wall, or one whose motion is prescribed.
  /// @throws std::invalid_argument for a body of another simulation or a torque that is not finite
  void set_torque(BodyId body, const AngularArgument<S>& torque) {
    assembly_.require_body(body, "Simulation::set_torque", "torque", torque);
    angular<S>(assembly_.bodies().force[body.index()]) = torque;
  }
  /// Sets the velocity of the centre, world axes [m/s]. A body whose motion is prescribed, such as
  /// a wall without set_wall_mass(), keeps it. A wall with a mass begins the next step with it, and forces and contacts
  /// change it along the normal: a call before each step would hold a lid back, VelocityDrive leaves this component as it is.
  /// @throws std::invalid_argument for a body that is not of this simulation or a velocity that is
  ///         not finite
  void set_velocity(BodyId body, const VectorArgument<S>& velocity) {
    assembly_.require_body(body, "Simulation::set_velocity", "velocity", velocity);
    linear<S>(assembly_.bodies().velocity[body.index()]) = velocity;
    note_speed_of(body);
  }

  /// Allows deep overlaps of bodies that are added or placed, or refuses them again. Unless they are
  /// allowed, the next step() throws where such a body overlaps another by more than half of the
  /// smallest width of the grain: the centre of a ball then lies inside the other body, and the nearest
  /// exit may lie on its far side. Allowed overlaps are corrected by at most
  /// OverlapCorrectionOptions::max_shift per step. Snapshots contain this setting.
  void allow_overlaps(bool allow = true) { assembly_.allow_overlaps(allow); }

 protected:
  BodyControl() = default;

  using BodyAccess<ShapeT>::assembly_;

  /// The forces of dashpots no longer belong to the velocities. Those on a body whose motion is prescribed,
  /// whose velocity a drive sets in every step, follow in the next step, as its motion does.
  void note_speed_of(BodyId body) {
    if (!assembly_.bodies().inverse_mass[body.index()].isZero(0)) assembly_.set_changed();
  }
};

}  // namespace moreau
