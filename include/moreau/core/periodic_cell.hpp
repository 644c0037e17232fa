// SPDX-License-Identifier: MIT
// A periodic cell: a body that leaves it on one side enters it on the other side.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// Which axes of the world are periodic, and the bounds of the cell along them. Open along all axes
/// until set() is called. The images of a point x are x + k length(axis) Unit(axis) for all whole
/// k.
template <EuclideanSpace S>
class PeriodicCell {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Makes an axis periodic. Infinite bounds open it again.
  /// @param axis         0 for x, 1 for y, ..
  /// @param lower,upper  bounds of the cell along it [m]
  /// @param function     public name of the caller, for the error
  /// @throws std::invalid_argument for an axis that does not exist, or unless lower < upper
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

  bool is_open() const { return length_.isZero(0); }              ///< whether no axis is periodic
  bool is_periodic(int axis) const { return length_[axis] > 0; }  ///< axis 0 for x
  /// Along every axis [m]; zero where it is open.
  const Vector& length() const { return length_; }
  const Vector& lower() const { return lower_; }  ///< zero where it is open [m]

  /// The image of x in the cell, world axes [m].
  Vector wrap(const VectorArgument<S>& x) const { return image_from(lower_, x); }
  /// The image y of x with from <= y < from + length() on the periodic axes; on the others, x.
  /// World axes [m].
  Vector image_from(const VectorArgument<S>& from, const VectorArgument<S>& x) const {
    Vector y = x;
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis))
        y[axis] = std::max(from[axis], x[axis] - length_[axis] * std::floor((x[axis] - from[axis]) /
                                                                            length_[axis]));
    return y;
  }
  /// The image of x nearest to a point, at most half a cell away along every periodic axis, world
  /// axes [m].
  Vector nearest(const VectorArgument<S>& x, const VectorArgument<S>& to) const {
    Vector y = x;
    for (int axis = 0; axis < S::dim; ++axis)
      if (is_periodic(axis))
        y[axis] += length_[axis] * std::round((to[axis] - x[axis]) / length_[axis]);
    return y;
  }

  /// Checks that the cell is longer than two of the widest grains, so that two grains touch through
  /// one image only, and none touches its own image.
  /// @param width    of a grain and all that is kept around it [m]
  /// @param function the public name the caller used
  /// @throws std::invalid_argument in the name of the function if the cell is too short
  void require_room(Scalar width, const char* function) const {
    for (int axis = 0; axis < S::dim; ++axis)
      require(!is_periodic(axis) || length_[axis] > 2 * width, function, "length of the cell",
              length_[axis], "must be more than two of the widest grain with margin and skin");
  }
  /// Checks that a wall leaves the periodic axes open.
  /// @param normal   of a wall, unit, world axes
  /// @param function the public name the caller used
  /// @throws std::invalid_argument in the name of the function if the wall bounds a periodic axis
  void require_along(const VectorArgument<S>& normal, const char* function) const {
    for (int axis = 0; axis < S::dim; ++axis)
      require(!is_periodic(axis) || std::abs(normal[axis]) <= Scalar(1e-5), function, "normal",
              normal, "must be perpendicular to the periodic axes");
  }
  /// Checks that a cylinder leaves the periodic axes open.
  /// @param axis     of a cylinder, unit, world axes, as that of a rotation: in the plane it bounds
  ///                 all axes
  /// @param function the public name the caller used
  /// @throws std::invalid_argument in the name of the function if it bounds a periodic axis
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
