// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "moreau/core/aabb.hpp"
#include "moreau/core/list.hpp"

namespace moreau::detail {

/// A binary tree over boxes that do not move. A query costs a time proportional to the logarithm of
/// their number and to the number of boxes found.
template <EuclideanSpace S>
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Aabb<S>> boxes) { rebuild(boxes); }
  /// Replaces the boxes; keeps the memory.
  void rebuild(std::span<const Aabb<S>> boxes) {
    nodes_.clear();
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0U);
    if (!boxes.empty()) build(boxes, 0, std::uint32_t(boxes.size()));
  }

  /// Around all boxes; empty without boxes.
  Aabb<S> bounds() const { return nodes_.empty() ? Aabb<S>{} : nodes_[0].box; }

  /// The boxes in the order of the tree: neighbours stand near each other.
  std::span<const std::uint32_t> order() const { return order_; }

  /// Calls use(k) for the places k in order() of boxes that may be wanted.
  /// @param is_wanted function: box around boxes -> whether one of them may be wanted
  template <class IsWanted, class Use>
  void query(const IsWanted& is_wanted, const Use& use) const {
    if (nodes_.empty()) return;
    // The tree halves: 64 levels are more than 2^32 boxes need.
    std::array<std::uint32_t, 64> open;
    std::size_t count = 0;
    open[count++] = 0;
    while (count > 0) {
      const std::uint32_t at = open[--count];
      const Node& node = nodes_[at];
      if (!is_wanted(node.box)) continue;
      if (node.right != 0) {
        open[count++] = node.right;
        open[count++] = at + 1;
      } else {
        for (std::uint32_t k = node.begin; k < node.end; ++k) use(k);
      }
    }
  }

 private:
  static constexpr std::uint32_t leaf = 4;  ///< boxes of a leaf
  /// The first child of an inner node follows it.
  struct Node {
    Aabb<S> box;
    std::uint32_t begin, end, right = 0;  ///< right: second child; 0 for a leaf
  };

  void build(std::span<const Aabb<S>> boxes, std::uint32_t begin, std::uint32_t end) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({{}, begin, end, 0});
    Aabb<S> all, centers;
    for (std::uint32_t k = begin; k < end; ++k) {
      const Aabb<S>& box = boxes[order_[k]];
      all.merge(box.lower);
      all.merge(box.upper);
      centers.merge((box.lower + box.upper) / 2);
    }
    nodes_[at].box = all;
    if (end - begin <= leaf) return;
    int axis = 0;
    (centers.upper - centers.lower).maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto less = [&](std::uint32_t i, std::uint32_t j) {
      const auto x = boxes[i].lower[axis] + boxes[i].upper[axis];
      const auto y = boxes[j].lower[axis] + boxes[j].upper[axis];
      return x < y || (!(y < x) && i < j);
    };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, less);
    build(boxes, begin, middle);
    nodes_[at].right = std::uint32_t(nodes_.size());
    build(boxes, middle, end);
  }

  List<Node> nodes_;
  List<std::uint32_t> order_;
};

}  // namespace moreau::detail
