// SPDX-License-Identifier: MIT
// What the solver asks of a contact law.
#pragma once

#include <array>
#include <concepts>

#include "moreau/contact/lane_problem.hpp"
#include "moreau/contact/local_problem.hpp"

namespace moreau {

/// A law between relative velocity u and impulse r of one contact in its own frame (normal first;
/// u_n > 0 separates, r_n > 0 pushes), given for one pair of materials.
///
/// - velocity_offset(gap, before, h): what is added to u_n so that the law reads 0 <= u_n + offset,
///   perpendicular to r_n >= 0. gap [m], before = u_n ahead of the step [m/s], h [s]. Infinite
///   where the contact cannot act in this step.
/// - solve(block, b, guess): the impulse [N s] that satisfies u = W r + b and the law; exact.
///   b [m/s] is the relative velocity at zero impulse with the offset; guess any impulse nearby.
/// - natural_map(u, r): r - P_K(r - u'), zero exactly on solutions; u and r in one unit.
template <class L, class S>
concept SetValuedLaw = std::copyable<L> &&
    requires(const L law, const LocalBlock<S> block, typename S::Vector vector,
             typename S::Scalar scalar) {
  { law.velocity_offset(scalar, scalar, scalar) } -> std::same_as<typename S::Scalar>;
  { law.solve(block, vector, vector) } -> std::same_as<typename S::Vector>;
  { law.natural_map(vector, vector) } -> std::same_as<typename S::Vector>;
};

/// A law that also solves one contact per lane.
///
/// - lane_parameters(): an array of all that the law differs in from others of its type
/// - solve_lanes(block, b, guess, parameters, memory, polish): in every lane solve(), or a step
///   towards it that stands still nowhere else. memory is the law's own: one number per contact, 0
///   at first, kept from visit to visit. Where polish is set the impulse lies in the cone to the
///   last digit; the next visit's starts from it.
template <class L, class S>
concept LaneLaw = SetValuedLaw<L, S> &&
    requires(const L law, const LaneBlock<S> block, const typename LaneBlock<S>::Vector vector,
             typename LaneBlock<S>::Values memory) {
  std::tuple_size<decltype(law.lane_parameters())>::value;
  {
    L::solve_lanes(block, vector, vector,
                   std::array<typename LaneBlock<S>::Values,
                              std::tuple_size_v<decltype(law.lane_parameters())>>{},
                   memory, true)
    } -> std::same_as<typename LaneBlock<S>::Vector>;
};

}  // namespace moreau
