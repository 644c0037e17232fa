// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "moreau/core/disjoint_sets.hpp"
#include "moreau/core/list.hpp"

namespace moreau::detail {

/// The small islands of a contact problem. An island is a set of bodies that contacts connect. A body that cannot move
/// connects nothing. No impulse of one island changes a velocity of another.
///
/// Islands are in the order of their first contact, and contacts within an island in that of the
/// problem. The contacts of large islands are not listed: a packing is one island of nearly all contacts.
class ContactIslands {
 public:
  /// @param op          the operator of the problem
  /// @param most_bodies of a small island
  template <class Operator>
  void find(const Operator& op, std::size_t most_bodies) {
    const std::size_t bodies = op.body_count(), contacts = op.size();
    sets_.assign(bodies);
    moves_.resize(bodies);
    for (std::size_t i = 0; i < bodies; ++i) moves_[i] = op.inverse_mass(i).moves();
    found_.assign(bodies, {none, 0, 0});
    // A later step with the first small island allocates no memory.
    of_contact_.resize(contacts);
    contacts_.resize(contacts);
    bodies_.reserve(bodies);
    pairs_.reserve(bodies);
    first_.reserve(bodies + 2);
    std::array<std::uint32_t, 2> before{none, none};
    std::uint32_t root = none;  // of the set of before[0]
    for (std::size_t c = 0; c < contacts; ++c) {
      const auto pair = op.bodies(c);
      if (pair == before) continue;
      const auto [a, b] = pair;
      found_[a].bodies = moves_[a];
      found_[b].bodies = moves_[b];
      if (a != before[0]) root = sets_.find(a);
      before = pair;
      if (!moves_[a] || !moves_[b]) continue;
      ++found_[a].pairs;
      const std::uint32_t other = sets_.find(b);
      if (other == root) continue;
      sets_.unite(root, other);
      root = std::min(root, other);
    }
    number(op, contacts, most_bodies);
  }

  std::size_t size() const { return bodies_.size(); }  ///< number of small islands
  /// Whether there are large islands.
  bool has_large() const { return has_large_; }
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

  /// Of each body, and of the island in which it has the smallest number.
  struct Found {
    std::uint32_t island;  // its number; none: not small, or not numbered yet
    std::uint32_t bodies;  // that can move and have a contact
    std::uint32_t pairs;   // of bodies that can move
  };

  template <class Operator>
  void number(const Operator& op, std::size_t contacts, std::size_t most_bodies) {
    bodies_.clear();
    pairs_.clear();
    first_.assign(2, 0);
    bool has_small = false;
    has_large_ = false;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const std::uint32_t root = sets_.find(i);  // at most i
      if (root == i) continue;
      found_[root].bodies += found_[i].bodies;
      found_[root].pairs += found_[i].pairs;
      found_[i] = {none, 0, 0};
    }
    for (const Found& island : found_) {
      has_large_ = has_large_ || island.bodies > most_bodies;
      has_small = has_small || (island.bodies > 0 && island.bodies <= most_bodies);
    }
    if (!has_small) return;
    std::array<std::uint32_t, 2> before{none, none};
    std::uint32_t island = none;
    for (std::size_t c = 0; c < contacts; ++c) {
      const auto pair = op.bodies(c);
      if (pair != before) island = island_of(pair, most_bodies);
      before = pair;
      of_contact_[c] = island;
      if (island != none) ++first_[island + 2];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    contacts_.resize(first_.back());
    // first_[k + 1] is the next free entry of island k, and at the end the first of island k + 1.
    for (std::uint32_t c = 0; c < contacts; ++c)
      if (of_contact_[c] != none) contacts_[first_[of_contact_[c] + 1]++] = c;
  }

  /// The small island of a pair of bodies, which gets a number.
  std::uint32_t island_of(const std::array<std::uint32_t, 2>& pair, std::size_t most_bodies) {
    const auto [a, b] = pair;
    if (!moves_[a] && !moves_[b]) return none;
    Found& found = found_[sets_.find(moves_[a] ? a : b)];
    if (found.bodies > most_bodies) return none;
    if (found.island == none) {
      found.island = static_cast<std::uint32_t>(bodies_.size());
      bodies_.push_back(found.bodies);
      pairs_.push_back(found.pairs);
      first_.push_back(0);
    }
    return found.island;
  }

  bool has_large_ = false;
  DisjointSets sets_;
  List<Found> found_;
  List<std::uint32_t> of_contact_, contacts_;
  List<unsigned char> moves_;
  List<std::size_t> bodies_, pairs_, first_;
};

}  // namespace moreau::detail
