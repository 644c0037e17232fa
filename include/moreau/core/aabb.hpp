// SPDX-License-Identifier: MIT
// Axis-aligned bounding box in world axes.
#pragma once

#include <algorithm>
#include <limits>
#include <tuple>

#include "moreau/core/components.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// The box of all points x with lower <= x <= upper [m], world axes.
template <EuclideanSpace S>
struct Aabb {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Smallest coordinates [m].
  VectorArgument<S> lower = Vector::Constant(std::numeric_limits<Scalar>::infinity());
  /// Largest coordinates [m].
  VectorArgument<S> upper = Vector::Constant(-std::numeric_limits<Scalar>::infinity());

  Aabb() = default;  ///< An empty box. After calls of merge(), it is the bounding box of the merged
                     ///< points.
  /// A box with the given smallest and largest coordinates [m].
  Aabb(const VectorArgument<S>& least, const VectorArgument<S>& largest)
      : lower(least), upper(largest) {}

  /// Whether the two boxes have a common point. Boxes that only touch have a common point.
  bool overlaps(const Aabb& other) const {
    bool overlap = true;
    for (int k = 0; k < S::dim; ++k)
      overlap = overlap && lower[k] <= other.upper[k] && other.lower[k] <= upper[k];
    return overlap;
  }
  /// Whether every point of `other` lies in this box.
  bool contains(const Aabb& other) const {
    bool contains = true;
    for (int k = 0; k < S::dim; ++k)
      contains = contains && lower[k] <= other.lower[k] && other.upper[k] <= upper[k];
    return contains;
  }
  /// Whether the point [m] lies in this box.
  bool contains(const VectorArgument<S>& x) const {
    bool contains = true;
    for (int k = 0; k < S::dim; ++k) contains = contains && lower[k] <= x[k] && x[k] <= upper[k];
    return contains;
  }
  /// Extends the box so that it contains the point [m].
  void merge(const VectorArgument<S>& x) {
    for (int k = 0; k < S::dim; ++k) {
      lower[k] = std::min(lower[k], x[k]);
      upper[k] = std::max(upper[k], x[k]);
    }
  }
  /// The box with every face moved outwards by the margin [m]; inwards if the margin is negative.
  Aabb inflated(Scalar margin) const {
    Aabb box = *this;
    for (int k = 0; k < S::dim; ++k) {
      box.lower[k] -= margin;
      box.upper[k] += margin;
    }
    return box;
  }
  /// The box moved by a shift [m].
  Aabb moved(const VectorArgument<S>& shift) const { return {lower + shift, upper + shift}; }

  auto serialized_members() { return std::tie(lower, upper); }  ///< see core/serialize.hpp
};

/// The volume of a box, in the plane its area [m^D]. For an inverted box the result has no meaning.
template <class S>
typename S::Scalar volume(const Aabb<S>& box) {
  return (box.upper - box.lower).prod();
}

/// The box around a box of a body's frame, for a body at this pose [m].
template <class S>
Aabb<S> box_around(const Aabb<S>& box_body, const Pose<S>& pose) {
  using Vector = typename S::Vector;
  const typename S::Matrix absolute = pose.rotation.toRotationMatrix().cwiseAbs();
  const Vector half = product(absolute, box_body.upper - box_body.lower) / 2;
  const Vector center = pose((box_body.lower + box_body.upper) / 2);
  return {center - half, center + half};
}

}  // namespace moreau
