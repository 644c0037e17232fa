// SPDX-License-Identifier: MIT
// The broad phase that sorts the boxes along one axis (sweep and prune).
#pragma once

#include <algorithm>
#include <cstddef>

#include "moreau/detect/broad/detail/sort_pairs.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Sorts the boxes by their lower ends along the axis on which they spread most, and compares each
/// box with those that begin before it ends. Good for up to a few thousand boxes and any mixture of
/// sizes.
template <class S>
class SweepAndPrune {
 public:
  using Scalar = typename S::Scalar;

  /// Fills `pairs` with those whose boxes overlap, sorted; see BroadPhase.
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
    using Vector = typename S::Vector;
    Vector mean = Vector::Zero(), square = Vector::Zero();
    const Vector origin = boxes[0].lower;
    for (const Aabb<S>& box : boxes) {
      for (int k = 0; k < S::dim; ++k) {
        const Scalar center = (box.lower[k] - origin[k] + box.upper[k] - origin[k]) / 2;
        mean[k] += center;
        square[k] += center * center;
      }
    }
    const auto count = static_cast<Scalar>(boxes.size());
    Eigen::Index axis = 0;
    Vector variance;
    for (int k = 0; k < S::dim; ++k) {
      variance[k] = square[k] / count - mean[k] / count * (mean[k] / count);
      if (variance[k] > variance[axis]) axis = k;
    }
    return axis;
  }

  void sort_along(Eigen::Index axis, std::span<const Aabb<S>> boxes) {
    order_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i)
      order_.push_back({boxes[i].lower[axis], boxes[i].upper[axis], static_cast<std::uint32_t>(i)});
    std::sort(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) {
      return a.lower != b.lower ? a.lower < b.lower : a.index < b.index;
    });
  }

  std::vector<Entry> order_;
  detail::PairSorter sorter_;
};

}  // namespace moreau
