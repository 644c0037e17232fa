// SPDX-License-Identifier: MIT
// The arcs on which the points of a bond move when its bodies turn (bond_list.hpp).
#pragma once

#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/bond.hpp"
#include "moreau/world/detail/chord_velocities.hpp"

namespace moreau::detail {

/// The chord of the arcs on which the points of a bond move over the step, b minus a [m/s].
/// @param before velocities before the step, one per body [m/s, rad/s]
template <class S>
typename S::Vector chord_of_bond(const Contact<S>& contact,
                                 std::span<const typename S::Twist> before,
                                 typename S::Scalar step) {
  return chord_excess<S>(angular<S>(before[contact.b]), contact.lever_b, step) -
         chord_excess<S>(angular<S>(before[contact.a]), contact.lever_a, step);
}
/// The stretch of a bond whose bodies have moved along tangents and turned for a while, of which its points at the
/// beginning had the same velocity [m].
template <class S>
typename S::Vector stretch_on_arcs(const Bond<S>& bond, const BondPlace<S>& at,
                                   const Bodies<S>& bodies, typename S::Scalar time) {
  using Vector = typename S::Vector;
  const auto excess = [&](BodyId body, const Vector& lever) {
    const typename S::Angular spin = angular<S>(bodies.velocity[body.index()]);
    const Vector back = time * (chord_excess<S>(spin, lever, -time) + S::spin(spin, lever));
    return Vector(time * chord_excess<S>(spin, Vector(lever - back), time));
  };
  if (!(time > 0)) return Vector::Zero();
  return excess(bond.b, at.middle_b + at.stretch / 2) -
         excess(bond.a, at.middle_a - at.stretch / 2);
}

}  // namespace moreau::detail
