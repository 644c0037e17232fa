// SPDX-License-Identifier: MIT
// The broad phase that hashes boxes into a hierarchy of grids (hierarchical spatial hashing).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/detect/broad/detail/sort_pairs.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Puts every box into a cell of a grid that suits its size. The cells of the grid of level k are
/// twice as wide as those of level k - 1. A box goes to the first level whose cells are at least as
/// wide as the box. So a box spans at most two cells along each axis, of its own level and of each
/// coarser level, and boxes of mixed sizes cost no more than boxes of equal size. The cost is O(n)
/// as long as the number of boxes that overlap one box is bounded.
///
/// The boxes are copied in the order of their cells. The cells of a row along the first axis follow
/// one another in memory, so that the search reads whole rows.
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
    sort_into_cells(boxes);
    std::size_t end = 0;
    for (int own = 0; own < level_count_; ++own) {
      const std::size_t begin = end;
      end += level(own).count;
      for (std::size_t e = begin; e < end; ++e) {
        look_in_own(e, level(own), pairs);
        for (int coarser = own + 1; coarser < level_count_; ++coarser)
          if (level(coarser).count > 0) look_in_coarser(entries_[e], level(coarser), pairs);
      }
    }
    sorter_.sort(pairs, boxes.size());
  }

 private:
  static constexpr int max_levels = 24;
  static constexpr std::size_t dim = S::dim;
  using Cell = std::array<std::int32_t, dim>;

  /// A grid. Cell c is in bucket begin + (c . stride mod 2^n). Cells of a row are in consecutive
  /// buckets. If the grid has few cells, each has a bucket of its own.
  struct Level {
    Scalar width = 0;                         // of the cells [m]
    std::size_t count = 0;                    // boxes
    Cell most{};                              // the largest number of a cell along each axis
    std::array<std::uint32_t, dim> stride{};  // odd, so that rows rarely share buckets
    std::size_t begin = 0;                    // first bucket
    std::uint32_t mask = 0;                   // number of buckets - 1
  };
  /// A box with its cell.
  struct Entry {
    Aabb<S> box;
    Cell cell;
    std::uint32_t index;
  };

  Level& level(int k) { return levels_[static_cast<std::size_t>(k)]; }
  static Scalar widest(const Aabb<S>& box) { return (box.upper - box.lower).maxCoeff(); }

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
    level_count_ = 0;
    do {
      level(level_count_) = Level{};
      level(level_count_++).width = width;
      width *= Scalar(2);
    } while (level(level_count_ - 1).width < largest && level_count_ < max_levels);
  }

  /// Fills entries_, sorted by bucket: a counting sort.
  void sort_into_cells(std::span<const Aabb<S>> boxes) {
    cells_.resize(boxes.size());
    level_of_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      int k = 0;
      while (k + 1 < level_count_ && level(k).width < widest(boxes[i])) ++k;
      level_of_[i] = static_cast<std::uint8_t>(k);
      cells_[i] = cell(boxes[i].lower, level(k));
      ++level(k).count;
      for (std::size_t axis = 0; axis < dim; ++axis)
        level(k).most[axis] = std::max(level(k).most[axis], cells_[i][axis]);
    }
    // Memory for all extents that boxes of this number can have.
    const std::size_t most = 8 * boxes.size() + 2 * max_levels;
    begin_.reserve(most);
    next_.reserve(most);
    begin_.assign(lay_out_buckets() + 1, 0);
    for (std::size_t i = 0; i < boxes.size(); ++i) ++begin_[bucket_of(i) + 1];
    for (std::size_t b = 1; b < begin_.size(); ++b) begin_[b] += begin_[b - 1];
    next_.assign(begin_.begin(), begin_.end());
    entries_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      entries_[next_[bucket_of(i)]++] = {boxes[i], cells_[i], static_cast<std::uint32_t>(i)};
  }
  /// @returns the number of all buckets
  std::size_t lay_out_buckets() {
    std::size_t total = 0;
    for (int k = 0; k < level_count_; ++k) {
      Level& one = level(k);
      std::uint32_t stride = 1;
      double cells = 1;
      for (std::size_t axis = 0; axis < dim; ++axis) {
        one.stride[axis] = stride;
        stride *= static_cast<std::uint32_t>(one.most[axis] + 1) | 1U;
        cells *= double(one.most[axis]) + 1;
      }
      const double wanted = std::clamp(cells, 1.0 * double(one.count), 4.0 * double(one.count));
      std::size_t buckets = 1;
      while (double(buckets) < wanted) buckets *= 2;
      one.begin = total;
      one.mask = static_cast<std::uint32_t>(buckets - 1);
      total += buckets;
    }
    return total;
  }
  std::size_t bucket_of(std::size_t i) const { return bucket(cells_[i], levels_[level_of_[i]]); }

  Cell cell(const Vector& x, const Level& level) const {
    Cell c;
    for (std::size_t k = 0; k < dim; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      constexpr Scalar most = Scalar(1 << 30);  // boxes beyond share the outermost cells
      const Scalar place = std::floor((x[axis] - origin_[axis]) / level.width);
      c[k] = static_cast<std::int32_t>(place > -most ? (place < most ? place : most) : -most);
    }
    return c;
  }
  static std::size_t bucket(const Cell& c, const Level& level) {
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < dim; ++k) sum += static_cast<std::uint32_t>(c[k]) * level.stride[k];
    return level.begin + (sum & level.mask);
  }

  /// The cells of a level in which a box can lie that overlaps this box. The other box lies in the
  /// cell of its lower corner and is at most one cell wide. So the cells begin one cell width below
  /// the lower corner of this box and end at its upper corner.
  struct Range {
    Cell from, to;
  };
  Range range_of(const Aabb<S>& box, const Level& level) const {
    Vector reach = box.lower;
    reach.array() -= level.width + slack_;
    Range range{cell(reach, level), cell(box.upper, level)};
    for (std::size_t k = 0; k < dim; ++k) {
      range.from[k] = std::max(range.from[k], 0);
      range.to[k] = std::min(range.to[k], level.most[k]);
    }
    return range;
  }

  /// Pairs of entry e with entries of its level. Each pair is reported once: entry e looks only at
  /// cells behind its own, in the order of the last axis, .., the first axis, and at later entries
  /// of its own cell.
  void look_in_own(std::size_t e, const Level& level, std::vector<IndexPair>& pairs) const {
    const Entry& entry = entries_[e];
    Range range = range_of(entry.box, level);
    range.from[dim - 1] = entry.cell[dim - 1];
    for_each_row(range, [&](const Cell& row) {
      bool is_own = true;
      for (std::size_t k = dim; is_own && --k > 0;) {
        if (row[k] < entry.cell[k]) return;
        is_own = row[k] == entry.cell[k];
      }
      if (!is_own) return look_into(row, range.from[0], range.to[0], entry, level, pairs);
      const std::size_t end = begin_[bucket(entry.cell, level) + 1];
      for (std::size_t other = e + 1; other < end; ++other)
        if (entries_[other].cell == entry.cell) compare(entry, entries_[other], pairs);
      if (entry.cell[0] < range.to[0])
        look_into(row, entry.cell[0] + 1, range.to[0], entry, level, pairs);
    });
  }
  void look_in_coarser(const Entry& entry, const Level& level,
                       std::vector<IndexPair>& pairs) const {
    const Range range = range_of(entry.box, level);
    for_each_row(range, [&](const Cell& row) {
      look_into(row, range.from[0], range.to[0], entry, level, pairs);
    });
  }
  /// Calls use(cell) for the first cell of every row of a range.
  template <class Use>
  static void for_each_row(const Range& range, const Use& use) {
    for (std::size_t k = 0; k < dim; ++k)
      if (range.from[k] > range.to[k]) return;
    Cell c = range.from;
    while (true) {
      use(c);
      std::size_t k = 1;
      for (; k < dim && c[k] == range.to[k]; ++k) c[k] = range.from[k];
      if (k == dim) return;
      ++c[k];
    }
  }
  /// Compares an entry with the boxes of the cells first .. last of a row.
  void look_into(Cell row, std::int32_t first, std::int32_t last, const Entry& entry,
                 const Level& level, std::vector<IndexPair>& pairs) const {
    row[0] = first;
    const std::size_t from = bucket(row, level) - level.begin;
    const std::size_t to = from + static_cast<std::size_t>(last - first);
    const auto look = [&](std::size_t begin, std::size_t end) {
      for (std::size_t other = begin_[level.begin + begin]; other < begin_[level.begin + end];
           ++other) {
        const Entry& that = entries_[other];
        if (!entry.box.overlaps(that.box)) continue;
        // Other cells may share the buckets.
        bool is_here = that.cell[0] >= first && that.cell[0] <= last;
        for (std::size_t k = 1; k < dim; ++k) is_here = is_here && that.cell[k] == row[k];
        if (is_here) report(entry, that, pairs);
      }
    };
    const std::size_t buckets = std::size_t{level.mask} + 1;
    look(from, std::min(to + 1, buckets));
    if (to < buckets) return;
    // The row goes on at the first bucket.
    if (to - from < buckets)
      look(0, to + 1 - buckets);
    else
      look(0, from);
  }
  static void compare(const Entry& a, const Entry& b, std::vector<IndexPair>& pairs) {
    if (a.box.overlaps(b.box)) report(a, b, pairs);
  }
  static void report(const Entry& a, const Entry& b, std::vector<IndexPair>& pairs) {
    pairs.push_back({std::min(a.index, b.index), std::max(a.index, b.index)});
  }

  Vector origin_ = Vector::Zero();
  Scalar slack_ = 0;  // bound of the rounding errors of coordinates [m]
  int level_count_ = 0;
  std::array<Level, max_levels> levels_{};
  std::vector<std::uint8_t> level_of_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> begin_, next_;  // of every bucket in entries_
  std::vector<Entry> entries_;
  detail::PairSorter sorter_;
};

}  // namespace moreau
