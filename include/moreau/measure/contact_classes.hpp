// SPDX-License-Identifier: MIT
// Shares of the classes of contacts: corners, edges, faces.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "moreau/measure/pair_forces.hpp"

namespace moreau {

/// Share of one class of contacts.
struct ContactClassShare {
  std::size_t pairs = 0;   ///< of bodies that carry force
  std::size_t points = 0;  ///< their points that carry force
  double neighbours = 0;   ///< per grain: a pair of grains adds two, a grain and a wall one [-]
  double force = 0;        ///< part of the sum of all normal forces, in [0, 1] [-]
};

/// The share of every ContactClass.
struct ContactClasses {
  /// In the order of ContactClass.
  std::array<ContactClassShare, static_cast<std::size_t>(ContactClass::face_face) + 1> shares;

  /// Of one class.
  const ContactClassShare& operator[](ContactClass c) const {
    return shares[static_cast<std::size_t>(c)];
  }
};

/// The coordination by class of contact. The sum over all classes is the coordination number that
/// CoordinationCounter returns for all grains.
/// @param pairs       of pair_forces()
/// @param grain_count number of grains; without any, neighbours are 0
/// @param is_grain    body -> false for a wall; bodies by BodyId::index()
template <class S>
ContactClasses contact_classes(std::span<const PairForce<S>> pairs, std::size_t grain_count,
                               const auto& is_grain) {
  ContactClasses result;
  double sum = 0;
  for (const PairForce<S>& pair : pairs) {
    ContactClassShare& share = result.shares[static_cast<std::size_t>(pair.contact_class)];
    ++share.pairs;
    share.points += pair.points;
    share.neighbours += (is_grain(pair.a) ? 1 : 0) + (is_grain(pair.b) ? 1 : 0);
    share.force += double(pair.normal_force);
    sum += double(pair.normal_force);
  }
  for (ContactClassShare& share : result.shares) {
    share.neighbours = grain_count > 0 ? share.neighbours / double(grain_count) : 0;
    share.force = sum > 0 ? share.force / sum : 0;
  }
  return result;
}

}  // namespace moreau
