// SPDX-License-Identifier: MIT
// Pairs of boxes in a periodic cell, by any broad phase. Every box is shifted by whole cells until
// its centre lies in the cell; boxes that reach the other side of the cell get a shifted image
// there.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau {

/// Finds the pairs of boxes that overlap through an image of a periodic cell. Keeps its memory: no
/// allocation once it has grown.
template <class S>
class PeriodicImages {
 public:
  using Vector = typename S::Vector;

  /// Replaces the contents of `pairs` by all pairs of boxes that overlap through some image,
  /// sorted, each once. Boxes may lie anywhere. No two of them may be longer together than the cell
  /// along a periodic axis (PeriodicCell::require_room), so that a pair overlaps through one image
  /// at most.
  /// @param boxes       world axes [m]
  /// @param broad_phase a BroadPhase of this space
  /// @param pairs       of indices of boxes
  /// @param shifts      one per pair: the displacement, by whole cells, that takes the second box
  /// as
  ///                    it lies to its image that overlaps the first box, world axes [m]
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
      shifts.push_back(cell.length().cwiseProduct(image.cells));
    }
  }

 private:
  struct Image {
    IndexPair pair;
    Vector cells;  // whole numbers
  };

  /// Shifts every box by whole cells so that its centre lies in the cell.
  void bring_home(const PeriodicCell<S>& cell, std::span<const Aabb<S>> boxes) {
    boxes_.clear();
    owner_.clear();
    cells_.clear();
    hull_ = Aabb<S>{};
    for (std::uint32_t k = 0; k < boxes.size(); ++k) {
      Vector home;
      for (int axis = 0; axis < S::dim; ++axis) {
        const auto center = (boxes[k].lower[axis] + boxes[k].upper[axis]) / 2;
        const auto cells = std::floor((center - cell.lower()[axis]) / cell.length()[axis]);
        home[axis] = -(cell.is_periodic(axis) ? cells : 0);
      }
      add(cell, boxes[k], k, home);
      hull_.merge(boxes_.back().lower);
      hull_.merge(boxes_.back().upper);
    }
  }
  void add(const PeriodicCell<S>& cell, Aabb<S> box, std::uint32_t owner, const Vector& cells) {
    const Vector shift = cell.length().cwiseProduct(cells);
    box.lower += shift;
    box.upper += shift;
    boxes_.push_back(box);
    owner_.push_back(owner);
    cells_.push_back(cells);
  }

  /// Adds images in half of the neighbouring cells, one of each two opposite cells: a pair that
  /// overlaps through one of them overlaps through the other with the roles exchanged.
  void add_images(const PeriodicCell<S>& cell, std::size_t count) {
    int neighbours = 1;
    for (int axis = 0; axis < S::dim; ++axis) neighbours *= 3;
    for (int n = neighbours / 2 + 1; n < neighbours; ++n) {
      Vector step;
      bool exists = true;
      for (int axis = 0, rest = n; axis < S::dim; ++axis, rest /= 3) {
        step[axis] = static_cast<typename S::Scalar>(rest % 3 - 1);
        exists = exists && (rest % 3 == 1 || cell.is_periodic(axis));
      }
      if (exists) add_images(cell, count, step);
    }
  }
  void add_images(const PeriodicCell<S>& cell, std::size_t count, const Vector& step) {
    const Vector shift = cell.length().cwiseProduct(step);
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

  /// Turns pairs of boxes in the cell with boxes in the cell or images into pairs of the given
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

  std::vector<Aabb<S>> boxes_;        // those in the cell, then their images
  std::vector<std::uint32_t> owner_;  // index of the given box that each of them belongs to
  std::vector<Vector> cells_;  // how many cells each is shifted from its owner, whole numbers
  Aabb<S> hull_;               // around the boxes in the cell
  std::vector<IndexPair> found_;
  std::vector<Image> images_;
};

}  // namespace moreau
