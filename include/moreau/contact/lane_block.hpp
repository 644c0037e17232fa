// SPDX-License-Identifier: MIT
// The Delassus blocks of several independent contacts, one per SIMD lane, or of one contact, for local
// solutions that are written once for both.
#pragma once

#include <array>
#include <cstddef>

#include "moreau/contact/local_block.hpp"
#include "moreau/core/detail/wide.hpp"

namespace moreau {

/// LocalBlock of one contact per lane, with the reciprocals that local solutions need.
/// @tparam Number detail::Wide, or detail::OneNumber for a single contact
template <class S, class Number = detail::Wide<typename S::Scalar, detail::widest_bytes>>
struct LaneBlock {
  static constexpr std::size_t dim = S::dim;        ///< D
  static constexpr std::size_t rows = dim;          ///< rows of a contact
  static constexpr std::size_t tangents = dim - 1;  ///< D - 1
  using W = Number;
  using Values = typename W::Values;
  using Vector = std::array<Values, dim>;
  using Tangent = std::array<Values, tangents>;
  using Memory = Values;  ///< of a local solution, see LaneLaw

  Values normal;          ///< as in LocalBlock [1/kg]
  Values inverse_normal;  ///< 1 / normal [kg]
  Tangent coupling;       ///< as in LocalBlock [-]
  Tangent slip;           ///< as in LocalBlock [1/kg]
  Tangent inverse_slip;   ///< 1 / slip [kg]

  /// W = 1 in every lane, for lanes without a contact.
  static LaneBlock unit() {
    LaneBlock block{};
    block.normal = block.inverse_normal = W::broadcast(1);
    for (std::size_t t = 0; t < tangents; ++t)
      block.slip[t] = block.inverse_slip[t] = W::broadcast(1);
    return block;
  }
  /// Sets the block of a lane, lane < W::lanes.
  void set(std::size_t lane, const LocalBlock<S>& block) {
    W::set(normal, lane, block.normal);
    W::set(inverse_normal, lane, 1 / block.normal);
    for (std::size_t t = 0; t < tangents; ++t) {
      W::set(coupling[t], lane, block.coupling[Eigen::Index(t)]);
      W::set(slip[t], lane, block.slip[Eigen::Index(t)]);
      W::set(inverse_slip[t], lane, 1 / block.slip[Eigen::Index(t)]);
    }
  }
  /// Sets the memory of a lane to 0.
  static void forget(Memory& memory, std::size_t lane) { W::set(memory, lane, 0); }
  /// The block of a lane, lane < W::lanes.
  LocalBlock<S> operator[](std::size_t lane) const {
    LocalBlock<S> block;
    block.normal = W::get(normal, lane);
    for (std::size_t t = 0; t < tangents; ++t) {
      block.coupling[Eigen::Index(t)] = W::get(coupling[t], lane);
      block.slip[Eigen::Index(t)] = W::get(slip[t], lane);
    }
    return block;
  }
  /// W r [m/s] in every lane, of impulses r [N s], normal first.
  Vector operator*(const Vector& r) const {
    Values sum = r[0];
    for (std::size_t t = 0; t < tangents; ++t) sum += coupling[t] * r[t + 1];
    Vector u;
    u[0] = normal * sum;
    for (std::size_t t = 0; t < tangents; ++t) u[t + 1] = u[0] * coupling[t] + slip[t] * r[t + 1];
    return u;
  }
};

}  // namespace moreau
