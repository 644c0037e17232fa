// SPDX-License-Identifier: MIT
// Calls the functions of a TimeIntegrator, with the threads of a team if they take one.
#pragma once

#include <span>

#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// The part of a step that comes after detection [-]; 1/2 of an integrator without theta().
template <class Scalar>
Scalar theta_of(const auto& integrator) {
  if constexpr (requires { integrator.theta(); })
    return Scalar(integrator.theta());
  else
    return Scalar(0.5);
}
/// @param momentum out: angular momentum of every body, world axes [kg m^2/s]
template <class S>
void predict_configuration(const auto& integrator, Bodies<S>& bodies,
                           std::span<typename S::Angular> momentum, typename S::Scalar step,
                           const Team& team) {
  if constexpr (requires { integrator.predict_configuration(bodies, momentum, step, team); })
    integrator.predict_configuration(bodies, momentum, step, team);
  else
    integrator.predict_configuration(bodies, momentum, step);
}
/// @param momentum of predict_configuration()
/// @param free     out: velocity of every body at the end of the step without contacts [m/s, rad/s]
template <class S>
void free_velocity(const auto& integrator, const Bodies<S>& bodies,
                   const typename S::Vector& gravity, std::span<typename S::Angular> momentum,
                   std::span<typename S::Twist> free, typename S::Scalar step, const Team& team) {
  if constexpr (requires { integrator.free_velocity(bodies, gravity, momentum, free, step, team); })
    integrator.free_velocity(bodies, gravity, momentum, free, step, team);
  else
    integrator.free_velocity(bodies, gravity, momentum, free, step);
}
/// @param after velocity of every body after the step [m/s, rad/s]
template <class S>
void advance_configuration(const auto& integrator, Bodies<S>& bodies,
                           std::span<const typename S::Twist> after, typename S::Scalar step,
                           const Team& team) {
  if constexpr (requires { integrator.advance_configuration(bodies, after, step, team); })
    integrator.advance_configuration(bodies, after, step, team);
  else
    integrator.advance_configuration(bodies, after, step);
}

}  // namespace moreau::detail
