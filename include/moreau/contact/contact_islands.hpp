// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "moreau/contact/contact_pairs.hpp"
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
  static constexpr std::size_t most_bodies = 200;  ///< of a small island

  /// Finds the islands unless they are known.
  /// @param op operator of the contacts
  template <class Operator>
  void find_once(const Operator& op) {
    if (!std::exchange(are_known_, true)) find(op);
  }
  void forget() { are_known_ = false; }  ///< when the contacts change

  std::size_t size() const { return bodies_.size(); }  ///< number of small islands
  /// Whether there are large islands.
  bool has_large() const { return has_large_; }
  /// Number of bodies of an island that can move and have a contact.
  std::size_t bodies(std::size_t island) const { return bodies_[island]; }
  /// Number of pairs of bodies of an island that both move and have contacts.
  std::size_t pairs(std::size_t island) const { return pairs_[island]; }
  /// The contacts of an island, ascending.
  std::span<const std::uint32_t> contacts(std::size_t island) const {
    return std::span(contacts_).subspan(first_[island], first_[island + 1] - first_[island]);
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Of each body, and of the island in which it has the smallest number.
  struct Found {
    std::uint32_t island;  // its number; none: not small, or not numbered yet
    std::uint32_t bodies;  // that can move and have a contact
    std::uint32_t pairs;   // of bodies that can move
  };

  template <class Operator>
  void find(const Operator& op) {
    const std::size_t bodies = op.body_count();
    const std::span<const unsigned char> freedoms = op.freedoms();
    sets_.assign(bodies);
    found_.assign(bodies, {none, 0, 0});
    // A later step with the first small island allocates no memory.
    island_of_.resize(op.size());
    contacts_.resize(op.size());
    bodies_.reserve(bodies);
    pairs_.reserve(bodies);
    first_.reserve(bodies + 2);
    std::uint32_t last = none, root = none;  // a body, and the root of its set
    for (const auto [a, b] : op.pairs().bodies()) {
      found_[b].bodies = freedoms[b] != 0;
      if (a != last) {
        found_[a].bodies = freedoms[a] != 0;
        root = sets_.find(last = a);
      }
      if (!freedoms[a] || !freedoms[b]) continue;
      ++found_[a].pairs;
      const std::uint32_t other = sets_.find(b);
      if (other != root) root = sets_.join(root, other);
    }
    bodies_.clear();
    if (add_up()) number(op.pairs(), freedoms);
  }
  /// Adds the bodies and pairs of each island up where its smallest number is.
  /// @returns whether an island is small
  bool add_up() {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const std::uint32_t root = sets_.find(i);  // at most i
      if (root == i) continue;
      found_[root].bodies += found_[i].bodies;
      found_[root].pairs += found_[i].pairs;
      found_[i] = {none, 0, 0};
    }
    bool has_small = false;
    has_large_ = false;
    for (const Found& island : found_) {
      has_large_ = has_large_ || island.bodies > most_bodies;
      has_small = has_small || (island.bodies > 0 && island.bodies <= most_bodies);
    }
    return has_small;
  }
  /// Numbers the small islands and lists their contacts.
  void number(const ContactPairs& pairs, std::span<const unsigned char> freedoms) {
    const std::span<const std::uint32_t> first = pairs.first();
    pairs_.clear();
    first_.assign(2, 0);
    std::uint32_t last = none, island = none;  // a body, and its island
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [a, b] = pairs.bodies()[k];
      const std::uint32_t body = freedoms[a] ? a : b;
      island_of_[k] = none;
      if (!freedoms[body]) continue;
      if (body != last) island = island_of(found_[sets_.find(last = body)]);
      island_of_[k] = island;
      if (island != none) first_[island + 2] += first[k + 1] - first[k];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    contacts_.resize(first_.back());
    // first_[k + 1] is the next free entry of island k, and at the end the first of island k + 1.
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (island_of_[k] == none) continue;
      for (std::uint32_t c = first[k]; c < first[k + 1]; ++c)
        contacts_[first_[island_of_[k] + 1]++] = c;
    }
  }
  /// The number of an island, which it gets here; none: it is large.
  std::uint32_t island_of(Found& found) {
    if (found.bodies > most_bodies) return none;
    if (found.island == none) {
      found.island = static_cast<std::uint32_t>(bodies_.size());
      bodies_.push_back(found.bodies);
      pairs_.push_back(found.pairs);
      first_.push_back(0);
    }
    return found.island;
  }

  bool are_known_ = false;
  bool has_large_ = false;
  DisjointSets sets_;
  List<Found> found_;
  List<std::uint32_t> island_of_;  // of each pair; none: not small
  List<std::uint32_t> contacts_;
  List<std::size_t> bodies_, pairs_, first_;
};

}  // namespace moreau::detail
