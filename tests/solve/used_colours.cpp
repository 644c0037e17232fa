// SPDX-License-Identifier: MIT
#include "moreau/solve/coloured/used_colours.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/solve/coloured/first_fit_colouring.hpp"

using namespace moreau::detail;

TEST_CASE("a pair takes the first colour that is free at its places, if they count") {
  using Used = UsedColours<2>;
  Used used;
  used.start(3);
  for (std::uint32_t k = 0; k < Used::colours; ++k) {
    CHECK(used.take_first({Used::Place{0, true}, Used::Place{1, true}}) == k);
    CHECK(used.take_first({Used::Place{0, false}, Used::Place{2, false}}) == 0);
  }
  CHECK(used.take_first({Used::Place{0, true}, Used::Place{2, true}}) == Used::colours);
  CHECK(used.take_first({Used::Place{0, false}, Used::Place{2, true}}) == 0);
  CHECK(used.take_first({Used::Place{2, true}, Used::Place{2, true}}) == 1);
}

TEST_CASE("first fit: pairs of one colour share no moving body, and every lower colour is taken") {
  std::mt19937_64 random(4);
  constexpr std::uint32_t bodies = 200;
  std::vector<unsigned char> moves(bodies, 1);
  for (std::uint32_t i = 0; i < bodies; i += 10) moves[i] = 0;
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (int k = 0; k < 1500; ++k) {
    const auto a = static_cast<std::uint32_t>(random() % bodies);
    pairs.push_back({a, static_cast<std::uint32_t>((a + 1 + random() % (bodies - 1)) % bodies)});
  }
  const auto is_inside = [](std::size_t k) { return k % 3 == 0; };
  FirstFitColouring colouring;
  colouring.assign(pairs, moves, is_inside);
  int wrong = 0, gaps = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    std::vector<unsigned char> taken(FirstFitColouring::colours, 0);
    for (std::size_t j = 0; j < k; ++j) {
      if (is_inside(j) != is_inside(k)) continue;
      for (const std::uint32_t body : pairs[k])
        if (moves[body] && (body == pairs[j][0] || body == pairs[j][1])) taken[colouring[j]] = 1;
    }
    wrong += taken[colouring[k]];
    for (std::uint32_t lower = 0; lower < colouring[k]; ++lower) gaps += taken[lower] == 0;
  }
  CHECK(wrong == 0);
  CHECK(gaps == 0);
}
