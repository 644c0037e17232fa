// SPDX-License-Identifier: MIT
// Sorts pairs of indices, for the broad phases.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "moreau/core/list.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau::detail {

/// Sorts pairs of indices below `count` in linear time: a counting sort by the first index, then,
/// for each first index, a sort of its few pairs by the second index.
class PairSorter {
 public:
  void sort(std::vector<IndexPair>& pairs, std::size_t count) {
    begin_.assign(count + 1, 0);
    for (const IndexPair& pair : pairs) ++begin_[pair.first + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    sorted_.resize(pairs.size());
    next_.assign(begin_.begin(), begin_.end());
    for (const IndexPair& pair : pairs) sorted_[next_[pair.first]++] = pair;
    for (std::size_t i = 0; i < count; ++i) sort_range(begin_[i], begin_[i + 1]);
    pairs.swap(sorted_);
  }

 private:
  void sort_range(std::uint32_t begin, std::uint32_t end) {
    sort_items(std::span(sorted_).subspan(begin, end - begin));
  }

  List<std::uint32_t> begin_, next_;
  std::vector<IndexPair> sorted_;
};

}  // namespace moreau::detail
