// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <span>

#include "moreau/body/bodies.hpp"

namespace moreau {

/// Moves the bodies through one step in three parts, around the solution of the contacts.
///
/// - predict_configuration(bodies, momentum, h): to where contacts are detected; fills the angular
///   momentum of every body at the start of the step [kg m^2/s].
/// - free_velocity(bodies, gravity, momentum, free, h): velocities at the end without contacts.
/// - advance_configuration(bodies, after, h): to the end of the step with the velocities `after`.
///
/// h is the step [s], gravity an acceleration [m/s^2]; momentum, free and after have one entry per
/// body, velocities are (v, w) [m/s, rad/s]. All in world axes.
template <class I, class S>
concept ImpulseIntegrator = requires(const I integrator, Bodies<S> bodies,
                                     std::span<typename S::Angular> momentum,
                                     std::span<typename S::Twist> free,
                                     std::span<const typename S::Twist> after,
                                     typename S::Vector gravity, typename S::Scalar step) {
  integrator.predict_configuration(bodies, momentum, step);
  integrator.free_velocity(bodies, gravity, momentum, free, step);
  integrator.advance_configuration(bodies, after, step);
};

/// Moves the bodies under contact forces, in two parts around their evaluation.
///
/// - predict_configuration(bodies, loads, gravity, h): to where contacts are detected and forces
///   evaluated, under the loads of the step before.
/// - advance_configuration(bodies, loads, gravity, h): to the end of the step under the new loads.
///
/// A load is (force [N], torque about the centre [N m]) of the contacts on a body, world axes;
/// one per body. h is the step [s], gravity an acceleration [m/s^2].
template <class I, class S>
concept ForceIntegrator = requires(const I integrator, Bodies<S> bodies,
                                   std::span<const typename S::Twist> loads,
                                   typename S::Vector gravity, typename S::Scalar step) {
  integrator.predict_configuration(bodies, loads, gravity, step);
  integrator.advance_configuration(bodies, loads, gravity, step);
};

/// Either kind: impulses for set-valued laws, forces for regularized ones.
template <class I, class S>
concept TimeIntegrator = ImpulseIntegrator<I, S> || ForceIntegrator<I, S>;

}  // namespace moreau
