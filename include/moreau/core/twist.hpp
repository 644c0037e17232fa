// SPDX-License-Identifier: MIT
// The linear and the angular part of a generalized velocity (v, w), of a generalized force (force,
// torque), or of any other vector whose first D components are linear and whose next A components
// are angular.
#pragma once

#include <Eigen/Core>

#include "moreau/core/compiler.hpp"

namespace moreau {

/// The linear part of a vector, D components, as a reference into the vector.
/// @tparam S      the space
/// @param  twist  an S::Twist, or a longer vector that begins with one
template <class S, class Derived>
auto linear(Eigen::MatrixBase<Derived>& twist) {
  return twist.template head<S::dim>();
}
/// The linear part of a constant vector.
template <class S, class Derived>
auto linear(const Eigen::MatrixBase<Derived>& twist) {
  return twist.template head<S::dim>();
}

/// The angular part of a vector, A components, as a reference into the vector.
/// @tparam S      the space
/// @param  twist  an S::Twist, or a longer vector that begins with one
template <class S, class Derived>
auto angular(Eigen::MatrixBase<Derived>& twist) {
  return twist.template segment<S::angular_dim>(S::dim);
}
/// The angular part of a constant vector.
template <class S, class Derived>
auto angular(const Eigen::MatrixBase<Derived>& twist) {
  return twist.template segment<S::angular_dim>(S::dim);
}

}  // namespace moreau
