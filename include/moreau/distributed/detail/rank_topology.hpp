// SPDX-License-Identifier: MIT
// Which process owns which body, and which processes have copies of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "moreau/core/ids.hpp"

namespace moreau::detail {

/// The bodies of one process. Its grains, the ghosts (grains of other processes that are near) and all
/// walls are numbered in the order of their ids in the whole simulation.
struct RankTopology {
  static constexpr int everywhere = -1;  ///< owner of a wall: every process has it

  int rank = 0;                                    ///< of this process
  std::vector<BodyId> ids;                         ///< in the whole simulation, one per body
  std::vector<int> owner;                          ///< one per body
  std::vector<std::vector<std::uint32_t>> ghosts;  ///< those of each rank, ascending
  /// The grains of this process that are ghosts of each rank, ascending: entry by entry the same bodies
  /// as ghosts[rank] of that process.
  std::vector<std::vector<std::uint32_t>> lent;
  std::vector<std::uint32_t> walls;  ///< ascending

  /// Which of the owners of two bodies, of which one is a grain, has their contacts: the same in both
  /// processes. All contacts across one boundary go to one side, so that only grains of the other side
  /// are shared; the sides take turns from boundary to boundary.
  static int owner_of_contact(int owner_of_a, int owner_of_b) {
    const auto [lower, upper] = std::minmax(owner_of_a, owner_of_b);
    return lower != everywhere && (lower + upper) % 2 == 0 ? lower : upper;
  }
  /// Whether this process has the contacts of a pair of bodies, of which one is a grain.
  bool has_contact(std::uint32_t a, std::uint32_t b) const {
    return owner_of_contact(owner[a], owner[b]) == rank;
  }
};

}  // namespace moreau::detail
