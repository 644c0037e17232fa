// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace moreau::detail {

/// A vector in space of long doubles, with the functions of Eigen's that face_plane uses. Eigen's
/// would be compiled for this function alone. Its sums begin at z, as Eigen's do.
struct LongVector {
  using Scalar = long double;

  long double x = 0, y = 0, z = 0;

  static LongVector Zero() { return {}; }
  long double dot(const LongVector& b) const { return x * b.x + (y * b.y + z * b.z); }
  long double squaredNorm() const { return dot(*this); }
  long double norm() const { return std::sqrt(squaredNorm()); }
  LongVector normalized() const {
    const long double square = squaredNorm();
    return square > 0 ? *this / std::sqrt(square) : *this;
  }
  LongVector cross(const LongVector& b) const {
    return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
  }
  LongVector operator-(const LongVector& b) const { return {x - b.x, y - b.y, z - b.z}; }
  LongVector operator*(long double factor) const { return {x * factor, y * factor, z * factor}; }
  LongVector operator/(long double divisor) const {
    return {x / divisor, y / divisor, z / divisor};
  }
  LongVector& operator+=(const LongVector& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
  LongVector& operator/=(long double divisor) { return *this = *this / divisor; }
};

}  // namespace moreau::detail
