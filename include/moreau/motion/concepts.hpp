// SPDX-License-Identifier: MIT
// The requirements on a time integrator.
#pragma once

#include <span>

#include "moreau/motion/bodies.hpp"

namespace moreau {

/// A time integrator for contact impulses. It advances the bodies by one step in three parts:
///
/// - predict_configuration(bodies, momentum, h): moves the bodies to the configuration in which
///   contacts are detected. Output: the angular momentum of every body at the start of the step [kg
///   m^2/s]
/// - free_velocity(bodies, gravity, momentum, free, h): computes the velocities at the end of the
///   step without contacts
/// - advance_configuration(bodies, after, h): sets the velocities to those after the contact
///   impulses, `after`, and moves the bodies to the end of the step
///
/// h is the step [s], and gravity is an acceleration [m/s^2]. momentum, free and after have one
/// element per body. Velocities are twists (v, w) [m/s, rad/s]. All quantities are in world axes.
///
/// Optional functions, const:
///
/// - theta(): the part of the step that comes after detection [-]. Springs, bonds and cells that deform need it;
///   without it they take 1/2
/// - with_theta(theta): the same integrator with another theta. Springs need it where a step is more than twice as long as
///   the step before (law/compliant.hpp); without it they can produce energy there
///
/// The required functions may take a Team as one more argument, the threads of the simulation.
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

/// A time integrator for contact forces. It advances the bodies by one step in two parts:
///
/// - predict_configuration(bodies, loads, gravity, h): moves the bodies, under the loads of the
///   previous step, to the configuration in which contacts are detected and forces are evaluated
/// - advance_configuration(bodies, loads, gravity, h): advances the velocities to the end of the
///   step under the new loads
///
/// A load is the sum of all contact forces [N] on a body and of their torques about its centre [N
/// m], in world axes. `loads` has one element per body. h is the step [s], and gravity is an
/// acceleration [m/s^2].
template <class I, class S>
concept ForceIntegrator = requires(const I integrator, Bodies<S> bodies,
                                   std::span<const typename S::Twist> loads,
                                   typename S::Vector gravity, typename S::Scalar step) {
  integrator.predict_configuration(bodies, loads, gravity, step);
  integrator.advance_configuration(bodies, loads, gravity, step);
};

/// An integrator of impulses, for set-valued contact laws, or of forces, for regularized contact
/// laws.
template <class I, class S>
concept TimeIntegrator = ImpulseIntegrator<I, S> || ForceIntegrator<I, S>;

}  // namespace moreau
