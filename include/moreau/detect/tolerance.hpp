// SPDX-License-Identifier: MIT
// The tolerances of the narrow phase.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

namespace moreau {

/// Lengths that the narrow phase takes for zero, relative to the sum of the circumradii of the pair
/// [-], and a few angles.
template <std::floating_point T>
struct DetectionTolerance {
  /// Difference of two separations that rounding alone can make [-].
  static constexpr T rounding = T(16) * std::numeric_limits<T>::epsilon();
  /// Depth of a point within a tetrahedron, and thickness of the tetrahedron, above which rounding
  /// does not decide on which side of a face the point is [-].
  static constexpr T certain = std::same_as<T, float> ? T(1.4e-3) : T(6e-8);
  /// Two corners of a contact polygon nearer than this are one, and a corner this near to an edge
  /// lies on it [-], so that shapes stacked flush keep their features while they tremble.
  static constexpr T coincident = std::same_as<T, float> ? T(3.5e-4) : T(1.5e-8);
  /// Sine of the angle [-] within which the direction of two nearest points is taken for the normal
  /// of a face that is as far away.
  static constexpr T aligned = std::same_as<T, float> ? T(1e-3) : T(1e-5);
  /// Angle [rad] between two axes above which one can be proved to separate better
  /// (polytope/prove_axis.hpp).
  static constexpr T distinct = std::same_as<T, float> ? T(1e-2) : T(1e-7);
  /// Angle [rad] by which the normal is tilted to find how far a surface is flat, if only its
  /// support function is known. The surface is flat if its farthest point then moves by more than
  /// ten times this angle times the size of the shape's box.
  static constexpr T tilt = T(1e-3);
  /// Difference of two separations that counts as a proof that one is larger [-].
  static constexpr T doubt = T(16) * rounding;
};

}  // namespace moreau
