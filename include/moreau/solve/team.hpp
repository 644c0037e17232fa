// SPDX-License-Identifier: MIT
// Who does the work of a solver. A team runs a piece of work on all its members at once:
//
//     team.run([&](int rank, int size, auto&& meet) { ... });
//
// rank is 0 .. size - 1; meet() returns once all members have come to it; run() returns when all
// are done. What the members write must not depend on how many they are.
#pragma once

#include <concepts>
#include <cstddef>

namespace moreau {

/// The calling thread alone.
struct SingleThread {
  /// See Team.
  template <class Work>
  void run(Work&& work) const {
    work(0, 1, [] {});
  }
};

/// Copies are cheap and do the same work; run() and meet() are what the header says.
template <class T>
concept Team = std::copyable<T> && requires(const T team) {
  team.run([](int, int, auto&& meet) { meet(); });
};

namespace detail {

/// The part of 0 .. count - 1 that a member of a team does.
struct Share {
  std::size_t begin, end;
  Share(std::size_t count, int rank, int size)
      : begin(count * std::size_t(rank) / std::size_t(size)),
        end(count * std::size_t(rank + 1) / std::size_t(size)) {}
};

}  // namespace detail

}  // namespace moreau
