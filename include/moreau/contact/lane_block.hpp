// SPDX-License-Identifier: MIT
// The Delassus blocks of several independent contacts, one per SIMD lane.
#pragma once

#include <array>
#include <cstddef>

#include "moreau/contact/local_block.hpp"
#include "moreau/core/detail/wide.hpp"

namespace moreau {

/// LocalBlock of one contact per lane, with the reciprocals that local solutions need.
template <class S>
struct LaneBlock {
  static constexpr std::size_t dim = S::dim;        ///< D, rows of a contact
  static constexpr std::size_t tangents = dim - 1;  ///< D - 1
  using W = detail::Wide<typename S::Scalar, detail::widest_bytes>;
  using Values = typename W::Values;
  using Vector = std::array<Values, dim>;
  using Tangent = std::array<Values, tangents>;

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
    normal[lane] = block.normal;
    inverse_normal[lane] = 1 / block.normal;
    for (std::size_t t = 0; t < tangents; ++t) {
      coupling[t][lane] = block.coupling[Eigen::Index(t)];
      slip[t][lane] = block.slip[Eigen::Index(t)];
      inverse_slip[t][lane] = 1 / block.slip[Eigen::Index(t)];
    }
  }
  /// The block of a lane, lane < W::lanes.
  LocalBlock<S> operator[](std::size_t lane) const {
    LocalBlock<S> block;
    block.normal = normal[lane];
    for (std::size_t t = 0; t < tangents; ++t) {
      block.coupling[Eigen::Index(t)] = coupling[t][lane];
      block.slip[Eigen::Index(t)] = slip[t][lane];
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
