// SPDX-License-Identifier: MIT
// The exact volume of a ball, and area of a disk, inside an axis-aligned box.
//
// With G(a, b, c) the volume of the unit ball in [0,a] x [0,b] x [0,c], continued as an odd
// function of each argument, the volume in a box is the sum of G over its eight corners, upper ones
// counted as +, lower ones as -, per axis: nothing but the way an integral is taken between limits.
// For 0 <= a, b, c <= 1:
//
//     corner inside the ball    G = a b c
//     else                      G = pi/6 - C(a) - C(b) - C(c) + E(a,b) + E(b,c) + E(c,a)
//
// C(a), the part of the octant with x > a, is a quarter of a cap; E(a,b), that with x > a, y > b,
// is half a wedge; all three at once cannot be when the corner is outside. With s^2 = 1 - a^2 - b^2
// > 0 the wedge is a third of (its spherical surface W - a A - b B): A, B are its flat sides, half
// segments of circles of radius^2 1-a^2, 1-b^2, and the Gauss-Bonnet theorem gives
// W = t - a p - b q, where t = atan2(s, ab), p = atan2(s, b), q = atan2(s, a), so
//
//     E = (t + a b s)/3 - (a (3 - a^2) p + b (3 - b^2) q)/6,        C(a) = pi/12 (1-a)^2 (2+a).
//
// The disk: G = a b, or else pi/4 - C(a) - C(b) with C(a) = (acos a - a sqrt(1-a^2))/2.
// Error: some rounding errors of the volume of the ball, not of the result.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "moreau/measure/clip.hpp"
#include "moreau/shape/ball.hpp"

namespace moreau {

namespace detail {

/// The area of the unit disk in [0,a] x [0,b], 0 <= a, b <= 1.
template <class T>
T unit_ball_in_orthant(const Eigen::Matrix<T, 2, 1>& corner) {
  if (corner.squaredNorm() <= 1) return corner.prod();
  T area = std::numbers::pi_v<T> / 4;
  for (const T a : corner) area -= (std::acos(a) - a * std::sqrt((1 - a) * (1 + a))) / 2;
  return area;
}

/// E(a,b) above: the volume of the unit ball with x > a, y > b, z > 0.
template <class T>
T unit_wedge(T a, T b) {
  const T square = 1 - a * a - b * b;
  if (square <= 0) return 0;
  const T s = std::sqrt(square);
  return (std::atan2(s, a * b) + a * b * s) / 3 -
         (a * (3 - a * a) * std::atan2(s, b) + b * (3 - b * b) * std::atan2(s, a)) / 6;
}

/// The volume of the unit ball in [0,a] x [0,b] x [0,c], 0 <= a, b, c <= 1.
template <class T>
T unit_ball_in_orthant(const Eigen::Matrix<T, 3, 1>& corner) {
  if (corner.squaredNorm() <= 1) return corner.prod();
  T volume = std::numbers::pi_v<T> / 6;
  for (int i = 0; i < 3; ++i) {
    const T a = corner[i], b = corner[(i + 1) % 3];
    volume += unit_wedge(a, b) - std::numbers::pi_v<T> / 12 * (1 - a) * (1 - a) * (2 + a);
  }
  return volume;
}

/// The same with the sign of the corner's orthant, limits beyond the ball allowed.
template <class Vector>
typename Vector::Scalar signed_unit_ball_in_orthant(const Vector& corner) {
  using T = typename Vector::Scalar;
  T sign = 1;
  for (const T a : corner) sign = a < 0 ? -sign : sign;
  return sign * unit_ball_in_orthant(Vector(corner.cwiseAbs().cwiseMin(T(1))));
}

}  // namespace detail

/// The volume of a ball (area of a disk) that lies in the control volume [m^D], by the formula
/// at the top of this file. Exact to some rounding errors of the volume of the ball. The workspace
/// is not used.
/// @param control_volume  in world axes [m]
/// @throws std::invalid_argument if the control volume is empty, inverted or not finite
template <class S>
typename S::Scalar clipped_volume(const BallIn<S>& shape, const Pose<S>& pose,
                                  const Aabb<S>& control_volume, ClipWorkspace<S>&) {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  require_control_volume(control_volume, "clipped_volume");
  const Scalar r = shape.radius();
  const Vector lower = (control_volume.lower - pose.position) / r;
  const Vector upper = (control_volume.upper - pose.position) / r;
  if (lower.maxCoeff() >= 1 || upper.minCoeff() <= -1) return 0;
  if (lower.maxCoeff() <= -1 && upper.minCoeff() >= 1) return shape.volume();
  if (lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).squaredNorm() <= 1) return volume(control_volume);
  Scalar sum = 0;
  for (unsigned bits = 0; bits < 1u << S::dim; ++bits) {
    Vector corner = lower;
    Scalar sign = 1;
    for (int k = 0; k < S::dim; ++k) {
      const bool high = (bits >> k & 1u) != 0;
      if (high) corner[k] = upper[k];
      if (!high) sign = -sign;
    }
    sum += sign * detail::signed_unit_ball_in_orthant(corner);
  }
  Scalar unit = r;
  for (int k = 1; k < S::dim; ++k) unit *= r;
  return std::max(Scalar(0), sum) * unit;
}

}  // namespace moreau
