// SPDX-License-Identifier: MIT
// The broad phase that hashes boxes into a hierarchy of grids (hierarchical spatial hashing).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "moreau/detect/broad/detail/sort_pairs.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Puts every box into a cell of a grid that suits its size. The cells of the grid of level k are
/// twice as wide as those of level k - 1. A box goes to the first level whose cells are at least as
/// wide as the box. So a box spans at most two cells along each axis, of its own level and of each
/// coarser level, and boxes of mixed sizes cost no more than boxes of equal size. The cost is O(n)
/// as long as the number of boxes that overlap one box is bounded.
template <class S>
class CellGrid {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Replaces the contents of `pairs` by the pairs of boxes that overlap, sorted, each pair once;
  /// see BroadPhase.
  void find_pairs(std::span<const Aabb<S>> boxes, std::vector<IndexPair>& pairs) {
    pairs.clear();
    if (boxes.empty()) return;
    choose_levels(boxes);
    fill_cells(boxes);
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      for (int level = level_of_[i]; level < levels_; ++level)
        if (occupied_[static_cast<std::size_t>(level)]) look(i, level, boxes, pairs);
    sorter_.sort(pairs, boxes.size());
  }

 private:
  static constexpr int max_levels = 24;
  static constexpr std::uint32_t none = ~0U;
  using Cell = std::array<std::int32_t, S::dim>;

  void choose_levels(std::span<const Aabb<S>> boxes) {
    origin_ = boxes[0].lower;
    Vector far = boxes[0].upper;
    Scalar smallest = widest(boxes[0]), largest = smallest;
    for (const Aabb<S>& box : boxes) {
      origin_ = origin_.cwiseMin(box.lower);
      far = far.cwiseMax(box.upper);
      smallest = std::min(smallest, widest(box));
      largest = std::max(largest, widest(box));
    }
    // The finest cells are at least 1/1024 as wide as the largest box, even if some boxes are
    // smaller, so that there are few levels. They are also at least 2^-28 as wide as the extent of
    // all boxes, so that cell numbers fit into a 32-bit integer.
    const Scalar extent = (far - origin_).maxCoeff();
    slack_ = Scalar(4) * std::numeric_limits<Scalar>::epsilon() *
             std::max(origin_.cwiseAbs().maxCoeff(), far.cwiseAbs().maxCoeff());
    Scalar width = std::max({smallest, largest / Scalar(1024), extent / Scalar(1 << 28)});
    if (!(width > Scalar(0))) width = Scalar(1);
    levels_ = 0;
    do {
      width_[static_cast<std::size_t>(levels_++)] = width;
      width *= Scalar(2);
    } while (width_[static_cast<std::size_t>(levels_ - 1)] < largest && levels_ < max_levels);
  }
  static Scalar widest(const Aabb<S>& box) { return (box.upper - box.lower).maxCoeff(); }

  void fill_cells(std::span<const Aabb<S>> boxes) {
    std::size_t buckets = 16;
    while (buckets < 2 * boxes.size()) buckets *= 2;
    head_.assign(buckets, none);
    next_.assign(boxes.size(), none);
    level_of_.resize(boxes.size());
    cell_of_.resize(boxes.size());
    occupied_.fill(false);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      int level = 0;
      while (level + 1 < levels_ && width_[static_cast<std::size_t>(level)] < widest(boxes[i]))
        ++level;
      level_of_[i] = level;
      occupied_[static_cast<std::size_t>(level)] = true;
      cell_of_[i] = cell(boxes[i].lower, level);
      std::uint32_t& head = head_[bucket(cell_of_[i], level)];
      next_[i] = std::exchange(head, i);
    }
  }

  Cell cell(const Vector& x, int level) const {
    Cell c;
    for (std::size_t k = 0; k < S::dim; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      c[k] = static_cast<std::int32_t>(
          std::floor((x[axis] - origin_[axis]) / width_[static_cast<std::size_t>(level)]));
    }
    return c;
  }
  std::size_t bucket(const Cell& c, int level) const {
    std::uint64_t hash = static_cast<std::uint64_t>(level);
    for (const std::int32_t x : c)
      hash = (hash ^ static_cast<std::uint32_t>(x)) * 0x9e3779b97f4a7c15ULL;
    return static_cast<std::size_t>(hash >> 32) & (head_.size() - 1);
  }

  /// Compares box i with every box j of a level that can overlap it. Box j lies in the cell of its
  /// lower corner and is at most one cell wide. So the cells to visit begin one cell width below
  /// the lower corner of box i and end at its upper corner. A pair of boxes of the same level is
  /// reported once, when box i has the lower index.
  void look(std::uint32_t i, int level, std::span<const Aabb<S>> boxes,
            std::vector<IndexPair>& pairs) const {
    Vector reach = boxes[i].lower;
    reach.array() -= width_[static_cast<std::size_t>(level)] + slack_;
    const Cell from = cell(reach, level), to = cell(boxes[i].upper, level);
    Cell c = from;
    while (true) {
      look_into(c, i, level, boxes, pairs);
      std::size_t k = 0;
      while (k < S::dim && c[k] == to[k]) {
        c[k] = from[k];
        ++k;
      }
      if (k == S::dim) return;
      ++c[k];
    }
  }
  void look_into(const Cell& c, std::uint32_t i, int level, std::span<const Aabb<S>> boxes,
                 std::vector<IndexPair>& pairs) const {
    for (std::uint32_t j = head_[bucket(c, level)]; j != none; j = next_[j]) {
      if (level_of_[j] != level || cell_of_[j] != c) continue;
      if (level == level_of_[i] && j <= i) continue;
      if (boxes[i].overlaps(boxes[j])) pairs.push_back({std::min(i, j), std::max(i, j)});
    }
  }

  Vector origin_ = Vector::Zero();
  Scalar slack_ = 0;  // bound of the rounding errors of coordinates [m]
  int levels_ = 0;
  std::array<Scalar, max_levels> width_{};
  std::array<bool, max_levels> occupied_{};
  std::vector<std::uint32_t> head_, next_;
  std::vector<int> level_of_;
  std::vector<Cell> cell_of_;
  detail::PairSorter sorter_;
};

}  // namespace moreau
