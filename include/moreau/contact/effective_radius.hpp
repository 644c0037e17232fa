// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/contact/contact.hpp"

namespace moreau {

/// R = 1 / (1/R_a + 1/R_b) of a contact [m], with the distances of the point from the centres of
/// mass: exact for spheres and disks, a stand-in elsewhere. 0 between two flat bodies.
/// @param a_is_round false for a wall, which has no curvature
/// @param b_is_round the same of b
template <class S>
typename S::Scalar effective_radius(const Contact<S>& contact, bool a_is_round, bool b_is_round) {
  using T = typename S::Scalar;
  const T curvature = (a_is_round ? 1 / contact.lever_a.norm() : T(0)) +
                      (b_is_round ? 1 / contact.lever_b.norm() : T(0));
  return curvature > 0 ? 1 / curvature : T(0);
}

}  // namespace moreau
