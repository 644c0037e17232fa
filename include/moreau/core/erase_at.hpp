// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>

namespace moreau {

/// Removes the elements whose index satisfies a condition. The order of the other elements and the
/// capacity do not change.
/// @param is_gone function: index before the removal -> whether the element is removed; called once
///                for each element, ascending. It may read the element with its index in `items`
template <class Items>
void erase_at(Items& items, const auto& is_gone) {
  std::size_t left = 0;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (is_gone(k)) continue;
    if (left != k) items[left] = std::move(items[k]);
    ++left;
  }
  items.erase(items.begin() + static_cast<std::ptrdiff_t>(left), items.end());
}

}  // namespace moreau
