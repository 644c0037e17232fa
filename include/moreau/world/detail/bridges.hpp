// SPDX-License-Identifier: MIT
// Bridges between bodies (law/bridges.hpp): which pairs have one. attraction_forces.hpp has their forces.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "moreau/contact/contact.hpp"
#include "moreau/core/list.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/detail/gap_rounding.hpp"

namespace moreau::detail {

/// Which pairs have a bridge.
template <class S, class Law>
class Bridges {
 public:
  using Scalar = typename S::Scalar;

  /// Forms and breaks bridges after detection, and erases the contacts of pairs without a bridge whose gap exceeds the
  /// margin. A bridge forms where a gap is closed to rounding, or the contact pushed in the step before.
  /// @param before contacts of the step before, with their impulses
  /// @param now    contacts of this step, with their laws; out: their variants say whether there is a bridge
  /// @returns how many pairs are left
  std::size_t update(const Materials<Law>& materials, const Bodies<S>& bodies,
                     const ContactsOf<Law, S>& before, ContactsOf<Law, S>& now, Scalar margin) {
    gone_.assign(now.size(), 0);
    std::size_t old = 0, pairs = 0;
    for (std::size_t first = 0, last; first < now.size(); first = last) {
      last = end_of_pair(now, first);
      bool bridged = had_bridge(before, old, now.keys[first]);
      Scalar least = now.points[first].gap;
      for (std::size_t c = first; c < last; ++c) {
        const Scalar gap = now.points[c].gap;
        least = std::min(least, gap);
        bridged = bridged || gap <= gap_rounding<S>(bodies, now.points[c]);
      }
      bridged = bridged && least <= materials.laws()[now.points[first].law].reach();
      for (std::size_t c = first; c < last; ++c) {
        now.variants[c] = static_cast<std::uint32_t>(Law::with_bridge(0, bridged));
        gone_[c] = !bridged && now.points[c].gap > margin;
      }
      pairs += bridged || least <= margin;
    }
    now.erase([&](std::size_t c) { return gone_[c] != 0; });
    return pairs;
  }

 private:
  /// Whether the pair had a bridge in the step before, or its bodies pushed each other.
  /// @param at in and out: index into `before`, of this pair or an earlier one
  static bool had_bridge(const ContactsOf<Law, S>& before, std::size_t& at, const ContactKey& key) {
    while (at < before.size() && before.keys[at].bodies() < key.bodies()) ++at;
    bool bridged = false;
    for (; at < before.size() && before.keys[at].bodies() == key.bodies(); ++at)
      bridged = bridged || Law::is_bridged(before.variants[at]) || before.impulses[at][0] > 0;
    return bridged;
  }

  List<unsigned char> gone_;  // one per contact
};

/// Which contacts have a bridge in this step, while their variants are carried over from the step before.
template <class S, class Law>
class BridgeBits {
 public:
  /// Remembers the bridges.
  void save(const ContactsOf<Law, S>& contacts) {
    bridged_.clear();
    for (const std::uint32_t variant : contacts.variants)
      bridged_.push_back(Law::is_bridged(variant));
  }
  /// Gives the variants the bridges of save().
  void restore(ContactsOf<Law, S>& contacts) const {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      std::uint32_t& variant = contacts.variants[c];
      variant = static_cast<std::uint32_t>(Law::with_bridge(variant, bridged_[c] != 0));
    }
  }

 private:
  List<unsigned char> bridged_;  // one per contact
};

/// In place of the bridges of a law that has none.
struct NoBridges {
  static void save(const auto&) {}
  static void restore(const auto&) {}
};

}  // namespace moreau::detail
