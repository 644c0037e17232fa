// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace moreau {

/// Calls found(i, j) for all i, j with left[i] == right[j], in ascending order. Each sequence is
/// traversed once.
/// @param left,right sequences with size() and operator[], strictly ascending by operator<, with an operator== that agrees
/// @returns the number of such pairs
std::size_t merge_join(const auto& left, const auto& right, const auto& found) {
  std::size_t count = 0;
  for (std::size_t i = 0, j = 0; i < left.size() && j < right.size();) {
    // Most elements are in both: comparing for equality first takes less time.
    if (left[i] == right[j]) {
      found(i++, j++);
      ++count;
    } else if (left[i] < right[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return count;
}

}  // namespace moreau
