// SPDX-License-Identifier: MIT
// The attraction of contacts by their laws, without bonds: its force and its reach.
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

namespace moreau::detail {

/// The largest gap at which a law of the materials attracts also beyond the margin [m]; 0 if all attractions end at the margin.
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
