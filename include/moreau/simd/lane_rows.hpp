// SPDX-License-Identifier: MIT
// Numbers that follow one another in memory, of one object per SIMD lane: read into registers with an entry each, and
// written back. Squares of as many entries as there are lanes are transposed, which takes a third of the instructions of
// copying number by number.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include "moreau/core/compiled_once.hpp"

namespace moreau::detail {

/// Where the squares of N entries begin; the last square overlaps the one before if N is no multiple of the lanes.
template <std::size_t N, std::size_t Lanes>
constexpr std::size_t first_of_square(std::size_t square) {
  return square * Lanes + Lanes <= N ? square * Lanes : N - Lanes;
}

/// Reads N consecutive numbers of each lane: lane l of to(k) becomes rows[l][k].
/// @tparam Number Wide
/// @param  to     function: std::integral_constant k -> reference to the register of entry k
template <class Number, std::size_t N, class T>
MOREAU_INLINED inline void read_rows(const std::array<const T*, std::size_t{Number::lanes}>& rows,
                                     const auto& to) {
  using Values = typename Number::Values;
  constexpr std::size_t lanes = Number::lanes;
  if constexpr (N < lanes) {
    [&]<std::size_t... K>(std::index_sequence<K...>) MOREAU_INLINED_LAMBDA {
      const auto read = [&](auto k) MOREAU_INLINED_LAMBDA {
        Values v{};
        for (std::size_t l = 0; l < lanes; ++l) v[l] = rows[l][k];
        to(k) = v;
      };
      (read(std::integral_constant<std::size_t, K>()), ...);
    }
    (std::make_index_sequence<N>());
  } else {
    const auto read = [&](auto first) MOREAU_INLINED_LAMBDA {
      Values square[lanes];
      // Written out: g++ does not unroll loops over the lanes.
      [&]<std::size_t... L>(std::index_sequence<L...>) MOREAU_INLINED_LAMBDA {
        ((square[L] = Number::load(rows[L] + first)), ...);
      }
      (std::make_index_sequence<lanes>());
      Number::transpose(square);
      [&]<std::size_t... K>(std::index_sequence<K...>) MOREAU_INLINED_LAMBDA {
        ((to(std::integral_constant<std::size_t, first + K>()) = square[K]), ...);
      }
      (std::make_index_sequence<lanes>());
    };
    [&]<std::size_t... Square>(std::index_sequence<Square...>) MOREAU_INLINED_LAMBDA {
      (read(std::integral_constant<std::size_t, first_of_square<N, lanes>(Square)>()), ...);
    }
    (std::make_index_sequence<(N + lanes - 1) / lanes>());
  }
}

/// Writes N consecutive numbers of each lane: rows[l][k] becomes lane l of from(k).
/// @param from function: std::integral_constant k -> the register of entry k
template <class Number, std::size_t N, class T>
MOREAU_INLINED inline void write_rows(const std::array<T*, std::size_t{Number::lanes}>& rows,
                                      const auto& from) {
  using Values = typename Number::Values;
  constexpr std::size_t lanes = Number::lanes;
  if constexpr (N < lanes) {
    const auto write = [&](auto k) MOREAU_INLINED_LAMBDA {
      const Values v = from(k);
      for (std::size_t l = 0; l < lanes; ++l) rows[l][k] = v[l];
    };
    [&]<std::size_t... K>(std::index_sequence<K...>) MOREAU_INLINED_LAMBDA {
      (write(std::integral_constant<std::size_t, K>()), ...);
    }
    (std::make_index_sequence<N>());
  } else {
    const auto write = [&](auto first) MOREAU_INLINED_LAMBDA {
      Values square[lanes];
      [&]<std::size_t... K>(std::index_sequence<K...>) MOREAU_INLINED_LAMBDA {
        ((square[K] = from(std::integral_constant<std::size_t, first + K>())), ...);
      }
      (std::make_index_sequence<lanes>());
      Number::transpose(square);
      [&]<std::size_t... L>(std::index_sequence<L...>) MOREAU_INLINED_LAMBDA {
        (std::memcpy(rows[L] + first, &square[L], sizeof(Values)), ...);
      }
      (std::make_index_sequence<lanes>());
    };
    [&]<std::size_t... Square>(std::index_sequence<Square...>) MOREAU_INLINED_LAMBDA {
      (write(std::integral_constant<std::size_t, first_of_square<N, lanes>(Square)>()), ...);
    }
    (std::make_index_sequence<(N + lanes - 1) / lanes>());
  }
}

}  // namespace moreau::detail
