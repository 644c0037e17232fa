// SPDX-License-Identifier: MIT
// The list of the pairs of grains that are near, kept over steps: a pair is in it if the enlarged boxes of its
// grains overlap. It is made anew when a grain has left its enlarged box.
//
// In a cell that deforms, far grains move fast relative to each other although near ones do not. Let G
// be the map by which the cell has deformed since the list was made. The list is valid as long as the box
// of each grain, moved so that its centre c becomes G^-1 c, and enlarged by
//
//     max_k (|1 - G^-1| 1)_k w / 2,
//
// lies in its enlarged box. w is the largest width of a grain with the reach of its contacts. Proof: the
// centres of two grains in contact differ along each axis by at most w, so that G^-1 changes this
// difference by at most max_k (|1 - G^-1| 1)_k w, which the two enlargements make up for.
#pragma once

#include <Eigen/LU>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/core/aabb.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/erase_at.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/detect/broad/periodic_images.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/shape/concepts.hpp"
#include "moreau/world/detail/enlarged_boxes.hpp"
#include "moreau/world/detail/pair_caches.hpp"
#include "moreau/world/detail/pair_filter.hpp"
#include "moreau/world/tolerances.hpp"

namespace moreau::detail {

/// The list of the pairs, with the caches of the narrow phase. A pair consists of the numbers of two grains. In a periodic
/// cell it has a shift by whole cells that moves its second grain next to its first.
template <class ShapeT, class BroadPhaseT>
class NearPairs {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  const PeriodicCell<S>& cell() const { return cell_; }  ///< open unless set
  /// Sets the cell; the next find() finds all pairs anew.
  void set_cell(const PeriodicCell<S>& cell) {
    cell_ = cell;
    shifts_.clear();
    deformed_.setIdentity();
    deformed_lost_.setZero();
    stale_ = true;
  }
  /// Deforms a cell that is a lattice. The poses must be deformed by the same increment.
  void deform_cell(const typename S::Matrix& increment) {
    cells_.resize(shifts_.size());
    for (std::size_t p = 0; p < shifts_.size(); ++p) cells_[p] = cell_.cells(shifts_[p]);
    cell_.deform(increment);
    for (std::size_t p = 0; p < shifts_.size(); ++p) shifts_[p] = cell_.shift(cells_[p]);
    grow(deformed_, deformed_lost_, increment);
  }
  /// Lists only pairs for which keeps(a, b) of the indices of their bodies is true, from the next find() on.
  void set_filter(const auto& keeps) { filter_.set(keeps), stale_ = true; }
  const PairFilter& filter() const { return filter_; }  ///< see set_filter()

  /// Gives the grains other numbers, in the same order.
  /// @param number_after of each grain
  void renumber(std::span<const std::uint32_t> number_after) {
    for (IndexPair& pair : pairs_) {
      pair.first = number_after[pair.first];
      pair.second = number_after[pair.second];
    }
  }
  /// Removes the pairs of removed grains; keeps the others.
  /// @param number_after of each grain after the removal; none if it is removed
  void remove_grains(std::span<const std::uint32_t> number_after) {
    const auto has_gone = [&](std::size_t k) { return number_after[k] == none; };
    if (!stale_) erase_at(fat_, has_gone);
    const auto pair_has_gone = [&](std::size_t p) {
      return has_gone(pairs_[p].first) || has_gone(pairs_[p].second);
    };
    erase_at(shifts_, pair_has_gone);
    caches_.erase_pairs(pair_has_gone);
    if (!stale_) caches_.erase_grains(has_gone);
    erase_at(pairs_, pair_has_gone);
    for (IndexPair& pair : pairs_) pair = {number_after[pair.first], number_after[pair.second]};
  }
  /// Whether the next find() finds all pairs anew, whatever the boxes are.
  bool is_stale() const { return stale_; }
  void set_stale(bool stale) { stale_ = stale; }  ///< see is_stale()
  /// Makes the list empty and stale.
  void forget() {
    stale_ = true;
    fat_.clear();
    pairs_.clear();
    shifts_.clear();
    caches_ = {};
  }

  /// Finds the pairs whose boxes are closer than margin + 2 skin along every axis, sorted by their numbers. It keeps the
  /// list as long as no box has moved by the skin since; grains without a pair may move farther (EnlargedBoxes).
  /// @param grains with their body and placed shape
  /// @param boxes  one per grain [m]
  /// @param widest width of the grains in any orientation [m]
  /// @param function the public function that the caller of the library called, for error messages
  /// @returns whether the list is new
  /// @throws std::invalid_argument if a cell that deforms is too short for the grains
  template <class Grains>
  bool find(const Grains& grains, std::span<const Aabb<S>> boxes,
            const DetectionLengths<Scalar>& lengths, Scalar widest, const char* function);

  std::span<const IndexPair> pairs() const { return pairs_; }  ///< sorted
  /// One per pair: moves the second grain next to the first [m]; empty in an open cell.
  std::span<const Vector> shifts() const { return shifts_; }
  /// Whether pair p reaches over a boundary of the cell.
  bool crosses(std::size_t p) const { return !shifts_.empty() && !shifts_[p].isZero(0); }
  PairCaches<ShapeT>& caches() { return caches_; }  ///< of the pairs

