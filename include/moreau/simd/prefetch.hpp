// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace moreau::detail {

/// Begins to load memory into the cache. It changes no result.
inline void prefetch(const void* from, std::size_t bytes) {
  constexpr std::size_t line = 64;
  for (std::size_t at = 0; at < bytes; at += line)
    __builtin_prefetch(static_cast<const char*>(from) + at);
}
template <class T>
void prefetch(const std::vector<T>& items) {
  prefetch(items.data(), items.size() * sizeof(T));
}

}  // namespace moreau::detail
