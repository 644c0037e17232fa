// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/detail/sort_by_key.hpp"

namespace moreau::detail {

/// An order of boxes in which neighbours in space mostly follow one another: that of their centres on
/// the Z curve (Morton order). If boxes are visited in it, the data of a box and its neighbours are
/// still in the cache from one visit to the next.
template <class S>
class SpatialOrder {
 public:
  void assign(std::span<const Aabb<S>> boxes) {
    order_.clear();
    if (boxes.empty()) return;
    Aabb<S> all = boxes[0];
    for (const Aabb<S>& box : boxes) {
      all.lower = all.lower.cwiseMin(box.lower);
      all.upper = all.upper.cwiseMax(box.upper);
    }
    const typename S::Scalar longest = (all.upper - all.lower).maxCoeff();
    for (std::size_t k = 0; k < boxes.size(); ++k)
      order_.push_back({key(boxes[k], all.lower, longest), static_cast<std::uint32_t>(k)});
    sort_by_key(order_, scratch_);
  }
  std::size_t size() const { return order_.size(); }
  /// The index of the box at a place of the order.
  std::uint32_t operator[](std::size_t place) const { return order_[place].box; }

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t box;
  };

  static std::uint64_t key(const Aabb<S>& box, const typename S::Vector& lower,
                           typename S::Scalar longest) {
    constexpr int bits = 16;
    std::uint64_t key = 0;
    for (int k = 0; k < S::dim; ++k) {
      const double at = double((box.lower[k] + box.upper[k]) / 2 - lower[k]) / double(longest);
      const auto cell = static_cast<std::uint64_t>(std::clamp(at, 0.0, 1.0) * ((1 << bits) - 1));
      for (int bit = 0; bit < bits; ++bit) key |= (cell >> bit & 1) << (S::dim * bit + k);
    }
    return key;
  }

  std::vector<Entry> order_, scratch_;
};

}  // namespace moreau::detail
