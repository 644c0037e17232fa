// SPDX-License-Identifier: MIT
// The linear and the angular part of a generalized velocity (v, w), of a generalized force (force,
// torque), or of any other vector whose first D components are linear and whose next A components
// are angular.
#pragma once

#include <Eigen/Core>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/compiler.hpp"

namespace moreau {

/// The linear part of a vector, D components, as a reference into the vector.
/// @tparam S      the space
/// @param  twist  an S::Twist, or a longer vector that begins with one
template <class S, class Derived>
auto linear(Eigen::MatrixBase<Derived>& twist) {
  return twist.template head<S::dim>();
}
/// The linear part of a constant vector, as a value.
template <class S, class Derived>
Eigen::Matrix<typename Derived::Scalar, S::dim, 1> linear(const Eigen::MatrixBase<Derived>& twist) {
  return twist.template head<S::dim>();
}

/// The angular part of a vector, A components, as a reference into the vector.
/// @tparam S      the space
/// @param  twist  an S::Twist, or a longer vector that begins with one
template <class S, class Derived>
auto angular(Eigen::MatrixBase<Derived>& twist) {
  return twist.template segment<S::angular_dim>(S::dim);
}
/// The angular part of a constant vector, as a value.
template <class S, class Derived>
Eigen::Matrix<typename Derived::Scalar, S::angular_dim, 1> angular(
    const Eigen::MatrixBase<Derived>& twist) {
  return twist.template segment<S::angular_dim>(S::dim);
}

namespace detail {

/// Velocity of a point of a body, world axes [m/s].
/// @param twist (v, w) [m/s, rad/s], or a longer vector that begins with it
/// @param lever from the centre of the body to the point, world axes [m]
template <class S>
MOREAU_INLINED inline typename S::Vector velocity_at(const auto& twist,
                                                     const typename S::Vector& lever) {
  typename S::Vector velocity = S::spin(angular<S>(twist), lever);
  for (int k = 0; k < S::dim; ++k) velocity[k] = twist[k] + velocity[k];
  return velocity;
}

}  // namespace detail

}  // namespace moreau
