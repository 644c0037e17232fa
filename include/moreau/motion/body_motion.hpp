// SPDX-License-Identifier: MIT
// The motion of one body during a step. Integrators are made of these functions, also those of a user. A user
// of advance_pose(), velocity_change() and spin_after() gets implicit gyroscopic terms (a body
// without torques conserves its angular momentum to rounding), and walls that move only along the
// axes along which they have an inverse mass.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"

namespace moreau {

/// Moves a body at constant velocity: x becomes x + h v, and q becomes exp(h w) q.
/// @param velocity twist (v, w), world axes [m/s, rad/s]
/// @param h        duration [s]
template <class S>
void advance_pose(Pose<S>& pose, const typename S::Twist& velocity, typename S::Scalar h) {
  pose.position = along(pose.position, h, linear<S>(velocity));
  pose.rotation = S::normalized(S::exp(h * angular<S>(velocity)) * pose.rotation);
}

namespace detail {

/// spin_after() for large rotations: Newton's method with a derivative by differences, whose steps are
/// halved until the error falls.
/// @param momentum in units of the inertia, L times `unit`
/// @param unit     reciprocal_power() of the trace of the inertia
/// @returns the value with the least error of those that were tried
template <class S>
[[gnu::cold, gnu::noinline]] typename S::Angular spin_after_large(
    const Bodies<S>& bodies, std::size_t i, const typename S::Angular& momentum,
    const typename S::Angular& start, typename S::Scalar h, typename S::Scalar unit) {
  using Scalar = typename S::Scalar;
  using Angular = typename S::Angular;
  constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
  const Scalar step = std::sqrt(epsilon) * start.norm();
  Angular best = start, change = Angular::Zero();
  Scalar least = std::numeric_limits<Scalar>::infinity();
  for (int iteration = 0; iteration < 50 && least > 2 * epsilon * momentum.norm(); ++iteration) {
    typename S::Inertia jacobian;
    Angular error;
    // The error at w, then those beside it.
    for (int k = S::angular_dim; k >= 0; --k) {
      Angular w = best - change;
      if (k < S::angular_dim) w[k] += step;
      const Angular other =
          unit * product(bodies.inertia(i, S::exp(h * w) * bodies.pose[i].rotation), w) - momentum;
      if (k < S::angular_dim)
        jacobian.col(k) = (other - error) / step;
      else
        error = other;
    }
    if (error.norm() < least) {
      best -= change;
      least = error.norm();
      change = product(inverse_of(jacobian), error);
    } else {
      change /= 2;
    }
  }
  return best;
}

}  // namespace detail

/// Solves I(exp(h w) q) w = L for the angular velocity w [rad/s] by Newton's method. In body axes, in which
/// I is constant, the equation is I w = exp(-h w) L, because exp(h w) leaves w as it is. The body i must rotate
/// (Bodies::rotates()); q is its rotation in bodies.pose. L is met to rounding for rotations h |w| up to
/// 1.5, also of bodies five times as long as wide; for larger ones w may not meet L, but the error is
/// not above that of `start`.
/// @param momentum L about the centre of mass, world axes [kg m^2/s]
/// @param start    initial value of the iteration [rad/s]
/// @param h        duration of the rotation [s]
template <class S>
typename S::Angular spin_after(const Bodies<S>& bodies, std::size_t i,
                               const typename S::Angular& momentum,
                               const typename S::Angular& start, typename S::Scalar h) {
  using Scalar = typename S::Scalar;
  using Angular = typename S::Angular;
  using Inertia = typename S::Inertia;
  const Inertia axes = S::adjoint(bodies.pose[i].rotation);
  // In units of the inertia: squares of momenta of small and of large bodies could not be represented.
  const Scalar unit = reciprocal_power(bodies.inertia_body[i].trace());
  const Inertia inertia = unit * bodies.inertia_body[i];
  const Angular scaled = unit * momentum, fixed = transposed_product(axes, scaled);
  const Scalar rounding = std::numeric_limits<Scalar>::epsilon() * scaled.norm();
  Angular w = transposed_product(axes, start);
  Inertia inverse = inertia;
  Scalar before = 0;
  for (int iteration = 0; iteration < 10; ++iteration) {
    const Angular turned = product(Inertia(S::adjoint(S::exp(-h * w))), fixed);
    const Angular error = product(inertia, w) - turned;
    const Scalar size = error.norm();
    // After some steps the error may stay at a few rounding errors.
    if (size <= (iteration < 6 ? 2 : 16) * rounding) return product(axes, w);
    // The derivative of small rotations hardly changes from one iteration to the next.
    if (!(size < before / 64)) inverse = inverse_of(Inertia(inertia + h * S::turning(turned)));
    before = size;
    w -= product(inverse, error);
  }
  return detail::spin_after_large<S>(bodies, i, scaled, start, h, unit);
}

/// The change of velocity h M^-1 f of body i, world axes [m/s], by the forces f on its centre of mass:
/// gravity, the external force Bodies::force and the force `load`. It is zero along axes without
/// inverse mass.
/// @param load    a further force, world axes [N]; zero for integrators of impulses
/// @param gravity acceleration, world axes [m/s^2]
/// @param h       duration [s]
template <class S>
typename S::Vector velocity_change(const Bodies<S>& bodies, std::size_t i,
                                   const typename S::Vector& load,
                                   const typename S::Vector& gravity, typename S::Scalar h) {
  const typename S::Matrix r = bodies.axes(i);
  typename S::Vector change = S::Vector::Zero();
  for (int axis = 0; axis < S::dim; ++axis) {
    typename S::Scalar along = 0;
    for (int k = 0; k < S::dim; ++k)
      along += r(k, axis) * (bodies.force[i][k] + load[k] + bodies.grain_mass[i] * gravity[k]);
    for (int k = 0; k < S::dim; ++k)
      change[k] += h * bodies.inverse_mass[i][axis] * along * r(k, axis);
  }
  return change;
}

}  // namespace moreau
