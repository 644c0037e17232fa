// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/core/aabb.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/sort_by_key.hpp"

namespace moreau::detail {

/// Where a point lies along the Z curve (Morton, 1966) through a cube, which visits cells near one
/// another mostly in turn.
/// @tparam bits of the number of a cell along each axis
/// @param at    coordinates of the point [m]
/// @param lower lower corner of the cube [m]
/// @param edge  length of the edges of the cube [m], >= 0
template <class S, int bits>
std::uint64_t z_code(const typename S::Vector& at, const typename S::Vector& lower, double edge) {
  constexpr double cells = double((std::uint64_t{1} << bits) - 1);
  edge = std::max(edge, 1e-300);
  std::uint64_t code = 0;
  for (int k = 0; k < S::dim; ++k) {
    const double share = std::clamp(double(at[k] - lower[k]) / edge, 0.0, 1.0);
    const auto cell = static_cast<std::uint64_t>(share * cells);
    for (int bit = 0; bit < bits; ++bit) code |= (cell >> bit & 1) << (S::dim * bit + k);
  }
  return code;
}

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
      for (int k = 0; k < S::dim; ++k) {
        all.lower[k] = std::min(all.lower[k], box.lower[k]);
        all.upper[k] = std::max(all.upper[k], box.upper[k]);
      }
    }
    const double edge = double((all.upper - all.lower).maxCoeff());
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      const typename S::Vector centre = (boxes[k].lower + boxes[k].upper) / 2;
      order_.push_back({z_code<S, 16>(centre, all.lower, edge), static_cast<std::uint32_t>(k)});
    }
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

  List<Entry> order_, scratch_;
};

}  // namespace moreau::detail
