// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/core/list.hpp"

namespace moreau::detail {

/// The pairs of bodies of a contact problem, in the order of their contacts. The contacts of a pair must follow one another; if
/// they do not, the pair is listed several times.
class ContactPairs {
 public:
  using Pair = std::array<std::uint32_t, 2>;  ///< bodies a and b

  /// Lists the pairs.
  /// @param contacts  their number
  /// @param bodies_of function: contact -> Pair
  void list(std::size_t contacts, const auto& bodies_of) {
    bodies_.clear();
    first_.clear();
    for (std::size_t c = 0; c < contacts; ++c) {
      const Pair& pair = bodies_of(c);
      if (c > 0 && pair == bodies_.back()) continue;
      bodies_.push_back(pair);
      first_.push_back(static_cast<std::uint32_t>(c));
    }
    first_.push_back(static_cast<std::uint32_t>(contacts));
  }

  std::size_t size() const { return bodies_.size(); }       ///< number of pairs
  std::span<const Pair> bodies() const { return bodies_; }  ///< of each pair
  /// The first contact of each pair; at the end, the number of contacts.
  std::span<const std::uint32_t> first() const { return first_; }

 private:
  List<Pair> bodies_;
  List<std::uint32_t> first_;
};

}  // namespace moreau::detail
