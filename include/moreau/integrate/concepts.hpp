// SPDX-License-Identifier: MIT
// The requirements on a time integrator.
#pragma once

#include <concepts>
#include <span>

#include "moreau/body/bodies.hpp"

namespace moreau {

/// Moves the bodies through one step in three parts:
///
/// - predict_configuration(bodies, momentum, h): moves the bodies to the configuration in which
///   contacts are detected; fills the angular momentum of every body at the start of the step
///   [kg m^2/s]
/// - free_velocity(bodies, gravity, momentum, free, h): fills the velocities at the end of the step
///   without contacts
/// - advance_configuration(bodies, after, h): moves the bodies to the end of the step with the
///   velocities `after` the contact impulses
///
/// h is the step [s], gravity an acceleration [m/s^2]. momentum, free and after have one entry per
/// body; velocities are (v, w) [m/s, rad/s]. All are in world axes.
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

/// Moves the bodies under contact forces in two parts:
///
/// - predict_configuration(bodies, loads, gravity, h): moves the bodies to the configuration in
///   which contacts are detected and forces evaluated, under the loads of the step before
/// - advance_configuration(bodies, loads, gravity, h): advances the velocities to the end of the
///   step under the new loads
///
/// A load is the (force [N], torque about the centre [N m]) of all contacts on a body, in world
/// axes; there is one per body. h is the step [s], gravity an acceleration [m/s^2].
template <class I, class S>
concept ForceIntegrator = requires(const I integrator, Bodies<S> bodies,
                                   std::span<const typename S::Twist> loads,
                                   typename S::Vector gravity, typename S::Scalar step) {
  integrator.predict_configuration(bodies, loads, gravity, step);
  integrator.advance_configuration(bodies, loads, gravity, step);
};

/// An integrator of impulses, for set-valued laws, or of forces, for regularized laws.
template <class I, class S>
concept TimeIntegrator = ImpulseIntegrator<I, S> || ForceIntegrator<I, S>;

}  // namespace moreau
