// SPDX-License-Identifier: MIT
// Checks of a control volume: the box, at rest in world axes, in which a measure is taken.
#pragma once

#include <sstream>
#include <string>
#include <string_view>

#include "moreau/core/aabb.hpp"
#include "moreau/core/error.hpp"
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
/// @param function the public name the caller used
/// @throws std::invalid_argument naming the function and the box if it is empty, inverted or not
///         finite
template <class S>
void require_control_volume(const Aabb<S>& box, std::string_view function) {
  if (is_control_volume(box)) return;
  throw_invalid(function, "control_volume", detail::describe(box),
                "must be finite with lower < upper on every axis");
}

/// Checks that a control volume lies inside the container of the grains, both in world axes [m].
/// @throws std::invalid_argument naming both boxes if it does not, or if a box is empty, inverted
///         or not finite
template <class S>
void require_inside(const Aabb<S>& control_volume, const Aabb<S>& box) {
  require_control_volume(control_volume, "require_inside");
  require_control_volume(box, "require_inside (the box around)");
  if (box.contains(control_volume)) return;
  throw_invalid("require_inside", "control_volume", detail::describe(control_volume),
                "must lie inside the box " + detail::describe(box));
}

/// The volume of the box, in the plane its area [m^D]; without meaning for an inverted box.
template <class S>
typename S::Scalar volume(const Aabb<S>& box) {
  return (box.upper - box.lower).prod();
}

}  // namespace moreau
