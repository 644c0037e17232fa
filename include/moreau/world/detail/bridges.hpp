// SPDX-License-Identifier: MIT
// Bridges between bodies (law/bridges.hpp) and the attraction of contacts.
#pragma once

#include <algorithm>
#include <cmath>
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

/// The largest gap at which a law attracts, also beyond the margin [m]; 0 of a law whose attraction ends at the margin.
template <class S, class Law>
typename S::Scalar reach_of(const Materials<Law>& materials) {
  typename S::Scalar reach = 0;
  for (const Law& law : materials.laws())
    if constexpr (BridgingLaw<Law, S>)
      reach = std::max(reach, law.reach());
    else if constexpr (AttractsInRange<Law, S>)
      if (std::isfinite(law.range())) reach = std::max(reach, law.range());
  return reach;
}

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

/// The forces with which the bodies of contacts attract each other, >= 0 [N]. The points of a bridge within its reach share
/// its force. Other laws without a finite range attract up to the margin, however far those of other pairs reach.
/// @param margin of the tolerances [m]
/// @param forces out: one per contact
template <class S, class Law>
void attractions(const Bodies<S>& bodies, const Materials<Law>& materials,
                 const ContactsOf<Law, S>& contacts, typename S::Scalar margin,
                 List<typename S::Scalar>& forces) {
  using Scalar = typename S::Scalar;
  forces.assign(contacts.size(), 0);
  if constexpr (BridgingLaw<Law, S>) {
    for (std::size_t first = 0, last; first < contacts.size(); first = last) {
      last = end_of_pair(contacts, first);
      const Law& law = materials.laws()[contacts.points[first].law];
      const auto attracts = [&](std::size_t c) {
        return Law::is_bridged(contacts.variants[c]) && contacts.points[c].gap <= law.reach();
      };
      std::size_t count = 0;
      for (std::size_t c = first; c < last; ++c)
        if (attracts(c)) ++count;
      for (std::size_t c = first; c < last; ++c) {
        if (!attracts(c)) continue;
        const Contact<S>& contact = contacts.points[c];
        const auto radius_at = [&](std::uint32_t body, const typename S::Vector& lever) {
          return bodies.grain_mass[body] > 0
                     ? 1 / std::max(lever.norm() - contact.gap / 2, Scalar(0))
                     : Scalar(0);
        };
        const auto curvature =
            radius_at(contact.a, contact.lever_a) + radius_at(contact.b, contact.lever_b);
        forces[c] = law.bridge_force(contact.gap, 2 / curvature) / Scalar(count);
      }
    }
  } else {
    const Scalar most = margin * Scalar(1.00001);  // detection rounds
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Law& law = materials.laws()[contacts.points[c].law];
      const Scalar gap = contacts.points[c].gap;
      bool is_near = gap <= most;
      if constexpr (AttractsInRange<Law, S>) is_near = is_near || std::isfinite(law.range());
      if (is_near) forces[c] = law.attraction(gap);
    }
  }
}

}  // namespace moreau::detail
