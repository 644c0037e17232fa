// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "moreau/core/team.hpp"
#include "moreau/solve/coloured/pair_colouring.hpp"

namespace moreau::detail {

/// An order in which groups of contacts are visited. A phase is a run of groups of one colour: they
/// share no body that moves, so that the members of a team divide them. Groups without a colour
/// follow one after another.
class Schedule {
 public:
  /// Takes those groups k = 0, 1, .. for which takes(k).
  /// @param groups sorted by their member colour
  void assign(const auto& groups, const auto& takes) {
    list_.clear();
    for (std::uint32_t k = 0; k < groups.size(); ++k)
      if (takes(k)) list_.push_back(k);
    ends_.clear();
    std::size_t i = 0;
    while (i < list_.size() && groups[list_[i]].colour != PairColouring::colours) {
      const std::uint32_t colour = groups[list_[i]].colour;
      while (i < list_.size() && groups[list_[i]].colour == colour) ++i;
      ends_.push_back(i);
    }
  }
  const std::vector<std::uint32_t>& groups() const { return list_; }

  /// Calls visit(k) for all groups k, phase after phase; work of member `rank` of a team of `size`.
  /// @param wait returns when all members have called it
  void forward(int rank, int size, auto&& wait, auto&& visit) const {
    std::size_t begin = 0;
    for (const std::size_t end : ends_) {
      const Share share(end - begin, rank, size);
      for (std::size_t i = begin + share.begin; i < begin + share.end; ++i) visit(list_[i]);
      begin = end;
      wait();
    }
    if (rank == 0)
      for (std::size_t i = begin; i < list_.size(); ++i) visit(list_[i]);
  }
  /// As forward(), in the opposite order of phases.
  void backward(int rank, int size, auto&& wait, auto&& visit) const {
    const std::size_t serial = ends_.empty() ? 0 : ends_.back();
    if (rank == 0)
      for (std::size_t i = list_.size(); i-- > serial;) visit(list_[i]);
    for (std::size_t p = ends_.size(); p-- > 0;) {
      wait();
      const std::size_t begin = p > 0 ? ends_[p - 1] : 0;
      const Share share(ends_[p] - begin, rank, size);
      for (std::size_t i = begin + share.begin; i < begin + share.end; ++i) visit(list_[i]);
    }
  }

 private:
  std::vector<std::uint32_t> list_;
  std::vector<std::size_t> ends_;  // of each phase, in the list
};

}  // namespace moreau::detail
