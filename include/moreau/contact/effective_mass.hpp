// SPDX-License-Identifier: MIT
// The mass that one point of a contact between two bodies bears.
//
// The points of a pair are springs side by side: n points of a face have the stiffness n k together.
// Their dashpots c = 2 beta sqrt(k m) have the damping ratio beta together if m is the mass that one
// point bears, m = M / n with the effective mass M of the face. In general let W be the matrix of the normals of
// the points (the Delassus operator) and d their overlaps, in proportion to which springs push. The
// motion along which they push is an oscillation of one degree of freedom with the inverse mass
//
//     1 / m = d^T W d / d^T d
//
// per point:
//
//     one point (vertex)                       1 / W_nn
//     edge that lands flat, 2 points           half of the effective mass of its middle
//     face that lands flat, n points           M / n, M the mass of the pair, if its centre lies on
//                                              the line of the centres of mass
//     points with normals across each other    each its own mass
//
// A point that opens or closes has d = 0, so that m does not jump. Points that press against each other
// (d^T W d = 0) would bear any mass: m is at most the mass of the pair along the normal, without rotation.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"

namespace moreau::detail {

/// f . M^-1 f of body i for a force and a torque f, world axes.
/// @param load (force, torque about the centre of mass)
template <class S>
typename S::Scalar inverse_mass_along(const Bodies<S>& bodies, std::uint32_t i,
                                      const typename S::Twist& load) {
  const typename S::Vector force = bodies.axes(i).transpose() * linear<S>(load);
  const typename S::Scalar moved = force.cwiseAbs2().dot(bodies.inverse_mass[i]);
  if (!bodies.rotates(i)) return moved;
  const typename S::Angular torque =
      S::adjoint(bodies.pose[i].rotation).transpose() * angular<S>(load);
  return moved + (bodies.inverse_inertia_root_body[i] * torque).squaredNorm();
}

/// The effective mass of each point of a pair [kg]; the head of this file has its definition. If no
/// point overlaps, all count alike. 0 if neither body can move.
/// @param points all of one pair
/// @param masses out: one per point
template <class S>
void find_effective_masses(const Bodies<S>& bodies, std::span<const Contact<S>> points,
                           std::span<typename S::Scalar> masses) {
  using Scalar = typename S::Scalar;
  using Twist = typename S::Twist;
  Scalar deepest = 0, squares = 0;
  for (const Contact<S>& point : points) deepest = std::max(deepest, -point.gap);
  Twist on_a = Twist::Zero(), on_b = Twist::Zero();
  for (const Contact<S>& point : points) {
    const Scalar weight = deepest > 0 ? std::max(Scalar(0), -point.gap) / deepest : Scalar(1);
    const typename S::Vector push = weight * point.frame.col(0);
    linear<S>(on_a) += push;
    angular<S>(on_a) += S::moment(point.lever_a, push);
    linear<S>(on_b) += push;
    angular<S>(on_b) += S::moment(point.lever_b, push);
    squares += weight * weight;
  }
  const std::uint32_t a = points[0].a, b = points[0].b;
  const Scalar shared =
      (inverse_mass_along(bodies, a, on_a) + inverse_mass_along(bodies, b, on_b)) / squares;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Twist push = Twist::Zero();
    linear<S>(push) = points[k].frame.col(0);
    const Scalar inverse =
        std::max(shared, inverse_mass_along(bodies, a, push) + inverse_mass_along(bodies, b, push));
    masses[k] = inverse > 0 ? 1 / inverse : Scalar(0);
  }
}

}  // namespace moreau::detail
