// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace moreau::detail {

/// The colours that are used at each of some places, such as bodies: `Words` times 64 colours.
template <std::size_t Words>
class UsedColours {
 public:
  static constexpr std::uint32_t colours = 64 * Words;
  static constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

  /// Makes all colours free.
  void start(std::size_t places) { bits_.assign(Words * places, 0); }
  /// Takes the first colour that is free at both places; either may be `nowhere`.
  /// @returns its number; `colours` if there is none
  std::uint32_t take_first(std::array<std::size_t, 2> places) {
    for (std::size_t word = 0; word < Words; ++word) {
      std::uint64_t taken = 0;
      for (const std::size_t place : places)
        if (place != nowhere) taken |= bits_[Words * place + word];
      const auto free = static_cast<std::uint32_t>(std::countr_one(taken));
      if (free == 64) continue;
      for (const std::size_t place : places)
        if (place != nowhere) bits_[Words * place + word] |= std::uint64_t{1} << free;
      return static_cast<std::uint32_t>(64 * word) + free;
    }
    return colours;
  }
  /// `Words` numbers per place, with a bit for each colour.
  std::vector<std::uint64_t>& bits() { return bits_; }

 private:
  std::vector<std::uint64_t> bits_;
};

}  // namespace moreau::detail
