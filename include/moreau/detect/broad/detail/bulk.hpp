// SPDX-License-Identifier: MIT
// Where most boxes are, whatever a few lost ones do.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/core/aabb.hpp"
#include "moreau/core/sort_items.hpp"

namespace moreau::detail {

/// Whether all numbers of a box are finite, and so far from overflow that their differences are, too.
template <class S>
bool is_regular(const Aabb<S>& box) {
  constexpr auto most = std::numeric_limits<typename S::Scalar>::max() / 4;
  bool regular = true;
  for (int k = 0; k < S::dim; ++k)
    regular = regular && std::abs(box.lower[k]) <= most && std::abs(box.upper[k]) <= most;
  return regular;
}
/// Whether a box has a coordinate that is not a number, so that it overlaps no box.
template <class S>
bool has_nan(const Aabb<S>& box) {
  bool found = false;
  for (int k = 0; k < S::dim; ++k)
    found = found || std::isnan(box.lower[k]) || std::isnan(box.upper[k]);
  return found;
}

/// Along each axis the range in which the middle three quarters of the centres of a sample of the
/// boxes lie [m]. A few boxes that are far away, infinite or not a number do not change it. An empty
/// box if no box is regular.
template <class S>
Aabb<S> middle_of(std::span<const Aabb<S>> boxes) {
  using T = typename S::Scalar;
  constexpr std::size_t most = 64;
  std::array<std::array<T, most>, std::size_t(S::dim)> center;
  std::size_t count = 0;
  for (std::size_t k = 0; k < std::min(boxes.size(), most); ++k) {
    // Scattered, because the order of the boxes may be that of a lattice.
    const std::uint64_t scattered = std::uint32_t(k) * 2654435769U;
    const std::size_t i = boxes.size() <= most ? k : (scattered * boxes.size()) >> 32;
    if (!is_regular(boxes[i])) continue;
    for (int axis = 0; axis < S::dim; ++axis)
      center[std::size_t(axis)][count] = boxes[i].lower[axis] / 2 + boxes[i].upper[axis] / 2;
    ++count;
  }
  Aabb<S> middle;
  for (int axis = 0; axis < S::dim && count > 0; ++axis) {
    auto& x = center[std::size_t(axis)];
    sort_items(std::span(x).first(count));
    middle.lower[axis] = x[count / 8];
    middle.upper[axis] = x[count - 1 - count / 8];
  }
  return middle;
}

}  // namespace moreau::detail
