// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "moreau/core/list.hpp"

namespace moreau::detail {

/// The partition of the bodies by which threads share Gauss-Seidel sweeps. A chunk is a range of consecutive bodies, so
/// that they lie together if the bodies are in the order of a space-filling curve. Contacts whose moving bodies all
/// belong to one chunk have no body in common with those of another chunk: a member of a team visits the contacts of
/// its chunks without waiting for others. The chunks depend on the number of bodies alone, not on the team.
class BodyChunks {
 public:
  /// In place of a chunk: a contact between two chunks, and all contacts of problems without chunks.
  static constexpr std::uint32_t shared = std::numeric_limits<std::uint32_t>::max();

  /// @param least bodies of a chunk, which has up to twice as many: the number of chunks is a power of two, so that
  ///              teams of two, four, .. members have equally many
  void assign(std::size_t bodies, std::size_t least) {
    if (of_body_.size() == bodies && least_ == least) return;
    least_ = least;
    const std::size_t count = std::bit_floor(bodies / least);
    count_ = count < 2 ? 0 : count;
    of_body_.assign(bodies, shared);
    for (std::size_t k = 0; k < count_; ++k)
      std::fill(of_body_.begin() + std::ptrdiff_t(begin(k)),
                of_body_.begin() + std::ptrdiff_t(begin(k + 1)), static_cast<std::uint32_t>(k));
  }
  /// Number of chunks; 0 if the bodies are too few to be divided.
  std::size_t size() const { return count_; }
  /// The chunk of all bodies of a pair that move, of which there is at least one; `shared` if there are two.
  std::uint32_t of_pair(std::uint32_t a, std::uint32_t b, bool a_moves, bool b_moves) const {
    if (a_moves && b_moves && of_body_[a] != of_body_[b]) return shared;
    return of_body_[a_moves ? a : b];
  }
  /// The first body of a chunk; of size(), the number of bodies.
  std::size_t begin(std::size_t chunk) const {
    return (chunk * of_body_.size() + count_ - 1) / count_;  // of body i: i count / bodies
  }

 private:
  std::size_t count_ = 0, least_ = 0;
  List<std::uint32_t> of_body_;
};

}  // namespace moreau::detail
