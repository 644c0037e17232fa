// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/core/list.hpp"
#include "moreau/solve/coloured/used_colours.hpp"

namespace moreau::detail {

/// Colours pairs of bodies in their order, each with the first colour that is unused at both bodies: no two pairs of one colour share a
/// body that can move, unless one of them lies inside a chunk and the other does not. One pass over the pairs of one
/// process; the colours depend on their order.
class FirstFitColouring {
 public:
  static constexpr std::uint32_t colours = UsedColours<1>::colours;
  /// A body with more partners is a hub. Its pairs are not coloured: each would need its own
  /// colour.
  static constexpr std::uint32_t hub = 48;

  /// @param pairs  the two bodies of each pair
  /// @param moves  not 0 if a body can move, one entry per body
  /// @param is_inside function: pair -> whether it lies inside a block
  void assign(std::span<const std::array<std::uint32_t, 2>> pairs,
              std::span<const unsigned char> moves, const auto& is_inside) {
    degree_.assign(moves.size(), 0);
    used_.start(2 * moves.size());
    colour_.resize(pairs.size());
    for (const auto& [a, b] : pairs) degree_[a] += moves[a] != 0, degree_[b] += moves[b] != 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [a, b] = pairs[k];
      if (is_hub(a) || is_hub(b)) {
        colour_[k] = colours;
        continue;
      }
      const std::size_t kind = is_inside(k) ? 1 : 0;
      const auto place = [&](std::uint32_t body) {
        return UsedColours<1>::Place{2 * std::size_t{body} + kind, moves[body] != 0};
      };
      colour_[k] = used_.take_first({place(a), place(b)});
    }
  }

  /// Whether a body can move and has more than `hub` partners.
  bool is_hub(std::uint32_t body) const { return degree_[body] > hub; }
  /// Colour of a pair; `colours` if it has none.
  std::uint32_t operator[](std::size_t pair) const { return colour_[pair]; }

 private:
  List<std::uint32_t> degree_, colour_;
  UsedColours<1> used_;  // at each body: of the pairs that lie inside a block, and of the others
};

}  // namespace moreau::detail
