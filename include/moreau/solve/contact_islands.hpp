// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "moreau/core/disjoint_sets.hpp"
#include "moreau/core/list.hpp"

namespace moreau::detail {

/// The islands of a contact problem: sets of bodies that contacts connect. A body that cannot move
/// connects nothing. No impulse of one island changes a velocity of another.
///
/// Islands are in the order of their first contact, and contacts within an island in that of the
/// problem.
class ContactIslands {
 public:
  /// @param op the operator of the problem
  template <class Operator>
  void find(const Operator& op) {
    const std::size_t bodies = op.body_count(), contacts = op.size();
    sets_.assign(bodies);
    moves_.resize(bodies);
    for (std::size_t i = 0; i < bodies; ++i) moves_[i] = op.inverse_mass(i).moves();
    std::array<std::uint32_t, 2> before{none, none};
    for (std::size_t c = 0; c < contacts; ++c) {
      const auto pair = op.bodies(c);
      if (pair == before || !moves_[pair[0]] || !moves_[pair[1]]) continue;
      before = pair;
      sets_.unite(pair[0], pair[1]);
    }
    number(op, contacts);
  }

  std::size_t size() const { return bodies_.size(); }  ///< number of islands
  /// Number of bodies of an island that can move and have a contact.
  std::size_t bodies(std::size_t island) const { return bodies_[island]; }
  /// Number of pairs of bodies of an island that both move and have contacts. Contacts of a pair that do not follow one
  /// another count as several pairs.
  std::size_t pairs(std::size_t island) const { return pairs_[island]; }
  /// The contacts of an island, ascending.
  std::span<const std::uint32_t> contacts(std::size_t island) const {
    return std::span(contacts_).subspan(first_[island], first_[island + 1] - first_[island]);
  }
  std::span<const unsigned char> moves() const {
    return moves_;
  }  ///< whether impulses move each body

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  template <class Operator>
  void number(const Operator& op, std::size_t contacts) {
    island_of_.assign(sets_.size(), none);
    seen_.assign(sets_.size(), 0);
    of_contact_.resize(contacts);
    bodies_.clear();
    pairs_.clear();
    first_.assign(2, 0);
    std::array<std::uint32_t, 2> before{none, none};
    for (std::size_t c = 0; c < contacts; ++c) {
      const auto pair = op.bodies(c);
      if (pair != before) take(pair);
      before = pair;
      of_contact_[c] = present_;
      if (present_ != none) ++first_[present_ + 2];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    contacts_.resize(first_.back());
    // first_[k + 1] is the next free entry of island k, and at the end the first of island k + 1.
    for (std::uint32_t c = 0; c < contacts; ++c)
      if (of_contact_[c] != none) contacts_[first_[of_contact_[c] + 1]++] = c;
  }

  /// Finds the island of a pair of bodies.
  void take(const std::array<std::uint32_t, 2>& pair) {
    const auto [a, b] = pair;
    present_ = none;
    if (!moves_[a] && !moves_[b]) return;
    std::uint32_t& island = island_of_[sets_.find(moves_[a] ? a : b)];
    if (island == none) {
      island = static_cast<std::uint32_t>(bodies_.size());
      bodies_.push_back(0);
      pairs_.push_back(0);
      first_.push_back(0);
    }
    present_ = island;
    pairs_[island] += moves_[a] && moves_[b];
    for (const std::uint32_t body : {a, b})
      if (moves_[body] && !seen_[body]) seen_[body] = 1, ++bodies_[island];
  }

  std::uint32_t present_ = none;  // island of the pair taken last
  DisjointSets sets_;
  List<std::uint32_t> island_of_, of_contact_, contacts_;
  List<unsigned char> moves_, seen_;
  List<std::size_t> bodies_, pairs_, first_;
};

}  // namespace moreau::detail
