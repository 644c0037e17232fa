// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "moreau/core/list.hpp"

namespace moreau::detail {

/// The colours that are used at each of some places, such as bodies: `Words` times 64 colours.
template <std::size_t Words>
class UsedColours {
 public:
  static constexpr std::uint32_t colours = 64 * Words;

  /// One of the places of a pair.
  struct Place {
    std::size_t index;  ///< of a place, also if it does not count
    bool counts;        ///< whether its colours matter
  };

  /// Makes all colours unused.
  void start(std::size_t places) { bits_.assign(Words * places, 0); }
  /// Takes the first colour that is unused at both places.
  /// @returns its number; `colours` if there is none
  std::uint32_t take_first(const std::array<Place, 2>& places) {
    for (std::size_t word = 0; word < Words; ++word) {
      std::uint64_t taken = 0;
      for (const Place& place : places)
        taken |= place.counts ? bits_[Words * place.index + word] : 0;
      const auto free = static_cast<std::uint32_t>(std::countr_one(taken));
      if (free == 64) continue;
      for (const Place& place : places)
        bits_[Words * place.index + word] |= std::uint64_t{place.counts} << free;
      return static_cast<std::uint32_t>(64 * word) + free;
    }
    return colours;
  }
  /// `Words` numbers per place, with a bit for each colour.
  List<std::uint64_t>& bits() { return bits_; }

 private:
  List<std::uint64_t> bits_;
};

}  // namespace moreau::detail
