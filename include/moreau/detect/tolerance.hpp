// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

namespace moreau {

/// The lengths that the narrow phase takes for zero, relative to the sum of the two radii [-], and
/// a few angles.
template <std::floating_point T>
struct DetectionTolerance {
  /// Differences of separations that rounding alone can make.
  static constexpr T rounding = T(16) * std::numeric_limits<T>::epsilon();
  /// Depth within a tetrahedron, and thickness of it, above which rounding does not decide on which
  /// side of its faces a point is.
  static constexpr T certain = std::same_as<T, float> ? T(1.4e-3) : T(6e-8);
  /// Two corners of a contact polygon this near are one, and a corner this near an edge lies on
  /// it: so that shapes stacked flush keep their features while they tremble. About 1.5e-8.
  static constexpr T coincident = std::same_as<T, float> ? T(3.5e-4) : T(1.5e-8);
  /// Sine [-] of the angle within which the direction of two nearest points is taken for the normal
  /// of a face, if that face is as far away.
  static constexpr T aligned = std::same_as<T, float> ? T(1e-3) : T(1e-5);
  /// Angle [rad] between two axes above which one can be proved the better (local_proof.hpp).
  static constexpr T distinct = std::same_as<T, float> ? T(1e-2) : T(1e-7);
  /// Angle [rad] by which the normal is tilted to find how far a surface is flat, if nothing but
  /// its support is known. It is flat if its farthest point then moves by more than ten times the
  /// angle times the size of its box.
  static constexpr T tilt = T(1e-3);
  /// Differences of separations that count as a proof.
  static constexpr T doubt = T(16) * rounding;
};

}  // namespace moreau
