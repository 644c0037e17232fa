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
/// @param of_position,of_lever how often the rounding of the position of a body and of the lever of the contact counts
template <class S>
typename S::Scalar gap_rounding(const Bodies<S>& bodies, const Contact<S>& contact,
                                typename S::Scalar of_position = 2,
                                typename S::Scalar of_lever = 2) {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  const Vector normal = contact.frame.col(0).cwiseAbs();
  const auto length = [&](std::uint32_t body, const Vector& lever) -> Scalar {
    const bool is_grain = bodies.grain_mass[body] > 0;
    const Vector weight = is_grain ? Vector(Vector::Ones()) : normal;
    return of_position * weight.dot(bodies.pose[body].position.cwiseAbs()) +
           (is_grain ? of_lever : Scalar(2)) * weight.dot(lever.cwiseAbs());
  };
  return std::numeric_limits<Scalar>::epsilon() *
         (length(contact.a, contact.lever_a) + length(contact.b, contact.lever_b));
}

/// Whether an open gap of a rigid contact counts as closed, because rounding has left it. In single precision only.
///
/// A step that closes a gap g gives the bodies the velocity g/h. Where g >= a h^2, with the acceleration a of the load, that takes
/// more than the load: the contact bears nothing in this step, and a face stands on its other points. In single precision the rounding of
/// 1 m is that large in steps of 1e-4 s, in double precision in steps of 5e-9 s. The gaps that detection leaves are worse: no
/// motion of the bodies closes them at all points of a face. So gaps stay open that rounding can leave, and as
/// nothing closes them, those of several steps add up. With the unit roundoff u = epsilon / 2, to first order:
///
///   - Lever r, at most, in each of two detections, before and after a step: 12 u |r| for the matrix R of a quaternion whose norm
///     is 1 to rounding, 5 u |r| for the product R v, 4 u |r| for the sum with the distance of the centres and its projection onto the
///     normal. If the body has the face and not the vertex, its normal has the rounding of R v, and its plane goes on to
///     the contact point: 27 u |r| in place of 21 u |r|. In between, the body turns: 9 u in the quaternion are 18 u |r|. Together
///     60 to 72 u, here 32 epsilon. Bodies that keep their orientation to rounding keep R: this does not add up.
///   - Position x, once a step: up to u |x|. A body that slides slowly moves by the same h v in each step, which is rounded in the
///     same way: components along its path are rounded down and others up, so that it drifts across its path by up to u |x| in
///     each step, and neighbours drift by other lengths. After 1,000 steps that is 512 epsilon |x| of each body: a gap is
///     closed once in a thousand steps, not in each step.
///
/// @param most longer gaps do not stay open, unless one step leaves them, far from the origin [m]
template <class S>
bool is_gap_rounding([[maybe_unused]] const Bodies<S>& bodies,
                     [[maybe_unused]] const Contact<S>& contact,
                     [[maybe_unused]] typename S::Scalar gap,
                     [[maybe_unused]] typename S::Scalar most) {
  if constexpr (std::is_same_v<typename S::Scalar, float>) {
    constexpr float of_position = 512, of_lever = 32;
    if (!(gap > 0)) return false;
    return gap <= most ? gap <= gap_rounding<S>(bodies, contact, of_position, of_lever)
                       : gap <= gap_rounding<S>(bodies, contact);
  } else {
    return false;
  }
}

}  // namespace moreau::detail
