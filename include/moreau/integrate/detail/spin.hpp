// SPDX-License-Identifier: MIT
// The motion of one body during a step. Gyroscopic terms are implicit, so that a body without
// torques conserves its angular momentum to rounding.
#pragma once

#include <Eigen/LU>

#include <cstddef>
#include <limits>

#include "moreau/body/bodies.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"

namespace moreau::detail {

/// Moves a body at constant velocity: x becomes x + h v, and q becomes exp(h w) q.
template <class S>
void move(Pose<S>& pose, const typename S::Twist& velocity, typename S::Scalar h) {
  pose.position = along(pose.position, h, linear<S>(velocity));
  pose.rotation = S::normalized(S::exp(h * angular<S>(velocity)) * pose.rotation);
}

/// Solves I(exp(h w) q) w = L for the angular velocity w [rad/s] by Newton's method. The derivative
/// of I(q) w with respect to a rotation is S::gyroscopic_jacobian.
/// @param momentum L, world axes [kg m^2/s]
/// @param start    initial value of the iteration [rad/s]
/// @param h        duration of the rotation [s]
template <class S>
typename S::Angular spin_after(const Bodies<S>& bodies, std::size_t i,
                               const typename S::Angular& momentum,
                               const typename S::Angular& start, typename S::Scalar h) {
  using Scalar = typename S::Scalar;
  const typename S::Rotation& q = bodies.pose[i].rotation;
  typename S::Angular w = start;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const typename S::Inertia inertia = bodies.inertia(i, S::exp(h * w) * q);
    typename S::Angular error = product(inertia, w);
    error -= momentum;
    if (error.norm() <= 2 * std::numeric_limits<Scalar>::epsilon() * momentum.norm()) break;
    typename S::Inertia jacobian = S::gyroscopic_jacobian(inertia, w);
    for (int k = 0; k < S::angular_dim * S::angular_dim; ++k)
      jacobian.data()[k] = inertia.data()[k] + h * jacobian.data()[k];
    const typename S::Inertia inverse = jacobian.inverse();
    w -= product(inverse, error);
  }
  return w;
}

/// The change of velocity h M^-1 F [m/s] by the forces on the centre of mass of body i: gravity,
/// the external force and the force `load` [N].
template <class S>
typename S::Vector kick(const Bodies<S>& bodies, std::size_t i, const typename S::Vector& load,
                        const typename S::Vector& gravity, typename S::Scalar h) {
  const typename S::Matrix r = bodies.axes(i);
  typename S::Vector change = S::Vector::Zero();
  for (int axis = 0; axis < S::dim; ++axis) {
    typename S::Scalar along = 0;
    for (int k = 0; k < S::dim; ++k)
      along += r(k, axis) * (bodies.force[i][k] + load[k] + bodies.weight[i] * gravity[k]);
    for (int k = 0; k < S::dim; ++k)
      change[k] += h * bodies.inverse_mass[i][axis] * along * r(k, axis);
  }
  return change;
}

}  // namespace moreau::detail
