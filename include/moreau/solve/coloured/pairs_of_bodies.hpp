// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "moreau/core/list.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// The pairs of each body. Members of a team that sum over the pairs of different bodies write to
/// different places, and each sum has the order of the pairs.
class PairsOfBodies {
 public:
  /// A pair of a body.
  struct Entry {
    std::uint32_t pair : 31;
    std::uint32_t is_b : 1;  ///< whether the body is the second body of the pair
  };

  /// @param pairs the two bodies of each pair, fewer than 2^31 pairs
  void assign(std::span<const std::array<std::uint32_t, 2>> pairs, std::size_t body_count) {
    begin_.assign(body_count + 2, 0);
    for (const auto& [a, b] : pairs) ++begin_[a + 2], ++begin_[b + 2];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    entries_.resize(2 * pairs.size());
    // begin_[i + 1] is the next free entry of body i, and at the end the first of body i + 1.
    for (std::uint32_t k = 0; k < pairs.size(); ++k) {
      entries_[begin_[pairs[k][0] + 1]++] = {k & 0x7fffffff, 0};
      entries_[begin_[pairs[k][1] + 1]++] = {k & 0x7fffffff, 1};
    }
  }
  /// Calls use(entry) for all pairs of all bodies: body after body, the pairs in ascending order. The
  /// work is shared by bodies.
  void for_each(const Team& team, const auto& use) const {
    team.run([&](int rank, int size, const TeamBarrier&) {
      const Share share(entries_.size(), rank, size);
      const std::size_t end = first_of_body(share.end);
      for (std::size_t i = first_of_body(share.begin); i < end; ++i) use(entries_[i]);
    });
  }

 private:
  /// The first entry, from `entry` on, that is the first of a body.
  std::size_t first_of_body(std::size_t entry) const {
    return *std::lower_bound(begin_.begin(), begin_.end() - 1, entry);
  }

  List<std::size_t> begin_;  // of each body in entries_; then their number, twice
  List<Entry> entries_;
};

}  // namespace moreau::detail
