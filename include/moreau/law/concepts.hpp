// SPDX-License-Identifier: MIT
// What the solver asks of a contact law.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "moreau/contact/lane_block.hpp"
#include "moreau/contact/local_block.hpp"
#include "moreau/contact/rolling_block.hpp"

namespace moreau {

/// A law that says of itself that it carries couples: `static constexpr bool rolls = true`.
template <class L>
concept Rolls = requires {
  requires L::rolls;
};

/// W of one contact as a law sees it, in the contact's frame [1/kg].
template <class L, class S>
using BlockOf = std::conditional_t<Rolls<L>, RollingBlock<S>, LocalBlock<S>>;

/// A law between relative velocity u and impulse r of one contact in its own frame (normal first;
/// u_n > 0 separates, r_n > 0 pushes), given for one pair of materials.
///
/// - velocity_offset(gap, before, h): what is added to u_n so that the law reads 0 <= u_n + offset,
///   perpendicular to r_n >= 0. gap [m], before = u_n ahead of the step [m/s], h [s]. Infinite
///   where the contact cannot act in this step.
/// - solve(block, b, guess): the impulse [N s] that satisfies u = W r + b and the law; exact.
///   b [m/s] is the relative velocity at zero impulse with the offset; guess any impulse nearby.
/// - natural_map(u, r): r - P_K(r - u'), zero exactly on solutions; u and r in one unit. With u = 0
///   it is what of r the law forbids. A law with constants of a unit, such as a bound of r [N s],
///   has natural_map(u, r, scale = 1): r is the impulse times scale [1/kg], and so must its
///   constants be.
///
/// A law with `static constexpr bool rolls = true` carries a couple beside the force: block, u, r
/// and b are those of a RollingBlock, with D + A rows, rolling and twisting last.
///
/// Optional: see AttractiveLaw, StatefulLaw, LaneLaw.
template <class L, class S>
concept SetValuedLaw = std::copyable<L> &&
    requires(const L law, const BlockOf<L, S> block, typename BlockOf<L, S>::Vector vector,
             typename S::Scalar scalar) {
  { law.velocity_offset(scalar, scalar, scalar) } -> std::same_as<typename S::Scalar>;
  { law.solve(block, vector, vector) } -> std::same_as<typename BlockOf<L, S>::Vector>;
  { law.natural_map(vector, vector) } -> std::same_as<typename BlockOf<L, S>::Vector>;
};

namespace detail {

/// The natural map of u [m/s] and r, the impulse times scale [1/kg].
template <class L, class Vector>
Vector natural_map(const L& law, const Vector& u, const Vector& r, typename Vector::Scalar scale) {
  if constexpr (requires { law.natural_map(u, r, scale); })
    return law.natural_map(u, r, scale);
  else
    return law.natural_map(u, r);
}

}  // namespace detail

/// A set-valued law of forces alone: D rows per contact.
template <class L, class S>
concept PointLaw = SetValuedLaw<L, S> && !Rolls<L>;
/// A set-valued law of forces and couples: D + A rows per contact.
template <class L, class S>
concept RollingLaw = SetValuedLaw<L, S> && Rolls<L>;

/// A law whose bodies attract each other with attraction(gap) [N]; what it solves for is the push
/// against that. See cohesive.hpp.
template <class L, class S>
concept AttractiveLaw = SetValuedLaw<L, S> && requires(const L law, typename S::Scalar gap) {
  { law.attraction(gap) } -> std::same_as<typename S::Scalar>;
};

/// A law that is another one after slip than after rest.
///
/// - variants: how many laws it can be in a step, at most; variant(k), k < variants: each of them
/// - variant_after(impulse): the k of this step, from the impulse of the last [N s], in the frame
template <class L, class S>
concept StatefulLaw = SetValuedLaw<L, S> &&
    requires(const L law, typename S::Vector impulse, std::size_t k) {
  { law.variant_after(impulse) } -> std::same_as<std::size_t>;
  { law.variant(k) } -> std::same_as<L>;
  L::variants;
};

/// A law that also solves one contact per lane.
///
/// - lane_parameters(): an array of all that the law differs in from others of its type, in the
///   law's own units
/// - solve_lanes(block, b, guess, parameters, memory, polish): in every lane solve(), or a step
///   towards it that stands still nowhere else. memory is the law's own: one number per contact, 0
///   at first, kept from visit to visit. Where polish is set the impulse lies in the cone to the
///   last digit; the next visit's starts from it.
template <class L, class S>
concept LaneLaw = PointLaw<L, S> &&
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
