// SPDX-License-Identifier: MIT
// The broad phase that compares every box with every other box.
#pragma once

#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Compares every box with every other box in O(n^2). The other broad phases are tested against it,
/// and it is the fastest one for a few dozen boxes.
template <class S>
class AllPairs {
 public:
  /// Fills `pairs` with those whose boxes overlap, sorted; see BroadPhase.
  void find_pairs(std::span<const Aabb<S>> boxes, std::vector<IndexPair>& pairs) {
    pairs.clear();
    const auto count = static_cast<std::uint32_t>(boxes.size());
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < count; ++j)
        if (boxes[i].overlaps(boxes[j])) pairs.push_back({i, j});
  }
};

}  // namespace moreau
