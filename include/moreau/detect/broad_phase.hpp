// SPDX-License-Identifier: MIT
// The concept of a broad phase, which finds the pairs of boxes that overlap. The classes that model
// it are in the folder broad/.
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

/// A broad phase has a function find_pairs(boxes, pairs). It replaces the contents of `pairs` by
/// all pairs of overlapping boxes, sorted, each pair once. Boxes that only touch count as
/// overlapping. Boxes are in world axes [m]. They must be finite, which is not checked. A broad
/// phase keeps its memory from call to call, so that it allocates only when the number of boxes or
/// pairs exceeds all earlier numbers.
template <class B, class S>
concept BroadPhase = requires(B broad_phase, std::span<const Aabb<S>> boxes,
                              std::vector<IndexPair>& pairs) {
  { broad_phase.find_pairs(boxes, pairs) } -> std::same_as<void>;
};

}  // namespace moreau
