// SPDX-License-Identifier: MIT
// Checks of a control volume: the axis-aligned box, fixed in world axes, in which a quantity is
// measured.
#pragma once

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/small_matrix.hpp"

namespace moreau {

namespace detail {

template <class S>
std::string describe(const Aabb<S>& box) {
  static const Eigen::IOFormat row(9, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  std::ostringstream text;
  text << '[' << box.lower.transpose().format(row) << ", " << box.upper.transpose().format(row)
       << ']';
  return text.str();
}

}  // namespace detail

/// Whether the box has finite corners and a positive volume.
template <class S>
bool is_control_volume(const Aabb<S>& box) {
  return all_finite(box.lower) && all_finite(box.upper) &&
         (box.lower.array() < box.upper.array()).all();
}

/// Checks a control volume.
/// @param box      world axes [m]
/// @param function the public function that the caller of the library called, for the message
/// @throws std::invalid_argument naming the function and the box if the box is empty, inverted or
///                               not finite
template <class S>
void require_control_volume(const Aabb<S>& box, std::string_view function) {
  if (is_control_volume(box)) return;
  throw_invalid(function, "control_volume", detail::describe(box),
                "must be finite with lower < upper on every axis");
}

/// Checks that a control volume is not longer than a periodic cell, so that at most one image of a point
/// lies in it. The lower side of the next image may lie on its upper side. In a cell given by vectors, an
/// oblique one, a box is "longer" already if it is wider than PeriodicCell::fits() says.
/// @throws std::invalid_argument naming the function and the control volume
template <class S>
void require_within(const PeriodicCell<S>& cell, const Aabb<S>& control_volume,
                    std::string_view function) {
  using Scalar = typename S::Scalar;
  constexpr Scalar rounding = 8 * std::numeric_limits<Scalar>::epsilon();
  if (cell.is_lattice()) {
    if (!cell.fits(control_volume.upper - control_volume.lower, rounding))
      throw_invalid(function, "control_volume", detail::describe(control_volume),
                    "must not be longer than the periodic cell");
    return;
  }
  for (int axis = 0; axis < S::dim; ++axis) {
    const Scalar lower = control_volume.lower[axis], upper = control_volume.upper[axis];
    if (cell.is_periodic(axis) &&
        upper - lower > cell.length()[axis] + rounding * (std::abs(lower) + std::abs(upper)))
      throw_invalid(function, "control_volume", detail::describe(control_volume),
                    "must not be longer than the periodic cell");
  }
}

/// Checks that a control volume lies inside the container of the grains. Both are boxes in world
/// axes [m].
/// @throws std::invalid_argument naming both boxes if the control volume does not lie inside, or if
///                               a box is empty, inverted or not finite
template <class S>
void require_inside(const Aabb<S>& control_volume, const Aabb<S>& box) {
  require_control_volume(control_volume, "require_inside");
  require_control_volume(box, "require_inside (the box around)");
  if (box.contains(control_volume)) return;
  throw_invalid("require_inside", "control_volume", detail::describe(control_volume),
                "must lie inside the box " + detail::describe(box));
}

}  // namespace moreau
