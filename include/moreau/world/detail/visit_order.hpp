// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "moreau/core/aabb.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/z_curve.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/simd/prefetch.hpp"

namespace moreau::detail {

/// Before grain k is placed: begins to load what the updates of the next grains read and write. The shapes that the grains
/// were placed with may be gone: those of a simulation that was copied.
/// @param shape_of k -> shape of grain k
/// @param end the first grain that is not placed
void prefetch_update(auto grains, const auto& shape_of, std::size_t k, std::size_t end) {
  if (k + 6 < end) {
    const auto& shape = shape_of(k + 6);
    prefetch(&shape, sizeof(shape));
  }
  if (k + 3 < end) grains[k + 3].placed.prefetch_update(shape_of(k + 3));
}

/// The order in which contact detection visits grains: neighbours in space follow one another. It
/// changes no result.
template <class S>
class VisitOrder {
 public:
  /// @param boxes one per grain
  /// @param pairs of grains, sorted
  void assign(std::span<const Aabb<S>> boxes, std::span<const IndexPair> pairs) {
    order_.assign(boxes);
    first_pair_.clear();
    for (std::size_t p = 0, k = 0; k <= boxes.size(); ++k) {
      while (p < pairs.size() && pairs[p].first < k) ++p;
      first_pair_.push_back(p);
    }
    work_.clear();
    std::size_t work = 0;
    for (std::size_t place = 0; place < boxes.size(); ++place) {
      work_.push_back(work);
      work += 1 + first_pair(order_[place] + 1) - first_pair(order_[place]);
    }
    is_valid_ = true;
  }
  /// The pairs of the grains, or the grains, have changed.
  void invalidate() { is_valid_ = false; }
  bool is_valid() const { return is_valid_; }  ///< whether assign() is not needed

  /// The first pair whose first grain is k or a later one; k <= number of grains.
  std::size_t first_pair(std::size_t k) const { return first_pair_[k]; }
  /// Calls visit(k, later) for the grains of member `rank` of a team. later(n) is the grain of the
  /// n-th visit after this one, if there is one. All members have about as many grains and pairs.
  void for_each(int rank, int size, const auto& visit) const {
    const Share share(order_.size() + first_pair_.back(), rank, size);
    const std::size_t end = place_at(share.end);
    for (std::size_t place = place_at(share.begin); place < end; ++place)
      visit(std::size_t{order_[place]}, [&](std::size_t n) {
        return place + n < end ? std::optional<std::size_t>(order_[place + n]) : std::nullopt;
      });
  }
  /// Begins to load the grains of the next visits, and their partners, into the cache: first a grain,
  /// one visit later the object of its shape, one visit later the arrays. It changes no result.
  /// @param later  argument of a visit in for_each()
  /// @param grains with placed shapes
  /// @param pairs  of the grains, sorted
  /// @param is_near function: number of a pair -> whether the arrays of its second grain will be read
  void prefetch(const auto& later, const auto& grains, std::span<const IndexPair> pairs,
                const auto& is_near) const {
    for (std::size_t visits = 3; visits >= 1; --visits) {
      const std::optional<std::size_t> k = later(visits);
      if (!k) continue;
      const auto load = [&](const auto& grain) {
        if (visits == 3) detail::prefetch(&grain, sizeof(grain));
        if (visits == 2) grain.placed.prefetch_shape();
        if (visits == 1) grain.placed.prefetch_contact();
      };
      load(grains[*k]);
      for (std::size_t p = first_pair(*k); p < first_pair(*k + 1); ++p)
        if (visits > 1 || is_near(p)) load(grains[pairs[p].second]);
    }
  }

 private:
  /// The first place such that the grains before it and their pairs are `work` units or more.
  std::size_t place_at(std::size_t work) const {
    return std::size_t(std::lower_bound(work_.begin(), work_.end(), work) - work_.begin());
  }

  SpatialOrder<S> order_;
  List<std::size_t> first_pair_;  // of each grain; at the end, the number of pairs
  List<std::size_t> work_;        // grains and pairs before each place
  bool is_valid_ = false;
};

}  // namespace moreau::detail
