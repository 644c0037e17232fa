// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "moreau/core/list.hpp"

namespace moreau::detail {

/// Sorts entries by a 64-bit member `key`; entries with equal keys keep their order. A counting sort
/// for each byte that is not the same in all keys.
/// @param scratch memory, kept from call to call
template <class Entry>
void sort_by_key(List<Entry>& entries, List<Entry>& scratch) {
  if (entries.empty()) return;
  std::uint64_t varies = 0;
  for (const Entry& entry : entries) varies |= entry.key ^ entries[0].key;
  scratch.resize(entries.size());
  for (int shift = 0; shift < 64; shift += 8) {
    if ((varies >> shift & 0xff) == 0) continue;
    std::array<std::size_t, 257> begin{};
    for (const Entry& entry : entries) ++begin[(entry.key >> shift & 0xff) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const Entry& entry : entries) scratch[begin[entry.key >> shift & 0xff]++] = entry;
    entries.swap(scratch);
  }
}

}  // namespace moreau::detail
