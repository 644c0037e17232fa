// SPDX-License-Identifier: MIT
// Axis-aligned bounding box in world axes.
#pragma once

#include <limits>

#include "moreau/core/space.hpp"

namespace moreau {

/// The set lower <= x <= upper [m], world axes; empty (and neutral under merge) as constructed.
template <class S>
struct Aabb {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Least coordinates [m].
  Vector lower = Vector::Constant(std::numeric_limits<Scalar>::infinity());
  /// Largest coordinates [m].
  Vector upper = Vector::Constant(-std::numeric_limits<Scalar>::infinity());

  /// Whether they have a point in common, be it one of the boundary.
  bool overlaps(const Aabb& other) const {
    return (lower.array() <= other.upper.array()).all() &&
           (other.lower.array() <= upper.array()).all();
  }
  /// Whether all points of the other are points of this one.
  bool contains(const Aabb& other) const {
    return (lower.array() <= other.lower.array()).all() &&
           (other.upper.array() <= upper.array()).all();
  }
  /// Grows to hold the point [m].
  void merge(const Vector& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  /// Grown by the margin [m] on every side; shrunk by a negative one.
  Aabb inflated(Scalar margin) const {
    Aabb box = *this;
    box.lower.array() -= margin;
    box.upper.array() += margin;
    return box;
  }
};

}  // namespace moreau
