// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "moreau/core/erase_at.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace moreau::detail {

/// Which pairs of bodies a detector examines: all, unless set() was called.
class PairFilter {
 public:
  /// @param keeps (a, b) -> whether the pair of the bodies with these indices is examined
  void set(std::function<bool(std::uint32_t, std::uint32_t)> keeps) { keeps_ = std::move(keeps); }
  bool leaves_out(BodyId a, BodyId b) const { return keeps_ && !keeps_(a.value, b.value); }
  /// Erases the pairs that are left out.
  /// @param grains the grains that the pairs are of
  /// @param shifts one per pair, or none
  template <class Shift>
  void erase(const auto& grains, std::vector<IndexPair>& pairs, std::vector<Shift>& shifts) const {
    if (!keeps_) return;
    const auto is_gone = [&](std::size_t p) {
      return leaves_out(grains[pairs[p].first].body, grains[pairs[p].second].body);
    };
    erase_at(shifts, is_gone);
    erase_at(pairs, is_gone);
  }

 private:
  std::function<bool(std::uint32_t, std::uint32_t)> keeps_;
};

}  // namespace moreau::detail
