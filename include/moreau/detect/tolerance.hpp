// SPDX-License-Identifier: MIT
// The tolerances of the narrow phase.
#pragma once

#include <concepts>
#include <limits>

namespace moreau {

/// Tolerances of the narrow phase. Lengths below them are treated as zero. Lengths are relative to
/// the sum of the circumradii of the pair [-]; a few tolerances are angles [rad].
template <std::floating_point T>
struct DetectionTolerance {
  /// Largest difference of two computed separations that are equal in exact arithmetic [-].
  static constexpr T rounding = T(16) * std::numeric_limits<T>::epsilon();
  /// The result that a point lies inside a tetrahedron is certain, despite rounding errors, if both
  /// the depth of the point below each face and the thickness of the tetrahedron exceed this [-].
  static constexpr T certain = std::same_as<T, float> ? T(1.4e-3) : T(6e-8);
  /// Two corners of a contact polygon closer together than this count as one corner, and a corner
  /// this close to an edge lies on the edge [-]. So the features of shapes stacked flush do not
  /// change when the shapes vibrate.
  static constexpr T coincident = std::same_as<T, float> ? T(3.5e-4) : T(1.5e-8);
  /// If the direction between two nearest points differs from the normal of a face at the same
  /// distance by an angle with a smaller sine [-], the normal of the face is used.
  static constexpr T aligned = std::same_as<T, float> ? T(1e-3) : T(1e-5);
  /// Least angle [rad] between two axes above which it can be proved which of them separates the shapes
  /// by more (polytope/prove_axis.hpp).
  static constexpr T distinct = std::same_as<T, float> ? T(5e-4) : T(1e-7);
  /// Angle [rad] by which the normal is tilted to measure the flat part of a surface of which only
  /// the support function is known. The surface counts as flat if its support point then moves by
  /// more than ten times this angle times the size of the shape's bounding box.
  static constexpr T tilt = T(1e-3);
  /// If two computed separations differ by more than this [-], rounding errors cannot have changed
  /// their order.
  static constexpr T doubt = T(16) * rounding;
};

}  // namespace moreau
