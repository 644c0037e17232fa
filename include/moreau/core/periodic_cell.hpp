// SPDX-License-Identifier: MIT
// A periodic cell: a body that leaves the cell on one side enters it on the opposite side.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/value.hpp"

namespace moreau {

/// The periodic axes of the world and the bounds of the cell along them. Until set() is called, no
/// axis is periodic. The images of a point x are x + k length(axis) Unit(axis) for all integers k
/// and all periodic axes.
template <EuclideanSpace S>
class PeriodicCell {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Makes an axis periodic. With infinite bounds the axis becomes open (not periodic) again.
  /// @param axis         0 for x, 1 for y, ...
  /// @param lower,upper  bounds of the cell along this axis [m]
  /// @param function     the public function that the caller of the library called, for error
  ///                     messages
  /// @throws std::invalid_argument if the axis does not exist, or unless lower < upper
  void set(int axis, Scalar lower, Scalar upper, const char* function = "PeriodicCell::set") {
    constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
    require(axis >= 0 && axis < S::dim, function, "axis", axis, "must be an axis of the space");
    const bool opens = lower == -infinity && upper == infinity;
    require(opens || std::isfinite(lower), function, "lower", lower, "must be finite");
    require(opens || (std::isfinite(upper) && upper > lower && std::isfinite(upper - lower)),
            function, "upper", upper, "must be finite and above lower");
    lower_[axis] = opens ? Scalar(0) : lower;
    length_[axis] = opens ? Scalar(0) : upper - lower;
  }

  bool is_open() const { return length_.isZero(0); }  ///< whether no axis is periodic
  /// whether this axis is periodic (0 for x)
  bool is_periodic(int axis) const { return length_[axis] > 0; }
  /// Lengths of the cell along the axes [m]; zero along open axes.
  const Vector& length() const { return length_; }
  /// lower bounds along the axes [m]; zero along open axes
  const Vector& lower() const { return lower_; }

  /// The image of x that lies in the cell, world axes [m].
  [[nodiscard]] Value<Vector> wrap(const VectorArgument<S>& x) const {
    return image_from(lower_, x);
  }
  /// The image y of x with from <= y < from + length() along the periodic axes. Along open axes, y
  /// = x. World axes [m].
  Value<Vector> image_from(const VectorArgument<S>& from, const VectorArgument<S>& x) const {
    Vector y = x;
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis)) {
        const Scalar cells = std::floor((x[axis] - from[axis]) / length_[axis]);
        y[axis] = std::max(from[axis], x[axis] - length_[axis] * cells);
        if (!(y[axis] < from[axis] + length_[axis])) y[axis] = from[axis];  // by rounding
      }
    return y;
  }
  /// The image of x nearest to the point `to`, world axes [m]. Along every periodic axis it is at
  /// most half a cell away.
  Value<Vector> nearest(const VectorArgument<S>& x, const VectorArgument<S>& to) const {
    Vector y = x;
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis))
        y[axis] += length_[axis] * std::round((to[axis] - x[axis]) / length_[axis]);
    return y;
  }

  /// Checks that the cell is longer than twice the width of the widest grain. Then two grains touch
  /// through at most one image, and no grain touches its own image.
  /// @param width    width of the widest grain, including margin and skin [m]
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if the cell is too short
  void require_room(Scalar width, const char* function) const {
    for (int axis = 0; axis < S::dim; ++axis)
      require(!is_periodic(axis) || length_[axis] > 2 * width, function, "length of the cell",
              length_[axis], "must be more than two of the widest grain with margin and skin");
  }
  /// Checks that a plane wall does not bound a periodic axis.
  /// @param normal   normal of the wall, unit, world axes
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if the wall bounds a periodic axis
  void require_along(const VectorArgument<S>& normal, const char* function) const {
    for (int axis = 0; axis < S::dim; ++axis)
      require(!is_periodic(axis) || std::abs(normal[axis]) <= Scalar(1e-5), function, "normal",
              normal, "must be perpendicular to the periodic axes");
  }
  /// Checks that a cylinder wall does not bound a periodic axis.
  /// @param axis     axis of the cylinder, unit, world axes. In the plane it is the normal of the
  ///                 plane, so that the wall bounds all axes
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if the wall bounds a periodic axis
  void require_around(const AngularArgument<S>& axis, const char* function) const {
    for (int k = 0; k < S::dim; ++k)
      require(!is_periodic(k) || S::spin(axis, Vector::Unit(k)).norm() <= Scalar(1e-5), function,
              "axis", axis, "must be parallel to the periodic axes");
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(lower_, length_); }

  Vector lower_ = Vector::Zero(), length_ = Vector::Zero();
};

}  // namespace moreau
