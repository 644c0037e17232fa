// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "moreau/contact/contact.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau {

/// Gives every contact the law of the materials of its two bodies: fills Contact::law, an index
/// into materials.laws().
/// @param bodies all bodies of the contacts, with materials that exist; not checked
/// @param team   threads that share the work
template <class S, class Law>
void assign_laws(const Bodies<S>& bodies, const Materials<Law>& materials,
                 DetectedContacts<S>& contacts, const Team& team = {}) {
  team.share_each(contacts.size(), 512, [&](std::size_t c) {
    Contact<S>& contact = contacts.points[c];
    contact.law = static_cast<std::uint32_t>(
        materials.law_index(bodies.material[contact.a], bodies.material[contact.b]));
  });
}

}  // namespace moreau
