// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "moreau/core/error.hpp"

namespace moreau {

/// The margin and the other lengths of detection.
template <class T>
struct DetectionLengths {
  T margin;      ///< largest gap at which a contact is made, >= 0 [m]
  T skin;        ///< the list of pairs stays valid for motions of this size, >= 0 [m]
  T resolution;  ///< contact points closer together than this are merged, >= 0 [m]
  T carry;       ///< contacts are carried along up to this relative motion, >= 0 [m]
  T slow = 0;    ///< and if the pair is slower than this, >= 0 [m/s]
};

/// Lengths that act as tolerances, each relative to the grain size [-].
struct Tolerances {
  /// Largest gap at which a contact is made, > 0 (LMGC90 calls it alert distance). Times the grain size
  /// it must exceed the distance by which two bodies approach in a step. See `narrows`.
  double margin = 0.02;
  double skin = 0.05;        ///< the list of pairs is kept until a box has moved this far, >= 0
  double resolution = 1e-3;  ///< contact points closer together than this are merged, >= 0
  /// Whether, under SignoriniCoulomb, Frictionless, RollingResistance and Bonded, pairs that cannot close the margin in
  /// a step have contacts up to a smaller gap, but for cells that deform (detail/step_margins.hpp): the solutions are
  /// the same, and a step has fewer contacts. Off: contacts up to the margin.
  bool narrows = true;
  /// Relative motion of two polyhedra up to which the points of their contact stay where they are in the bodies, in
  /// place of being detected again, >= 0. 0: contacts are detected in every step, exactly. With more, normals are wrong by
  /// up to this over the radius, and points of a contact by up to this across the normal
  /// (detect/carried_contact.hpp); points of a contact that lie within `resolution` of a line between two others are left
  /// out. Of use for structures at rest where speed counts more than accuracy.
  double carry = 0;

  /// The lengths for grains of this size [m].
  template <class T>
  DetectionLengths<T> lengths(T grain_size) const {
    return {static_cast<T>(margin) * grain_size, static_cast<T>(skin) * grain_size,
            static_cast<T>(resolution) * grain_size, static_cast<T>(carry) * grain_size};
  }
  /// Checks the ranges.
  /// @param function the public name the caller used
  /// @throws std::invalid_argument in the name of the function if one of them is not finite or out
  ///         of range
  void check(const char* function) const {
    require_positive(margin, function, "margin");
    require(std::isfinite(skin) && skin >= 0, function, "skin", skin, "must be finite and >= 0");
    require(std::isfinite(resolution) && resolution >= 0, function, "resolution", resolution,
            "must be finite and >= 0");
    require(std::isfinite(carry) && carry >= 0, function, "carry", carry,
            "must be finite and >= 0");
  }
};

}  // namespace moreau
