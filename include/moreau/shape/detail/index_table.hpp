// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "moreau/core/list.hpp"

namespace moreau::detail {

/// A map from 64-bit keys to indices, hashed, with linear probing. A std::map or a std::unordered_map brings 100 to 200
/// functions to a unit.
class IndexTable {
 public:
  static constexpr std::uint32_t none = ~0U;  ///< index of a key that has none

  /// The index of a key, none at first. The reference is valid until the next call.
  std::uint32_t& operator[](std::uint64_t key) {
    if (2 * (count_ + 1) > entries_.size()) grow();
    Entry& entry = entries_[place_of(key)];
    if (!entry.is_used) {
      entry = {key, none, true};
      ++count_;
    }
    return entry.index;
  }
  std::uint32_t find(std::uint64_t key) const {
    return entries_.empty() ? none : entries_[place_of(key)].index;
  }
  /// The smallest key that has an index; the largest number if there is none.
  std::uint64_t smallest_key() const {
    std::uint64_t least = ~std::uint64_t(0);
    for (const Entry& entry : entries_)
      if (entry.index != none && entry.key < least) least = entry.key;
    return least;
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t index = none;
    bool is_used = false;
  };

  /// Where the key is, or will be: less than half of the entries are used.
  std::size_t place_of(std::uint64_t key) const {
    const std::size_t last = entries_.size() - 1;
    std::uint64_t hash = (key ^ key >> 32) * 0x9e3779b97f4a7c15U;
    std::size_t place = std::size_t(hash ^ hash >> 32) & last;
    while (entries_[place].is_used && entries_[place].key != key) place = (place + 1) & last;
    return place;
  }
  void grow() {
    List<Entry> old = std::move(entries_);
    entries_ = List<Entry>(old.empty() ? 16 : 2 * old.size());
    for (const Entry& entry : old)
      if (entry.is_used) entries_[place_of(entry.key)] = entry;
  }

  List<Entry> entries_;  // a power of two
  std::size_t count_ = 0;
};

}  // namespace moreau::detail
