// SPDX-License-Identifier: MIT
// The exact volume of that part of a ball, or area of that part of a disk, which lies inside an
// axis-aligned box.
//
// Let G(a, b, c), for a, b, c >= 0, be the volume of the part of the unit ball that lies in
// [0,a] x [0,b] x [0,c]. For other arguments G is continued as an odd function of each argument.
// The volume in a box is then the sum of +-G over the eight corners of the box. As with the limits
// of an integral, the sign is the product of one sign per axis: + for the upper end, - for the
// lower end. For arguments between 0 and 1:
//
//     corner (a, b, c) inside the ball    G = a b c
//     otherwise                           G = pi/6 - C(a) - C(b) - C(c)
//                                             + E(a,b) + E(b,c) + E(c,a)
//
// Here pi/6 is the volume of the octant x, y, z > 0 of the ball. C(a) is the volume of its part
// with x > a, a quarter of a spherical cap. E(a,b) is the volume of its part with x > a and y > b,
// half of a wedge. The part with x > a, y > b and z > c is empty, because the corner is outside of
// the ball. Let s^2 = 1 - a^2 - b^2 > 0. The volume of the half wedge is (W - a A - b B) / 3, where
// W is the area of its spherical surface and A and B are the areas of its flat sides at x = a and y
// = b. The flat sides are halves of circular segments in circles of the radii sqrt(1 - a^2) and
// sqrt(1 - b^2). The Gauss-Bonnet theorem gives W = t - a p - b q with t = atan2(s, a b), p =
// atan2(s, b) and q = atan2(s, a). So
//
//     E = (t + a b s)/3 - (a (3 - a^2) p + b (3 - b^2) q)/6,        C(a) = pi/12 (1-a)^2 (2+a).
//
// For the unit disk, G = a b if the corner is inside the disk. Otherwise G = pi/4 - C(a) - C(b)
// with C(a) = (acos a - a sqrt(1-a^2))/2. The error is a few rounding errors of the volume of the
// whole ball, however small the volume inside the box is.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "moreau/measure/clip.hpp"
#include "moreau/shape/ball.hpp"

namespace moreau {

namespace detail {

/// The area of the part of the unit disk in [0,a] x [0,b], for 0 <= a, b <= 1.
template <class T>
T unit_ball_in_orthant(const Eigen::Matrix<T, 2, 1>& corner) {
  if (corner.squaredNorm() <= 1) return corner.prod();
  T area = std::numbers::pi_v<T> / 4;
  for (const T a : corner) area -= (std::acos(a) - a * std::sqrt((1 - a) * (1 + a))) / 2;
  return area;
}

/// E(a,b) of the formula at the top of this file: the volume of the part of the unit ball with x >
/// a, y > b, z > 0.
template <class T>
T unit_wedge(T a, T b) {
  const T square = 1 - a * a - b * b;
  if (square <= 0) return 0;
  const T s = std::sqrt(square);
  return (std::atan2(s, a * b) + a * b * s) / 3 -
         (a * (3 - a * a) * std::atan2(s, b) + b * (3 - b * b) * std::atan2(s, a)) / 6;
}

/// The volume of the part of the unit ball in [0,a] x [0,b] x [0,c], for 0 <= a, b, c <= 1.
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

/// unit_ball_in_orthant continued to any corner, as an odd function of each coordinate. Coordinates
/// larger than 1 count as 1.
template <class Vector>
typename Vector::Scalar signed_unit_ball_in_orthant(const Vector& corner) {
  using T = typename Vector::Scalar;
  T sign = 1;
  for (const T a : corner) sign = a < 0 ? -sign : sign;
  return sign * unit_ball_in_orthant(Vector(corner.cwiseAbs().cwiseMin(T(1))));
}

}  // namespace detail

/// The volume of that part of a ball (area of a disk) which lies in the control volume [m^D], by
/// the formula at the top of this file. The error is a few rounding errors of the volume of the
/// whole ball. The workspace is not used.
/// @param pose            pose of the ball, world axes [m]
/// @param control_volume  a box in world axes [m]
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
