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
/// - lane_parameters(): all that the law differs in from others of its type
/// - solve_lanes(block, b, guess, parameters): in every lane solve(), or a step towards it from the
///   guess that stands still nowhere else
template <class L, class S>
concept LaneLaw = SetValuedLaw<L, S> &&
    requires(const L law, const LaneBlock<S> block, const typename LaneBlock<S>::Vector vector) {
  { law.lane_parameters() } -> std::same_as<std::array<typename S::Scalar, 1>>;
  {
    L::solve_lanes(block, vector, vector, {block.normal})
    } -> std::same_as<typename LaneBlock<S>::Vector>;
};

}  // namespace moreau
