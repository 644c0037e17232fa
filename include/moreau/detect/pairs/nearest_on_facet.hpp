// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <concepts>

namespace moreau::detail {

/// The point of a segment nearest to the origin.
/// @param corners as columns [m]
template <std::floating_point T>
Eigen::Matrix<T, 2, 1> nearest_on_facet(const Eigen::Matrix<T, 2, 2>& corners) {
  const Eigen::Matrix<T, 2, 1> from = corners.col(0), along = corners.col(1) - from;
  return from + std::clamp(-from.dot(along) / along.squaredNorm(), T(0), T(1)) * along;
}
/// The point of a triangle nearest to the origin. Source: C. Ericson, Real-time collision detection
/// (2005), section 5.1.5: the region of the triangle follows from six products.
/// @param corners as columns [m]
template <std::floating_point T>
Eigen::Matrix<T, 3, 1> nearest_on_facet(const Eigen::Matrix<T, 3, 3>& corners) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  const Vector a = corners.col(0), b = corners.col(1), c = corners.col(2), ab = b - a, ac = c - a;
  const T a1 = -ab.dot(a), a2 = -ac.dot(a);
  if (a1 <= 0 && a2 <= 0) return a;
  const T b1 = -ab.dot(b), b2 = -ac.dot(b);
  if (b1 >= 0 && b2 <= b1) return b;
  const T in_c = a1 * b2 - b1 * a2;
  if (in_c <= 0 && a1 >= 0 && b1 <= 0) return a + a1 / (a1 - b1) * ab;
  const T c1 = -ab.dot(c), c2 = -ac.dot(c);
  if (c2 >= 0 && c1 <= c2) return c;
  const T in_b = c1 * a2 - a1 * c2;
  if (in_b <= 0 && a2 >= 0 && c2 <= 0) return a + a2 / (a2 - c2) * ac;
  const T in_a = b1 * c2 - c1 * b2;
  if (in_a <= 0 && b2 >= b1 && c1 >= c2) return b + (b2 - b1) / ((b2 - b1) + (c1 - c2)) * (c - b);
  const T all = in_a + in_b + in_c;
  return a + in_b / all * ab + in_c / all * ac;
}

}  // namespace moreau::detail
