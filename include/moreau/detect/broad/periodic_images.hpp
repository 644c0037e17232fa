// SPDX-License-Identifier: MIT
// The pairs of boxes that overlap in a periodic cell, a box or a lattice (core/periodic_cell.hpp).
//   1. Every box is shifted by a whole number of cells along each periodic axis, so that its centre lies
//      in the cell.
//   2. Images of the boxes are added: copies shifted by one cell along one or more axes, as far as they
//      can overlap a box in the cell. Images farther away overlap none: the centres of two boxes that
//      overlap differ by less than half a cell (PeriodicCell::require_room).
//   3. Any broad phase finds the overlapping pairs among the boxes and their images.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/neighbour_cells.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Finds the pairs of boxes that overlap directly or through an image of a periodic cell. The
/// object keeps its memory from call to call, so that it allocates only when the number of boxes or
/// pairs exceeds all earlier numbers.
template <class S>
class PeriodicImages {
 public:
  using Vector = typename S::Vector;

  /// Replaces the contents of `pairs` by all pairs of boxes that overlap through some image,
  /// sorted, each pair once. Boxes may lie anywhere. Precondition: along each periodic axis, the sum
  /// of the extents of any two boxes is less than the length of the cell; in a lattice, less than the
  /// heights in the head of core/periodic_cell.hpp. A pair then overlaps through at most one image.
  /// PeriodicCell::require_room checks this for grains.
  /// @param boxes       world axes [m]
  /// @param broad_phase a BroadPhase of this space
  /// @param pairs       pairs of indices into `boxes`
  /// @param shifts      one vector per pair, world axes [m]: a whole number of cells along
  ///                    each axis. The second box of the pair, moved by this vector, overlaps the
  ///                    first box
  template <class Broad>
  void find_pairs(const PeriodicCell<S>& cell, std::span<const Aabb<S>> boxes, Broad& broad_phase,
                  std::vector<IndexPair>& pairs, std::vector<Vector>& shifts) {
    bring_home(cell, boxes);
    add_images(cell, boxes.size());
    broad_phase.find_pairs(std::span<const Aabb<S>>(boxes_), found_);
    collect(boxes.size());
    pairs.clear();
    shifts.clear();
    for (const Image& image : images_) {
      pairs.push_back(image.pair);
      shifts.push_back(cell.shift(image.cells));
    }
  }

 private:
  struct Image {
    IndexPair pair;
    Vector cells;  // signed numbers of cells along the axes, whole numbers
  };

  /// Shifts every box by a whole number of cells along each periodic axis, so that its centre lies
  /// in the cell.
  void bring_home(const PeriodicCell<S>& cell, std::span<const Aabb<S>> boxes) {
    boxes_.clear();
    owner_.clear();
    cells_.clear();
    hull_ = Aabb<S>{};
    for (std::uint32_t k = 0; k < boxes.size(); ++k) {
      const Vector center = (boxes[k].lower + boxes[k].upper) / 2;
      const Vector home = -cell.cell_of(center);
      add(cell, boxes[k], k, home);
      hull_.merge(boxes_.back().lower);
      hull_.merge(boxes_.back().upper);
    }
  }
  void add(const PeriodicCell<S>& cell, Aabb<S> box, std::uint32_t owner, const Vector& cells) {
    const Vector shift = cell.shift(cells);
    box.lower += shift;
    box.upper += shift;
    boxes_.push_back(box);
    owner_.push_back(owner);
    cells_.push_back(cells);
  }

  /// Adds images in half of the neighbouring cells: of each two opposite neighbours, only one gets
  /// images. Two boxes that overlap through the neighbour that is left out overlap also through the
  /// opposite neighbour, with their roles exchanged.
  void add_images(const PeriodicCell<S>& cell, std::size_t count) {
    constexpr int neighbours = detail::neighbour_cells<S::dim>();
    for (int k = neighbours / 2 + 1; k < neighbours; ++k) {
      const Vector steps = detail::neighbour_cell<Vector>(k);
      if (cell.has_image(steps)) add_images(cell, count, steps);
    }
  }
  void add_images(const PeriodicCell<S>& cell, std::size_t count, const Vector& step) {
    const Vector shift = cell.shift(step);
    for (std::uint32_t k = 0; k < count; ++k) {
      Aabb<S> box = boxes_[k];
      box.lower += shift;
      box.upper += shift;
      if (!box.overlaps(hull_)) continue;
      boxes_.push_back(box);
      owner_.push_back(k);
      cells_.push_back(cells_[k] + step);
    }
  }

  /// Turns the pairs that the broad phase found among boxes and images into pairs of the given
  /// boxes.
  void collect(std::size_t count) {
    images_.clear();
    for (const IndexPair& pair : found_) {
      if (pair.first >= count) continue;
      const std::uint32_t a = pair.first, b = owner_[pair.second];
      MOREAU_ASSERT(a != b);
      const Vector cells = cells_[pair.second] - cells_[a];
      images_.push_back(a < b ? Image{{a, b}, cells} : Image{{b, a}, -cells});
    }
    std::sort(images_.begin(), images_.end(),
              [](const Image& x, const Image& y) { return x.pair < y.pair; });
  }

  List<Aabb<S>> boxes_;               // the boxes shifted into the cell, then their images
  std::vector<std::uint32_t> owner_;  // for each element of boxes_, the index of the given box that
                                      // it is a copy of
  std::vector<Vector> cells_;  // for each element of boxes_, its shift from the given box, in cells
  Aabb<S> hull_;               // bounding box of all boxes in the cell, without images [m]
  std::vector<IndexPair> found_;
  List<Image> images_;
};

}  // namespace moreau
