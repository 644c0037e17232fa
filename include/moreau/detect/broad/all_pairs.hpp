// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Every box against every other, O(n^2): the truth that the other broad phases are tested against,
/// and the fastest for a few dozen boxes.
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
