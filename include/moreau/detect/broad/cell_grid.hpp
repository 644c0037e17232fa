// SPDX-License-Identifier: MIT
// The broad phase that hashes boxes into a hierarchy of grids (hierarchical spatial hashing).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "moreau/core/list.hpp"
#include "moreau/detect/broad/detail/bulk.hpp"
#include "moreau/detect/broad/detail/sort_pairs.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Puts every box into a cell of a grid that suits its size. The cells of the grid of level k are
/// twice as wide as those of level k - 1. A box goes to the first level whose cells are at least as
/// wide as the box. So a box spans at most two cells along each axis, of its own level and of each
/// coarser level, and boxes of mixed sizes cost no more than boxes of equal size. The cost is O(n)
/// as long as the number of boxes that overlap one box is bounded.
///
/// The cells of a level are laid out for the region in which most boxes are. A box far outside of it
/// shares a bucket with cells of this region, which costs a comparison; so a grain that was lost does
/// not make the cells of the others wider. A box that no level can hold, because it is infinite, is
/// compared with all others; a box that is not a number overlaps none.
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
    choose_region(boxes);
    sort_into_cells(boxes);
    coarser_.reserve(max_levels);
    std::size_t end = 0;
    for (int own = 0; own < level_count_; ++own) {
      const std::size_t begin = end;
      end += level(own).count;
      coarser_.clear();
      for (int coarser = own + 1; coarser < level_count_ && begin < end; ++coarser)
        if (level(coarser).count > 0) coarser_.push_back(coarser);
      for (std::size_t e = begin; e < end; ++e) {
        look_in_own(e, level(own), pairs);
        for (const int coarser : coarser_) look_in_coarser(entries_[e], level(coarser), pairs);
      }
    }
    compare_loose(boxes, pairs);
    sorter_.sort(pairs, boxes.size());
  }

 private:
  /// The finest level is for the smallest boxes, unless they are 2^-40 as wide as the widest box.
  static constexpr int max_levels = 48, finest = 40;
  static constexpr std::uint8_t no_level = 255;
  /// Largest number of a cell, so that its edges are exact to a part of its width.
  static constexpr Scalar most_cells =
      Scalar(1 << (std::numeric_limits<Scalar>::digits < 32 ? 20 : 30));
  static constexpr std::size_t dim = S::dim;
  using Cell = std::array<std::int32_t, dim>;

  /// A grid. Cell c is in bucket begin + (c . stride mod 2^n). Cells of a row are in consecutive
  /// buckets. If the grid has few cells, each has a bucket of its own.
  struct Level {
    Scalar width = 0;                         // of the cells [m]
    std::size_t count = 0;                    // boxes
    Cell least{}, most{};                     // bounds of the numbers of cells along each axis
    Cell first{}, last{};                     // of those of the boxes in the region
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

  /// Sets the region, which contains most boxes, and the width of the finest cells.
  void choose_region(std::span<const Aabb<S>> boxes) {
    Scalar smallest = std::numeric_limits<Scalar>::infinity(), largest = 0;
    for (const Aabb<S>& box : boxes) {
      if (!detail::is_regular(box)) continue;
      smallest = std::min(smallest, widest(box));
      largest = std::max(largest, widest(box));
    }
    const Aabb<S> middle = detail::middle_of(boxes);
    const Vector reach =
        Vector::Constant(8 * (middle.upper - middle.lower).maxCoeff() + 16 * smallest);
    const Aabb<S> window(middle.lower - reach, middle.upper + reach);
    region_ = Aabb<S>{};
    for (const Aabb<S>& box : boxes) {
      if (!window.contains(box)) continue;
      region_.merge(box.lower);
      region_.merge(box.upper);
    }
    if (!(region_.lower[0] <= region_.upper[0])) region_ = Aabb<S>(Vector::Zero(), Vector::Zero());
    Scalar width = std::max(smallest, std::ldexp(largest, -finest));
    if (!(width > Scalar(0)) || !std::isfinite(width)) width = Scalar(1);
    level_count_ = 0;
    add_level(width);
  }
  void add_level(Scalar width) {
    Level& added = level(level_count_++);
    added = Level{};
    added.width = width;
    added.least.fill(std::numeric_limits<std::int32_t>::max());
    added.most.fill(std::numeric_limits<std::int32_t>::min());
    added.first = added.least;
    added.last = added.most;
  }
  /// The first level whose cells are as wide as the box and whose numbers of cells reach to it.
  std::uint8_t choose_level(const Aabb<S>& box) {
    if (!detail::is_regular(box)) return no_level;
    const Scalar wanted =
        std::max(widest(box), (box.lower - region_.lower).cwiseAbs().maxCoeff() / most_cells);
    for (int k = 0;; ++k) {
      if (k == level_count_) {
        if (k == max_levels) return no_level;
        add_level(2 * level(k - 1).width);
      }
      if (!(level(k).width < wanted)) return static_cast<std::uint8_t>(k);
    }
  }

  /// Fills entries_, sorted by bucket: a counting sort.
  void sort_into_cells(std::span<const Aabb<S>> boxes) {
    cells_.resize(boxes.size());
    level_of_.resize(boxes.size());
    loose_.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      level_of_[i] = choose_level(boxes[i]);
      if (level_of_[i] == no_level) {
        if (!detail::has_nan(boxes[i])) loose_.push_back(static_cast<std::uint32_t>(i));
        continue;
      }
      Level& own = levels_[level_of_[i]];
      cells_[i] = cell(boxes[i].lower, own);
      ++own.count;
      const bool is_inside = region_.contains(boxes[i]);
      for (std::size_t axis = 0; axis < dim; ++axis) {
        const std::int32_t c = cells_[i][axis];
        own.least[axis] = std::min(own.least[axis], c);
        own.most[axis] = std::max(own.most[axis], c);
        if (!is_inside) continue;
        own.first[axis] = std::min(own.first[axis], c);
        own.last[axis] = std::max(own.last[axis], c);
      }
    }
    // Memory for all extents that boxes of this number can have.
    const std::size_t most = 8 * boxes.size() + 2 * max_levels;
    begin_.reserve(most);
    next_.reserve(most);
    begin_.assign(lay_out_buckets() + 1, 0);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (level_of_[i] != no_level) ++begin_[bucket_of(i) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    next_.assign(begin_.begin(), begin_.end());
    entries_.resize(begin_.back());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (level_of_[i] != no_level)
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
        const double across = std::max(double(one.last[axis]) - double(one.first[axis]) + 1, 1.0);
        stride *= static_cast<std::uint32_t>(std::min(across, 0x1p31)) | 1U;
        cells *= across;
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
      const Scalar place = std::floor((x[axis] - region_.lower[axis]) / level.width);
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
    // Largest change of the extent of the other box by the rounding of coordinates.
    const Scalar slack = Scalar(4) * std::numeric_limits<Scalar>::epsilon() *
                         (box.lower.cwiseAbs().maxCoeff() + level.width);
    for (int k = 0; k < S::dim; ++k) reach[k] -= level.width + slack;
    Range range{cell(reach, level), cell(box.upper, level)};
    for (std::size_t k = 0; k < dim; ++k) {
      range.from[k] = std::max(range.from[k], level.least[k]);
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
  /// Calls use(cell) for the first cell of every row of a range. A row lies along the first axis. An empty range has no rows.
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
  /// Pairs of the boxes that are in no level with all others.
  void compare_loose(std::span<const Aabb<S>> boxes, std::vector<IndexPair>& pairs) const {
    for (const std::uint32_t a : loose_)
      for (std::uint32_t b = 0; b < boxes.size(); ++b)
        if (b != a && (level_of_[b] != no_level || a < b) && boxes[a].overlaps(boxes[b]))
          pairs.push_back({std::min(a, b), std::max(a, b)});
  }
  static void compare(const Entry& a, const Entry& b, std::vector<IndexPair>& pairs) {
    if (a.box.overlaps(b.box)) report(a, b, pairs);
  }
  static void report(const Entry& a, const Entry& b, std::vector<IndexPair>& pairs) {
    pairs.push_back({std::min(a.index, b.index), std::max(a.index, b.index)});
  }

  Aabb<S> region_;  // its lower corner is the origin of the cells
  int level_count_ = 0;
  std::array<Level, max_levels> levels_{};
  List<std::uint8_t> level_of_;
  List<Cell> cells_;
  List<std::uint32_t> loose_;         // boxes that are in no level
  List<int> coarser_;                 // levels with boxes
  List<std::uint32_t> begin_, next_;  // of every bucket in entries_
  List<Entry> entries_;
  detail::PairSorter sorter_;
};

}  // namespace moreau
