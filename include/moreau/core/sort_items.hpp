// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

namespace moreau {
namespace detail {

/// Moves an item of a heap down to where none of the items below it comes after it. The heap has `count` items from
/// `first`, those below item k are 2 k + 1 and 2 k + 2.
template <class T, class Less>
void sift_down(T* first, std::size_t k, std::size_t count, const Less& less) {
  T item = std::move(first[k]);
  for (std::size_t below; (below = 2 * k + 1) < count; k = below) {
    if (below + 1 < count && less(first[below], first[below + 1])) ++below;
    if (!less(item, first[below])) break;
    first[k] = std::move(first[below]);
  }
  first[k] = std::move(item);
}

}  // namespace detail

/// Sorts a list, as std::sort(): by insertion up to 16 items, else as a heap. For lists that are short or seldom
/// sorted: it takes up to three times as long as std::sort() for long ones, and is two functions for each type and
/// order, where that is ten.
void sort_items(auto&& items, const auto& less) {
  auto* const first = items.data();
  const std::size_t count = items.size();
  if (count > 16) {
    for (std::size_t k = count / 2; k-- > 0;) detail::sift_down(first, k, count, less);
    for (std::size_t last = count; --last > 0;) {
      std::swap(first[0], first[last]);
      detail::sift_down(first, 0, last, less);
    }
    return;
  }
  for (std::size_t i = 1; i < count; ++i) {
    auto item = std::move(first[i]);
    std::size_t at = i;
    for (; at > 0 && less(item, first[at - 1]); --at) first[at] = std::move(first[at - 1]);
    first[at] = std::move(item);
  }
}
/// The same by operator<.
void sort_items(auto&& items) {
  sort_items(items, std::less<>());
}

}  // namespace moreau
