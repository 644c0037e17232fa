// SPDX-License-Identifier: MIT
// The Delassus blocks of several independent contacts, one per SIMD lane, as local solutions need them.
#pragma once

#include <cstddef>

#include "moreau/law/local_block.hpp"
#include "moreau/simd/wide.hpp"

namespace moreau {

/// LocalBlock of one contact per lane, with the reciprocals that local solutions need.
/// @tparam NumberT detail::Wide, or detail::OneNumber for a single contact
template <class S, class NumberT = detail::Wide<typename S::Scalar, detail::widest_bytes>>
struct LaneBlock : LocalBlock<S, NumberT> {
  using Block = LocalBlock<S, NumberT>;  ///< without the reciprocals
  using typename Block::Index, typename Block::Number, typename Block::Tangent,
      typename Block::Values;
  using Memory = Values;  ///< of a local solution, see LaneLaw
  using Block::tangents;

  Values inverse_normal;  ///< 1 / normal [kg]
  Tangent inverse_slip;   ///< 1 / slip [kg]

  /// W = 1 in every lane, for lanes without a contact.
  static LaneBlock unit() {
    LaneBlock block{};
    block.normal = block.inverse_normal = Number::broadcast(1);
    for (Index t = 0; t < tangents; ++t) {
      block.coupling[t] = Values{};
      block.slip[t] = block.inverse_slip[t] = Number::broadcast(1);
    }
    return block;
  }
  /// Sets the block of a lane, lane < Number::lanes.
  void set(std::size_t lane, const LocalBlock<S>& block) {
    Block::set(lane, block);
    Number::set(inverse_normal, lane, 1 / block.normal);
    for (int t = 0; t < S::dim - 1; ++t)
      Number::set(inverse_slip[Index(t)], lane, 1 / block.slip[t]);
  }
  /// Computes the reciprocals of all lanes.
  void invert() {
    inverse_normal = 1 / this->normal;
    for (Index t = 0; t < tangents; ++t) inverse_slip[t] = 1 / this->slip[t];
  }
  /// Sets the memory of a lane to 0.
  static void forget(Memory& memory, std::size_t lane) { Number::set(memory, lane, 0); }
};

}  // namespace moreau