  /// Whether the members agree with one another and with the grains, after they were read from a file.
  bool is_valid(const auto& grains) const {
    bool valid = shifts_.size() == (cell_.is_open() ? 0 : pairs_.size()) ||
                 (stale_ && shifts_.empty());  // set_cell() came after the last step
    for (const IndexPair& pair : pairs_)
      valid = valid && pair.first < pair.second && pair.second < grains.size();
    return valid && caches_.are_valid(pairs_, grains, stale_);
  }
  /// The members that a file contains, see core/serialize.hpp.
  /// @param setting a member of the detector, which the file contains after the cell
  auto serialized_members_with(auto& setting) {
    return std::tie(cell_, setting, stale_, fat_, pairs_, shifts_, caches_, deformed_,
                    deformed_lost_);
  }

 private:
  /// Whether the list is still valid in a lattice: no box has left its enlarged box. See the head of this file.
  template <class Grains>
  bool holds_in_lattice(const Grains& grains, std::span<const Aabb<S>> boxes, Scalar reach,
                        Scalar widest) const;

  /// Chooses the shortest vectors of a lattice, for a new list.
  /// @param width    of the widest grain with its reach [m]
  /// @param function the public function that the caller of the library called, for error messages
  /// @throws std::invalid_argument if the cell is too short for it; its vectors are then as before
  MOREAU_COLD void renew_lattice(Scalar width, const char* function) {
    PeriodicCell<S> reduced = cell_;
    reduced.reduce();
    reduced.require_room(width, function);
    cell_ = reduced;
    deformed_.setIdentity();
    deformed_lost_.setZero();
  }

  PeriodicCell<S> cell_;
  List<Aabb<S>> fat_;  // the enlarged boxes, one per grain
  BroadPhaseT broad_phase_;
  EnlargedBoxes<S> enlarged_;
  PairFilter filter_;
  PeriodicImages<S> images_;
  std::vector<IndexPair> pairs_, old_pairs_;
  std::vector<Vector> shifts_;
  std::vector<Vector> cells_;                             // the same in cells, in deform_cell()
  typename S::Matrix deformed_ = S::Matrix::Identity();   // map of the cell since the list was made
  typename S::Matrix deformed_lost_ = S::Matrix::Zero();  // of it, see grow()
  PairCaches<ShapeT> caches_;
  bool stale_ = true;
};

// Outside of the class: compiled once where a program declares the detector extern.
template <class ShapeT, class BroadPhaseT>
template <class Grains>
bool NearPairs<ShapeT, BroadPhaseT>::find(const Grains& grains, std::span<const Aabb<S>> boxes,
                                          const DetectionLengths<Scalar>& lengths, Scalar widest,
                                          const char* function) {
  const Scalar reach = lengths.margin / 2;
  const bool is_new = stale_ || fat_.size() != boxes.size();
  bool left = is_new, known = false;
  const auto is_alone = [&](std::size_t k) {
    if (!known) enlarged_.find_pairs_of(boxes.size(), pairs_);
    known = true;
    return enlarged_.is_alone(k);
  };
  if (cell_.is_lattice())
    left = left || !holds_in_lattice(grains, boxes, reach, widest);
  else
    for (std::size_t k = 0; k < boxes.size() && !left; ++k)
      left = !fat_[k].contains(boxes[k].inflated(reach)) ||
             (!caches_.holds(k, grains[k].placed, reach) && !is_alone(k));
  if (!left) return false;
  if (cell_.is_lattice()) renew_lattice(widest + lengths.margin + 2 * lengths.skin, function);
  stale_ = false;
  fat_.resize(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
    fat_[k] = !is_new && cell_.is_open() && is_alone(k)
                  ? enlarged_.next(boxes[k], fat_[k], reach, lengths.skin)
                  : boxes[k].inflated(reach + lengths.skin);
  old_pairs_.swap(pairs_);
  if (cell_.is_open())
    broad_phase_.find_pairs(std::span<const Aabb<S>>(fat_), pairs_);
  else
    images_.find_pairs(cell_, std::span<const Aabb<S>>(fat_), broad_phase_, pairs_, shifts_);
  filter_.erase(grains, pairs_, shifts_);
  caches_.renew(pairs_, old_pairs_, shifts_, grains, reach + lengths.skin);
  caches_.set_carrying(lengths.carry > 0);
  return true;
}

template <class ShapeT, class BroadPhaseT>
template <class Grains>
bool NearPairs<ShapeT, BroadPhaseT>::holds_in_lattice(const Grains& grains,
                                                      std::span<const Aabb<S>> boxes, Scalar reach,
                                                      Scalar widest) const {
  const typename S::Matrix inverse = inverse_of(deformed_);
  const typename S::Matrix undone = -identity_minus(Scalar(1), inverse);
  const Scalar most = largest_row_sum(undone);
  const Scalar by = reach + most * (widest + 2 * reach) / 2;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Vector center = (boxes[k].lower + boxes[k].upper) / 2;
    const Vector back = cell_.deformed(undone, center) - center;
    if (!fat_[k].contains(boxes[k].moved(back).inflated(by)) ||
        !caches_.holds(k, grains[k].placed, by, back))
      return false;
  }
  return true;
}

}  // namespace moreau::detail
