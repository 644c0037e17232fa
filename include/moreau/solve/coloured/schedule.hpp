// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "moreau/core/list.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/coloured/first_fit_colouring.hpp"

namespace moreau::detail {

/// An order in which groups of contacts are visited. Groups inside a chunk of bodies come first: each
/// chunk has one member of the team, who visits them one after another, and chunks share no body. The
/// groups of one phase share no body that moves, except a hub, so that the members divide them: each has
/// about as many points. After a phase of groups of a hub, one member adds up their changes
/// of its velocity. Groups without a phase follow one after another.
class Schedule {
 public:
  /// Takes those groups k = 0, 1, .. for which points(k) > 0, the points that a visit solves.
  /// @param groups sorted: those inside chunks by chunk, then the others by phase
  template <class Group>
  void assign(const List<Group>& groups, const auto& points) {
    list_.clear();
    before_.assign(1, 0);
    for (std::uint32_t k = 0; k < groups.size(); ++k)
      if (const std::uint32_t own = points(k); own > 0) {
        list_.push_back(k);
        before_.push_back(before_.back() + own);
      }
    phases_.clear();
    chunks_.assign(1, 0);
    std::size_t i = 0;
    while (i < list_.size() && groups[list_[i]].chunk != Group::shared) {
      const std::uint32_t chunk = groups[list_[i]].chunk;
      while (i < list_.size() && groups[list_[i]].chunk == chunk) ++i;
      chunks_.push_back(i);
    }
    while (i < list_.size() && groups[list_[i]].phase != Group::serial) {
      const std::uint32_t phase = groups[list_[i]].phase;
      const std::size_t begin = i;
      while (i < list_.size() && groups[list_[i]].phase == phase) ++i;
      phases_.push_back({begin, i, phase >= FirstFitColouring::colours});
    }
    serial_ = i;
  }
  const List<std::uint32_t>& groups() const { return list_; }

  /// Calls visit(k) for all groups k, phase after phase; work of member `rank` of a team of `size`.
  /// @param wait   returns when all members have called it
  /// @param settle function: settle(k) adds up what group k of a hub has changed
  void forward(int rank, int size, auto&& wait, auto&& visit, auto&& settle) const {
    if (has_chunks()) {
      const Share own = chunks_of(rank, size);
      for (std::size_t i = own.begin; i < own.end; ++i) visit(list_[i]);
      wait();
    }
    for (const Phase& phase : phases_) {
      visit_share(phase, rank, size, visit);
      wait();
      if (!phase.of_hub) continue;
      if (rank == 0) settle_all(phase, settle);
      wait();
    }
    if (rank == 0)
      for (std::size_t i = serial_; i < list_.size(); ++i) visit(list_[i]);
  }
  /// As forward(), in the opposite order of phases.
  void backward(int rank, int size, auto&& wait, auto&& visit, auto&& settle) const {
    if (rank == 0)
      for (std::size_t i = list_.size(); i-- > serial_;) visit(list_[i]);
    for (std::size_t p = phases_.size(); p-- > 0;) {
      const Phase& phase = phases_[p];
      wait();
      visit_share(phase, rank, size, visit);
      if (!phase.of_hub) continue;
      wait();
      if (rank == 0) settle_all(phase, settle);
    }
    if (has_chunks()) {
      wait();
      const Share own = chunks_of(rank, size);
      for (std::size_t i = own.end; i-- > own.begin;) visit(list_[i]);
    }
  }

 private:
  struct Phase {
    std::size_t begin, end;  // in the list
    bool of_hub;
  };

  bool has_chunks() const { return chunks_.size() > 1; }
  /// The groups in the chunks of a member: those whose middle point lies in its share of the points.
  Share chunks_of(int rank, int size) const {
    const auto bound = [&](int members) {
      const std::size_t points = before_[chunks_.back()] * std::size_t(members);
      std::size_t chunk = 0;
      while (chunk + 1 < chunks_.size() &&
             (before_[chunks_[chunk]] + before_[chunks_[chunk + 1]]) * std::size_t(size) <
                 2 * points)
        ++chunk;
      return chunks_[chunk];
    };
    Share own(0, 0, 1);
    own.begin = bound(rank);
    own.end = rank + 1 == size ? chunks_.back() : bound(rank + 1);
    return own;
  }
  void visit_share(const Phase& phase, int rank, int size, auto&& visit) const {
    const std::size_t end = bound(phase, rank + 1, size);
    for (std::size_t i = bound(phase, rank, size); i < end; ++i) visit(list_[i]);
  }
  /// Where the share of a member begins.
  std::size_t bound(const Phase& phase, int rank, int size) const {
    if (rank == 0) return phase.begin;
    if (rank == size) return phase.end;
    const auto from = before_.begin() + std::ptrdiff_t(phase.begin);
    const auto to = before_.begin() + std::ptrdiff_t(phase.end);
    const std::size_t points = (*to - *from) * std::size_t(rank) / std::size_t(size);
    return phase.begin + std::size_t(std::lower_bound(from, to, *from + points) - from);
  }
  void settle_all(const Phase& phase, auto&& settle) const {
    for (std::size_t i = phase.begin; i < phase.end; ++i) settle(list_[i]);
  }

  List<std::uint32_t> list_;
  List<std::size_t> before_;  // points before each group in the list; at the end, all points
  List<std::size_t> chunks_;  // first group of each chunk in the list; at the end, their number
  List<Phase> phases_;
  std::size_t serial_ = 0;  // first group without a phase, in the list
};

}  // namespace moreau::detail
