// SPDX-License-Identifier: MIT
// The relative velocity of a contact point is the velocity of the point on body b less that of the point on body a,
//
//     v_b + w_b x l_b - v_a - w_a x l_a,
//
// with the levers l from the centres of the bodies to the point. The stages of a step compute it here, with these exceptions:
//
// - the direct method for islands has rows of J (solve/detail/jacobian_rows.hpp)
// - the overlap correction computes changes of gaps by displacements from rows of its own (world/detail/overlap_sweeps.hpp)
// - the choice of margins bounds it at the centre of a body (relative_speed() in world/detail/step_margins.hpp)
// - a periodic cell that deforms adds a term (world/detail/cell/cell_jumps.hpp)
//
// The operator of a contact problem adds the relative spin of contacts with couples, and turns both into its rows
// (BodyDelassus::row()).
#pragma once

#include <cstddef>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiler.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"

namespace moreau {

namespace detail {

/// The relative velocity of a point of two bodies, world axes [m/s].
/// @param a,b             (v, w) of the bodies [m/s, rad/s], or longer vectors that begin with it
/// @param lever_a,lever_b from the centres to the point, world axes [m]
template <class S>
MOREAU_INLINED inline typename S::Vector relative_velocity_at(const auto& a,
                                                              const typename S::Vector& lever_a,
                                                              const auto& b,
                                                              const typename S::Vector& lever_b) {
  typename S::Vector difference = velocity_at<S>(b, lever_b);
  difference -= velocity_at<S>(a, lever_a);
  return difference;
}
/// The same of points and bodies in the lanes of SIMD registers.
/// @tparam Algebra LaneAlgebra
template <class Algebra>
MOREAU_INLINED inline typename Algebra::Vector relative_velocity_of_lanes(
    const auto& a, const typename Algebra::Vector& lever_a, const auto& b,
    const typename Algebra::Vector& lever_b) {
  const typename Algebra::Vector of_a = Algebra::point_velocity(a, lever_a);
  const typename Algebra::Vector of_b = Algebra::point_velocity(b, lever_b);
  typename Algebra::Vector difference;
  for (std::size_t k = 0; k < Algebra::dim; ++k) difference[k] = of_b[k] - of_a[k];
  return difference;
}

}  // namespace detail

/// The relative velocity u of a contact in its frame, normal first [m/s]; u_n > 0 separates.
/// @param a,b velocities (v, w) of its bodies, world axes [m/s, rad/s]
template <class S>
MOREAU_INLINED inline typename S::Vector relative_velocity(const Contact<S>& contact,
                                                           const typename S::Twist& a,
                                                           const typename S::Twist& b) {
  return detail::inlined_transposed_product(
      contact.frame, detail::relative_velocity_at<S>(a, contact.lever_a, b, contact.lever_b));
}

}  // namespace moreau
