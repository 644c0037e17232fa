// SPDX-License-Identifier: MIT
// The two parts of a generalized velocity (v, w), a generalized force (force, torque) or any other
// vector whose first D entries are linear and whose next A entries are angular.
#pragma once

#include <Eigen/Core>

namespace moreau {

/// The linear part, D entries; a reference into the vector.
/// @tparam S      the space
/// @param  twist  S::Twist, or a longer vector that begins like one
template <class S, class Derived>
auto linear(Eigen::MatrixBase<Derived>& twist) {
  return twist.template head<S::dim>();
}
/// The same of a vector that is only read.
template <class S, class Derived>
auto linear(const Eigen::MatrixBase<Derived>& twist) {
  return twist.template head<S::dim>();
}

/// The angular part, A entries; a reference into the vector.
/// @tparam S      the space
/// @param  twist  S::Twist, or a longer vector that begins like one
template <class S, class Derived>
auto angular(Eigen::MatrixBase<Derived>& twist) {
  return twist.template segment<S::angular_dim>(S::dim);
}
/// The same of a vector that is only read.
template <class S, class Derived>
auto angular(const Eigen::MatrixBase<Derived>& twist) {
  return twist.template segment<S::angular_dim>(S::dim);
}

}  // namespace moreau
