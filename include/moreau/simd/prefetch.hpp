// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace moreau::detail {

/// Begins to load memory into the cache. It changes no result.
inline void prefetch(const void* from, std::size_t bytes) {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < bytes; at += line)
    __builtin_prefetch(static_cast<const char*>(from) + at);
}
template <class Items>
void prefetch(const Items& items) {
  prefetch(items.data(), items.size() * sizeof(items[0]));
}

}  // namespace moreau::detail
