// SPDX-License-Identifier: MIT
// The broad phase that sorts the boxes along one axis (sweep and prune).
#pragma once

#include <algorithm>
#include <cstddef>

#include "moreau/detect/broad/detail/bulk.hpp"
#include "moreau/detect/broad/detail/sort_pairs.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Sorts the boxes by their lower ends along the axis along which the middle three quarters of their
/// centres are spread most; a few lost grains do not change the choice. Compares each box with the following boxes in this order, up to the first
/// that begins above the end of the box. Suited to at most a few thousand boxes, of any mixture of
/// sizes.
template <class S>
class SweepAndPrune {
 public:
  using Scalar = typename S::Scalar;

  /// Replaces the contents of `pairs` by the pairs of boxes that overlap, sorted, each pair once;
  /// see BroadPhase.
  void find_pairs(std::span<const Aabb<S>> boxes, std::vector<IndexPair>& pairs) {
    pairs.clear();
    if (boxes.empty()) return;
    sort_along(widest_axis(boxes), boxes);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const Entry& entry = order_[i];
      const Aabb<S>& box = boxes[entry.index];
      for (std::size_t j = i + 1; j < order_.size() && order_[j].lower <= entry.upper; ++j) {
        const std::uint32_t other = order_[j].index;
        if (box.overlaps(boxes[other]))
          pairs.push_back({std::min(entry.index, other), std::max(entry.index, other)});
      }
    }
    sorter_.sort(pairs, boxes.size());
  }

 private:
  struct Entry {
    Scalar lower, upper;
    std::uint32_t index;
  };

  static Eigen::Index widest_axis(std::span<const Aabb<S>> boxes) {
    const Aabb<S> middle = detail::middle_of(boxes);
    Eigen::Index axis = 0;
    for (int k = 1; k < S::dim; ++k)
      if (middle.upper[k] - middle.lower[k] > middle.upper[axis] - middle.lower[axis]) axis = k;
    return axis;
  }

  void sort_along(Eigen::Index axis, std::span<const Aabb<S>> boxes) {
    order_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (!detail::has_nan(boxes[i]))  // which overlaps none
        order_.push_back(
            {boxes[i].lower[axis], boxes[i].upper[axis], static_cast<std::uint32_t>(i)});
    std::sort(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) {
      return a.lower != b.lower ? a.lower < b.lower : a.index < b.index;
    });
  }

  std::vector<Entry> order_;
  detail::PairSorter sorter_;
};

}  // namespace moreau
