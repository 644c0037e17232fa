// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "moreau/contact/contact.hpp"
#include "moreau/motion/bodies.hpp"

namespace moreau::detail {

/// The rounding of the gap of a contact, which follows from those of the positions of its bodies [m]. The position of a wall
/// is that of any of its points, far away on a belt that has moved along itself: only its components along the normal
/// are part of the gap.
template <class S>
typename S::Scalar gap_rounding(const Bodies<S>& bodies, const Contact<S>& contact) {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector normal = contact.frame.col(0).cwiseAbs();
  const auto length = [&](std::uint32_t body, const Vector& lever) {
    const Vector sum = bodies.pose[body].position.cwiseAbs() + lever.cwiseAbs();
    return bodies.grain_mass[body] > 0 ? sum.sum() : normal.dot(sum);
  };
  return 2 * std::numeric_limits<Scalar>::epsilon() *
         (length(contact.a, contact.lever_a) + length(contact.b, contact.lever_b));
}

/// Whether an open gap is no larger than the rounding of the positions. In single precision a step would close it at a
/// velocity that is not small against those of bodies at rest, and the points of a face would not act alike.
template <class S>
bool is_gap_rounding([[maybe_unused]] const Bodies<S>& bodies,
                     [[maybe_unused]] const Contact<S>& contact,
                     [[maybe_unused]] typename S::Scalar gap) {
  if constexpr (std::is_same_v<typename S::Scalar, float>)
    return gap > 0 && gap <= gap_rounding<S>(bodies, contact);
  else
    return false;
}

}  // namespace moreau::detail
