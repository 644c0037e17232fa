// SPDX-License-Identifier: MIT
// The broad phase that compares every bounding box with every other bounding box.
#pragma once

#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Compares every box with every other box, at a cost of O(n^2). The other broad phases are tested
/// against this class. For a few dozen boxes it is the fastest broad phase.
template <class S>
class AllPairs {
 public:
  /// Replaces the contents of `pairs` by the pairs of boxes that overlap, sorted, each pair once;
  /// see BroadPhase.
  void find_pairs(std::span<const Aabb<S>> boxes, std::vector<IndexPair>& pairs) {
    pairs.clear();
    const auto count = static_cast<std::uint32_t>(boxes.size());
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < count; ++j)
        if (boxes[i].overlaps(boxes[j])) pairs.push_back({i, j});
  }
};

}  // namespace moreau
