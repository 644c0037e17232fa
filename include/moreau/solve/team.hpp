// SPDX-License-Identifier: MIT
// The threads that share the work of a solver. A team runs a piece of work on all its members at
// once:
//
//     team.run([&](int rank, int size, auto&& wait) { ... });
//
// rank is 0 .. size - 1. wait() is a barrier: it returns once all members have called it. run()
// returns when all members are done. The results must not depend on the size of the team.
#pragma once

#include <concepts>
#include <cstddef>

namespace moreau {

/// A team of the calling thread alone.
struct SingleThread {
  /// See Team.
  template <class Work>
  void run(Work&& work) const {
    work(0, 1, [] {});
  }
};

/// A team, see the head of this file. Copies are cheap and share the threads.
template <class T>
concept Team = std::copyable<T> && requires(const T team) {
  team.run([](int, int, auto&& wait) { wait(); });
};

namespace detail {

/// The part of 0 .. count - 1 for one member of a team.
struct Share {
  std::size_t begin, end;
  Share(std::size_t count, int rank, int size)
      : begin(count * std::size_t(rank) / std::size_t(size)),
        end(count * std::size_t(rank + 1) / std::size_t(size)) {}
};

}  // namespace detail

}  // namespace moreau
