// SPDX-License-Identifier: MIT
// The concept of a broad phase, which finds the pairs of boxes that overlap. Models are in broad/.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/aabb.hpp"

namespace moreau {

/// Two boxes by their indices in the input; first < second.
struct IndexPair {
  std::uint32_t first;   ///< index of a box
  std::uint32_t second;  ///< index of another box, greater
  friend constexpr auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

/// find_pairs replaces the contents of `pairs` by all pairs of overlapping boxes (boxes that touch
/// overlap), sorted, each once. Boxes are in world axes [m] and must be finite, which is not
/// checked. Memory is kept: no allocation once it has grown.
template <class B, class S>
concept BroadPhase = requires(B broad_phase, std::span<const Aabb<S>> boxes,
                              std::vector<IndexPair>& pairs) {
  { broad_phase.find_pairs(boxes, pairs) } -> std::same_as<void>;
};

}  // namespace moreau
