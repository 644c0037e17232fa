// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/simd/cache_lines.hpp"
#include "moreau/solve/coloured/contact_groups.hpp"

namespace moreau::detail {

/// Velocities y = (v, w) of all bodies, one for each body, read and written for one body per SIMD lane
/// at once.
template <class S, class Number>
class LaneVelocities {
 public:
  using T = typename S::Scalar;
  using Values = typename Number::Values;
  static constexpr std::size_t registers = (S::dofs + Number::lanes - 1) / Number::lanes;
  /// Entry k of y, one body per lane.
  using BodyLanes = std::array<Values, registers * Number::lanes>;
  using Bodies = std::array<std::uint32_t, std::size_t{Number::lanes}>;

  /// Sets all velocities to zero.
  /// @param moving the first of them, which extrapolate() changes: the others stay zero
  void reset(std::size_t count, std::size_t moving) {
    now_.assign(registers * count, Values{});
    moving_ = registers * moving;
  }
  /// All velocities, `width` numbers each.
  std::span<T> scalars() {
    return {reinterpret_cast<T*>(now_.data()), now_.size() * std::size_t{Number::lanes}};
  }
  static constexpr std::size_t width = registers * Number::lanes;
  void set(std::size_t body, const auto& y) {
    for (int k = 0; k < S::dofs; ++k)
      now_[registers * body + std::size_t(k / Number::lanes)][k % Number::lanes] = y[k];
  }
  /// Change of the velocity of a body, (v, w).
  std::array<T, std::size_t{S::dofs}> of(std::size_t body) const {
    std::array<T, std::size_t{S::dofs}> y;
    for (std::size_t k = 0; k < S::dofs; ++k) y[k] = entry(body, k);
    return y;
  }
  /// Makes the present velocities the velocities before the next extrapolation, which then adds nothing.
  void forget_change() { before_.assign(now_.data(), now_.data() + moving_); }
  /// Adds beta times the change since the last extrapolation; the work of one member of a team.
  MOREAU_COMPILED_ONCE void extrapolate(T beta, int rank, int size) {
    const Values factor = Number::broadcast(beta);
    const Share share(moving_, rank, size);
    for (std::size_t i = share.begin; i < share.end; ++i) {
      const Values now = now_[i];
      now_[i] = now + factor * (now - before_[i]);
      before_[i] = now;
    }
  }

  /// Begins to load the velocities of some bodies into the cache.
  void prefetch(const Bodies& bodies) const {
    for (const std::uint32_t body : bodies) __builtin_prefetch(&now_[registers * body]);
  }
  MOREAU_INLINED BodyLanes gather(const Bodies& bodies) const {
    BodyLanes y;
    for (std::size_t k = 0; k < registers; ++k) {
      Values rows[Number::lanes];
      for (std::size_t l = 0; l < Number::lanes; ++l) rows[l] = now_[registers * bodies[l] + k];
      Number::transpose(rows);
      for (std::size_t l = 0; l < Number::lanes; ++l) y[k * Number::lanes + l] = rows[l];
    }
    return y;
  }
  /// A change of the velocity of one body.
  using Change = std::array<T, std::size_t{S::dofs}>;

  /// Writes the velocities of the bodies of a group; adds up the changes of all lanes for the hub.
  template <class Group>
  MOREAU_INLINED void scatter(const Group& group, const BodyLanes& a, const BodyLanes& b) {
    if (group.hub == Hub::none) {
      scatter(group.a, a);
      scatter(group.b, b);
    } else {
      add(group, scatter_partners(group, a, b));
    }
  }
  /// Writes the velocities of the partners of the hub of a group.
  /// @returns the sum of the changes of all lanes for the hub
  template <class Group>
  MOREAU_COMPILED_ONCE Change scatter_partners(const Group& group, const BodyLanes& a,
                                               const BodyLanes& b) {
    const bool hub_is_a = group.hub == Hub::a;
    scatter(hub_is_a ? group.b : group.a, hub_is_a ? b : a);
    const BodyLanes& y = hub_is_a ? a : b;
    Change change;
    for (std::size_t k = 0; k < S::dofs; ++k)
      change[k] = Number::sum(y[k] - Number::broadcast(entry(hub_of(group), k)));
    return change;
  }
  /// Adds a change to the velocity of the hub of a group.
  template <class Group>
  void add(const Group& group, const Change& change) {
    for (std::size_t k = 0; k < S::dofs; ++k) {
      Values& entries = now_[registers * hub_of(group) + k / Number::lanes];
      entries[k % Number::lanes] += change[k];
    }
  }

 private:
  MOREAU_INLINED void scatter(const Bodies& bodies, const BodyLanes& y) {
    for (std::size_t k = 0; k < registers; ++k) {
      Values rows[Number::lanes];
      for (std::size_t l = 0; l < Number::lanes; ++l) rows[l] = y[k * Number::lanes + l];
      Number::transpose(rows);
      for (std::size_t l = 0; l < Number::lanes; ++l) now_[registers * bodies[l] + k] = rows[l];
    }
  }
  template <class Group>
  static std::uint32_t hub_of(const Group& group) {
    return group.hub == Hub::a ? group.a[0] : group.b[0];
  }
  T entry(std::size_t body, std::size_t k) const {
    return now_[registers * body + k / Number::lanes][k % Number::lanes];
  }

  List<Values, cache_line> now_, before_;  // before_: only of those that extrapolate() changes
  std::size_t moving_ = 0;                 // the first of them, that extrapolate() changes
};

}  // namespace moreau::detail
