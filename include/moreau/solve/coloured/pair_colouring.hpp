// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace moreau::detail {

/// Colours pairs of bodies: no two pairs of one colour share a body that can move, unless one of them
/// lies inside a block and the other does not.
class PairColouring {
 public:
  static constexpr std::uint32_t colours = 64;
  /// A body with more partners is a hub. Its pairs are not coloured: each would need its own
  /// colour.
  static constexpr std::uint32_t hub = 48;

  /// @param pairs  the two bodies of each pair
  /// @param moves  whether a body can move, one entry per body
  /// @param is_inside function: pair -> whether it lies inside a block
  void assign(std::span<const std::array<std::uint32_t, 2>> pairs,
              std::span<const unsigned char> moves, const auto& is_inside) {
    degree_.assign(moves.size(), 0);
    used_.assign(moves.size(), {});
    colour_.resize(pairs.size());
    for (const auto& [a, b] : pairs) degree_[a] += moves[a], degree_[b] += moves[b];
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [a, b] = pairs[k];
      if (is_hub(a) || is_hub(b)) {
        colour_[k] = colours;
        continue;
      }
      const std::size_t kind = is_inside(k) ? 1 : 0;
      std::uint64_t &of_a = used_[a][kind], &of_b = used_[b][kind];
      const std::uint64_t taken = (moves[a] ? of_a : 0) | (moves[b] ? of_b : 0);
      const auto free = static_cast<std::uint32_t>(std::countr_one(taken));
      colour_[k] = free;
      if (free == colours) continue;
      of_a |= std::uint64_t{1} << free;
      of_b |= std::uint64_t{1} << free;
    }
  }

  /// Whether a body can move and has more than `hub` partners.
  bool is_hub(std::uint32_t body) const { return degree_[body] > hub; }
  /// Colour of a pair; `colours` if it has none.
  std::uint32_t operator[](std::size_t pair) const { return colour_[pair]; }

 private:
  std::vector<std::uint32_t> degree_, colour_;
  std::vector<std::array<std::uint64_t, 2>> used_;  // colours at each body
};

}  // namespace moreau::detail
