// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/space.hpp"

namespace moreau::detail {

/// J of one contact for one of its bodies, in double precision: row k is the force and the torque on the body, (D, A) in
/// world axes, of a unit impulse along axis k of the contact frame.
/// @param frame columns n, t[, s], world axes
/// @param lever from the centre of the body to the contact point, world axes [m]
/// @param sign  1 for body b, -1 for body a
template <class S>
MOREAU_INLINED inline Eigen::Matrix<double, S::dim, S::dofs> jacobian_rows(
    const typename S::Matrix& frame, const typename S::Vector& lever, double sign) {
  using Exact = Space<S::dim, double>;
  Eigen::Matrix<double, S::dim, S::dofs> rows;
  typename Exact::Vector arm, axis;
  for (int i = 0; i < S::dim; ++i) arm[i] = double(lever[i]);
  for (int k = 0; k < S::dim; ++k) {
    for (int i = 0; i < S::dim; ++i) rows(k, i) = axis[i] = sign * double(frame(i, k));
    const typename Exact::Angular moment = Exact::moment(arm, axis);
    for (int i = 0; i < S::angular_dim; ++i) rows(k, S::dim + i) = moment[i];
  }
  return rows;
}
/// The same with the rows of the couple / R: row D + k is the torque R e_k, e_k the axes of rotation of the contact frame.
/// @param radius R of the contact [m]
template <class S>
MOREAU_INLINED inline Eigen::Matrix<double, S::dofs, S::dofs> jacobian_rows(
    const typename S::Matrix& frame, const typename S::Vector& lever, double radius, double sign) {
  const Eigen::Matrix<double, S::dim, S::dofs> of_point = jacobian_rows<S>(frame, lever, sign);
  const typename S::Inertia axes = S::angular_frame(frame);
  Eigen::Matrix<double, S::dofs, S::dofs> rows;
  for (int i = 0; i < S::dofs; ++i) {
    for (int k = 0; k < S::dim; ++k) rows(k, i) = of_point(k, i);
    for (int k = 0; k < S::angular_dim; ++k)
      rows(S::dim + k, i) = i < S::dim ? 0 : sign * radius * double(axes(i - S::dim, k));
  }
  return rows;
}

}  // namespace moreau::detail
