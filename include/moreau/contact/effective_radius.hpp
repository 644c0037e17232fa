// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/contact/contact.hpp"

namespace moreau {

/// Effective radius R = 1 / (1/R_a + 1/R_b) of a contact [m]. R_a and R_b are the distances from the
/// centres of mass to the contact point, which lies in the middle of the gap, less half the gap: the radii of
/// spheres and disks, an estimate for other shapes. Walls, also cylinders, count as plane: 1/R = 0. Returns 0 if both
/// bodies are walls.
/// @param a_is_round false for a wall
/// @param b_is_round as a_is_round, of body b
template <class S>
typename S::Scalar effective_radius(const Contact<S>& contact, bool a_is_round, bool b_is_round) {
  using T = typename S::Scalar;
  const T curvature = (a_is_round ? 1 / (contact.lever_a.norm() - contact.gap / 2) : T(0)) +
                      (b_is_round ? 1 / (contact.lever_b.norm() - contact.gap / 2) : T(0));
  return curvature > 0 ? 1 / curvature : T(0);
}

}  // namespace moreau
