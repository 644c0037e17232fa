// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "moreau/core/list.hpp"

namespace moreau::detail {

/// The numbers 0 .. n - 1, divided into sets that can be united. Source: R. E. Tarjan, J. van
/// Leeuwen, J. ACM 31 (1984): path halving.
class DisjointSets {
 public:
  DisjointSets() = default;
  explicit DisjointSets(std::size_t n) { assign(n); }
  /// Each of n numbers is a set of its own. Keeps the memory.
  void assign(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  std::size_t size() const { return parent_.size(); }  ///< n
  /// The smallest number of the set of i.
  std::uint32_t find(std::size_t i) {
    auto k = static_cast<std::uint32_t>(i);
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  /// @returns whether they were in two sets
  bool unite(std::size_t i, std::size_t j) {
    const std::uint32_t a = find(i), b = find(j);
    join(a, b);
    return a != b;
  }
  /// unite() of the smallest numbers of two sets.
  /// @returns the smallest number of both
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    if (b < a) std::swap(a, b);
    return parent_[b] = a;
  }

 private:
  List<std::uint32_t> parent_;
};

}  // namespace moreau::detail
