// SPDX-License-Identifier: MIT
// What a contact law must offer, and what it may offer: the required functions are those of SetValuedLaw, or of
// RegularizedLaw (regularized.hpp). Each optional function belongs to one of the concepts below:
//
// | function or member | concept | without it |
// |---|---|---|
// | rolls | Rolls | the impulse has no couple |
// | ActsWhereGapsClose | ActsWhereGapsClose | all pairs within the margin have contacts |
// | is_coulomb | CoulombLaw, RollingCoulombLaw | no direct method for islands, no ProximalFallback, no gather_problem |
// | friction() | FrictionLaw | no CoulombLaw; check() does not judge the friction |
// | rolling() | RollingCoulombLaw | the same of laws with couples |
// | restitution() | RestitutionLaw | Compliant<Law> takes e = 0 |
// | variants, variant(k), variant_after(k, impulse) | StatefulLaw | one variant |
// | has_static_friction(), variant_at_rest(k) | StaticFrictionLaw | variant_after() alone decides |
// | attraction(gap) | AttractiveLaw | no attraction |
// | range() | AttractsInRange | attraction() is not asked beyond Tolerances::margin: pairs have no contacts there |
// | reach(), is_bridged(k), with_bridge(k, bridged), bridge_force(gap, radius) | BridgingLaw | no bridges |
// | is_bonded(k), strength(), yields(p), yielding(p, w), softening(w) | BondingLaw | no bonds |
// | normal_compliance(), tangential_compliance(), keeps_normal_impulse() | CompliantLaw | rigid contacts |
// | tangential_share(gap, before) | TangentialRestitutionLaw | no restitution across the normal |
// | lane_parameters(), solve_lanes(..) | LaneLaw | solve() lane after lane |
// | natural_map_lanes(..) | MapsLanes | natural_map() contact by contact |
//
// A team calls the functions of a law from several threads at once: they must be const or static. A Simulation does not
// compile with a law that has one of these functions with another signature (world/detail/policies.hpp).
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "moreau/law/lane_block.hpp"
#include "moreau/law/local_block.hpp"
#include "moreau/law/rolling_block.hpp"

namespace moreau {

/// A law with couples: it has `static constexpr bool rolls = true`.
template <class L>
concept Rolls = requires {
  requires L::rolls;
};

/// W of one contact as a law sees it, in the contact's frame [1/kg].
template <class L, class S>
using BlockOf = std::conditional_t<Rolls<L>, RollingBlock<S>, LocalBlock<S>>;

/// A law between the relative velocity u and the impulse r of one contact, for one pair of
/// materials. u and r are rows of the operator: along the normal, then along the tangents that its block chooses
/// (BodyDelassus::frame()); u_n > 0 separates, r_n > 0 pushes.
///
/// - velocity_offset(gap, before, h): the offset [m/s] in 0 <= u_n + offset _|_ r_n >= 0. gap [m] after the overlap
///   correction, before = u_n before the step [m/s], h the step [s]. Infinite if the contact cannot act in this
///   step. In single precision the gap is 0 where it is smaller than the rounding of the positions; it is 0 where a contact with
///   restitution closes together with others (world/detail/closing_contacts.hpp). The chords of curved paths are subtracted from before. The
///   function is called again with before = 0, for the offset without restitution.
/// - solve(block, b, guess): the exact impulse [N s] with u = W r + b and the law. b [m/s] is the
///   relative velocity without impulse, with the offset; guess is an impulse to start from.
/// - natural_map(u, r): r - P_K(r - u'), zero if and only if (u, r) satisfies the law; u and r in
///   one unit. With u = 0 it is the distance of r from the impulses that the law allows. A law with
///   constants that have a unit, such as a bound of r [N s], has natural_map(u, r, scale = 1): r is
///   the impulse times scale [1/kg]; multiply the constants by scale, too.
///
/// A law with `static constexpr bool rolls = true` has a couple beside the force: block, u, r and b
/// are those of a RollingBlock, with D + A rows, rolling and twisting last.
///
/// Optional functions: the table in the head of this file.
template <class L, class S>
concept SetValuedLaw = std::copyable<L> &&
    requires(const L law, const BlockOf<L, S> block, typename BlockOf<L, S>::Vector vector,
             typename S::Scalar scalar) {
  { law.velocity_offset(scalar, scalar, scalar) } -> std::same_as<typename S::Scalar>;
  { law.solve(block, vector, vector) } -> std::same_as<typename BlockOf<L, S>::Vector>;
  { law.natural_map(vector, vector) } -> std::same_as<typename BlockOf<L, S>::Vector>;
};

namespace detail {

/// The natural map of u [m/s] and r = impulse times scale [m/s]; scale [1/kg].
template <class L, class Vector>
Vector natural_map(const L& law, const Vector& u, const Vector& r, typename Vector::Scalar scale) {
  if constexpr (requires { law.natural_map(u, r, scale); })
    return law.natural_map(u, r, scale);
  else
    return law.natural_map(u, r);
}

}  // namespace detail

namespace detail {

/// The class that has a member function.
template <class C, class R>
C class_of(R (C::*)() const);
template <class T>
void accept(T);
/// Whether solve() of a law is that of the class C, as a rule one from which the law derives. A law that derives from
/// another one and has a solve() of its own does not inherit other solutions of the local problem.
template <class L, class S, class C>
concept SolvesAs = requires {
  detail::accept<typename BlockOf<L, S>::Vector (C::*)(
      const BlockOf<L, S>&, const typename BlockOf<L, S>::Vector&,
      const typename BlockOf<L, S>::Vector&) const>(&L::solve);
};

}  // namespace detail

/// A set-valued law without couples: D rows per contact.
template <class L, class S>
concept PointLaw = SetValuedLaw<L, S> && !Rolls<L>;
/// A set-valued law with couples: D + A rows per contact.
template <class L, class S>
concept RollingLaw = SetValuedLaw<L, S> && Rolls<L>;

/// A law with a coefficient of friction. check() warns about a coefficient from 5 to 90, which looks like an angle in degrees.
///
/// - friction(): mu [-]
template <class L>
concept FrictionLaw = requires(const L law) {
  { law.friction() } -> std::convertible_to<double>;
};

/// A law with a coefficient of restitution. Compliant<Law> asks for it: the springs of a law with e > 0 keep their normal
/// impulse from step to step.
///
/// - restitution(): e [-]
template <class L>
concept RestitutionLaw = requires(const L law) {
  { law.restitution() } -> std::convertible_to<double>;
};

/// A law whose local problem is Coulomb's law with the coefficient friction(), so that matrices and
/// coefficients of friction define the contact problem, and other methods than its solve() may solve it. It says so by
/// `static constexpr bool is_coulomb = true`. A law that derives from one is one unless it has a solve()
/// of its own.
template <class L, class S>
concept CoulombLaw = PointLaw<L, S> && FrictionLaw<L> && requires {
  requires L::is_coulomb;
  requires detail::SolvesAs<L, S, decltype(detail::class_of(&L::friction))>;
};

/// A law with couples whose local problem is that of the cone |r_t| <= friction() r_n, |m| <= rolling() r_n, with slip
/// against r_t and rotation against m as in rolling_resistance.hpp, so that other methods than its solve() may solve it. It
/// says so by `static constexpr bool is_coulomb = true`. A law that derives from one is one unless it has a solve() of its own.
template <class L, class S>
concept RollingCoulombLaw = RollingLaw<L, S> && FrictionLaw<L> && requires(const L law) {
  { law.rolling() } -> std::convertible_to<double>;
  requires L::is_coulomb;
  requires detail::SolvesAs<L, S, decltype(detail::class_of(&L::rolling))>;
};

/// A law under which a contact with a gap g > 0 acts only if g + h u_n < 0, u_n being its velocity at the end of the step
/// without it. It says so by a member type ActsWhereGapsClose that is the law itself: a law that derives from it does not
/// inherit this. A pair then needs contacts only up to the gap that it can close (world/detail/step_margins.hpp).
template <class L>
concept ActsWhereGapsClose = std::same_as<typename L::ActsWhereGapsClose, L>;

namespace detail {
/// A law for impulses, in this scalar.
template <class L, class T>
concept GivesImpulses = requires(const L law, T x) {
  { law.velocity_offset(x, x, x) } -> std::same_as<T>;
};
/// The scalar of a law for impulses; double of another law.
template <class L>
struct ImpulseScalar {
  using type = double;
};
template <class L>
requires requires(const L law) {
  law.velocity_offset(0., 0., 0.);
}
struct ImpulseScalar<L> {
  using type = decltype(std::declval<const L&>().velocity_offset(0., 0., 0.));
};
/// A law with springs in series, in any scalar. Here and below, functions that are not const by mistake count, too.
template <class L>
concept HasSprings = requires(L& law) {
  law.normal_compliance();
};
/// A law with bridges or bonds, or with an attraction at every contact.
template <class L>
concept Attracts = requires(L& law) {
  law.is_bridged(std::size_t{});
}
|| requires(L& law) {
  law.is_bonded(std::size_t{});
}
|| requires(L& law) {
  law.attraction(0.f);
};
}  // namespace detail

/// A law that depends on what the contact did in the step before, such as static friction.
///
/// - variants: number of its variants
/// - variant(k), k < variants: the law whose solve(), natural_map(), friction() and lanes a contact with this k uses in the step. Its
///   velocity_offset(), attraction, compliances and tangential_share() are not used: they are those of the law in
///   Materials, the same for all variants. A new contact has k = 0.
/// - variant_after(k, impulse): the k of the next step, from the k of this step and the impulse that
///   solves variant(k) [N s]. These are the first D rows of the impulse of solve(): the couple of a law with couples is not passed
template <class L, class S>
concept StatefulLaw = SetValuedLaw<L, S> &&
    requires(const L law, typename S::Vector impulse, std::size_t k) {
  { law.variant_after(k, impulse) } -> std::same_as<std::size_t>;
  { law.variant(k) } -> std::same_as<L>;
  L::variants;
};

/// A law whose bodies attract each other through a bridge that forms when they touch and breaks at a gap; see
/// bridges.hpp. Its memory is the variant: it is a StatefulLaw with the functions
///
/// - reach(): the largest gap with a bridge [m]
/// - is_bridged(k): whether variant k has a bridge; with_bridge(k, bridged): variant k with or without it
/// - bridge_force(gap, radius): the attraction of the pair >= 0 [N]; radius = 2 / (1/R_a + 1/R_b), the radii without half of the gap [m]
template <class L, class S>
concept BridgingLaw = StatefulLaw<L, S> &&
    requires(const L law, typename S::Scalar length, std::size_t k) {
  { law.reach() } -> std::same_as<typename S::Scalar>;
  { law.bridge_force(length, length) } -> std::same_as<typename S::Scalar>;
  { L::is_bridged(k) } -> std::same_as<bool>;
  { L::with_bridge(k, true) } -> std::same_as<std::size_t>;
};

/// A law with bonds; see bonded.hpp. It has couples, and the variants without and with a bond: it is a StatefulLaw with
///
/// - is_bonded(k): whether variant k has a bond
/// - strength(): of a bond; its tension T is an attraction, so that the local problem is that of p = r + h T n
/// - yields(p): whether the impulse of a bond lies at the limit of the law [N s]
/// - yielding(p, w): the part of a velocity in which a bond with this impulse yields [m/s]
/// - softening(w): share of its strength that a bond loses per unit of time that yields with the velocity w [1/s]
template <class L, class S>
concept BondingLaw = StatefulLaw<L, S> && Rolls<L> &&
    requires(const L law, typename BlockOf<L, S>::Vector p, std::size_t k) {
  { L::is_bonded(k) } -> std::same_as<bool>;
  { law.yields(p) } -> std::same_as<bool>;
  { law.yielding(p, p) } -> std::same_as<typename BlockOf<L, S>::Vector>;
  { law.softening(p) } -> std::same_as<typename S::Scalar>;
  law.strength().tension;
};

/// A law whose bodies attract each other: with the force attraction(gap) [N] at each contact, through a bridge, or
/// through a bond. Its local problem is that of the push against the attraction, see cohesive.hpp. attraction() is called for gaps up
/// to the margin (Tolerances::margin), and for gaps up to range() if the law is AttractsInRange with a finite range. Beyond, the bodies do not
/// attract each other, whatever attraction() would return; check() warns if that is not 0.
template <class L, class S>
concept AttractiveLaw = BridgingLaw<L, S> || BondingLaw<L, S> ||
    (SetValuedLaw<L, S>&& requires(const L law, typename S::Scalar gap) {
      { law.attraction(gap) } -> std::same_as<typename S::Scalar>;
    });

/// An attraction that ends at a gap of its own, also beyond the margin: contacts are detected up to this gap.
///
/// - range(): the largest gap with an attraction [m]; infinite: the attraction ends at the margin
template <class L, class S>
concept AttractsInRange = AttractiveLaw<L, S> && requires(const L law) {
  { law.range() } -> std::same_as<typename S::Scalar>;
};

/// A law with springs in series, see compliant.hpp.
///
/// - normal_compliance(), tangential_compliance(): of a pair [m/N]
/// - keeps_normal_impulse(): whether the memory of the normal spring is the impulse of the step
///   before; otherwise it is the gap
template <class L, class S>
concept CompliantLaw = SetValuedLaw<L, S> && requires(const L law) {
  { law.normal_compliance() } -> std::same_as<typename S::Scalar>;
  { law.tangential_compliance() } -> std::same_as<typename S::Scalar>;
  { law.keeps_normal_impulse() } -> std::same_as<bool>;
};

/// A law with a restitution across the normal, see tangential_restitution.hpp.
///
/// - tangential_share(gap, before): the share of u_t before the step that is added to u_t [-], 0 where the contact is
///   no impact. gap [m]; before = u_n before the step [m/s]
template <class L, class S>
concept TangentialRestitutionLaw = PointLaw<L, S> &&
    requires(const L law, typename S::Scalar scalar) {
  { law.tangential_share(scalar, scalar) } -> std::same_as<typename S::Scalar>;
};

/// A stateful law whose friction is larger at a contact that does not slide. An impulse on the cone is no proof of slip: after
/// variant_after() the simulation gives contacts that do not slide the variant at rest; world/detail/sliding_points.hpp has the
/// conditions.
///
/// - has_static_friction(): whether the variants of contacts that slide and that do not slide differ; if not, the simulation
///   does not test which contacts slide
/// - variant_at_rest(k), k < variants: k if the contact does not slide in variant k, otherwise the variant of the same
///   contact that does not
template <class L, class S>
concept StaticFrictionLaw = StatefulLaw<L, S> && requires(const L law, std::size_t k) {
  { law.has_static_friction() } -> std::same_as<bool>;
  { law.variant_at_rest(k) } -> std::same_as<std::size_t>;
};

/// The number of variants of a law: 1 of a law that is not stateful.
template <class L, class S>
constexpr std::size_t variants_of() {
  if constexpr (StatefulLaw<L, S>)
    return L::variants;
  else
    return 1;
}

/// W of one contact per SIMD lane as a law sees it. Where the contact has couples it stands for W, see
/// rolling_block.hpp.
template <class L, class S>
using LaneBlockOf = std::conditional_t<Rolls<L>, RoundBlock<S>, LaneBlock<S>>;

/// A law that also solves the local problems of several contacts at once, one per SIMD lane. A law that derives from one is
/// one unless it has a solve() of its own.
///
/// - lane_parameters(): an array of the parameters of the local problem, in units of the law
/// - solve_lanes(block, b, guess, parameters, memory, polish): in every lane solve(), or one step
///   of an iteration whose only fixed point is solve(). block is a LaneBlockOf<Law, S>; its numbers, and those of b, guess
///   and the parameters, are vector types of the compiler (LaneBlock<S>::Values) with the operators + - * / < > ?:, one contact per
///   lane. memory is for the law's own use: one number per
///   contact, two if the contact has couples. It is 0 when a solve begins (a solve may be attempted twice), stays from visit to
///   visit, and is not kept after the solve. If polish is set, the impulse lies in the cone to rounding.
///
///   b_n of a contact that cannot act is infinite: its impulse must be 0. A lane without a contact has W = 1, b_n = 1, zero
///   tangential components and parameters 0: its impulse must be 0, too. No lane may become NaN.
template <class L, class S>
concept LaneLaw = SetValuedLaw<L, S> && requires(const L law, const LaneBlockOf<L, S> block,
                                                 const typename LaneBlockOf<L, S>::Vector vector,
                                                 typename LaneBlockOf<L, S>::Memory memory) {
  std::tuple_size<decltype(law.lane_parameters())>::value;
  requires detail::SolvesAs<L, S, decltype(detail::class_of(&L::lane_parameters))>;
  {
    L::solve_lanes(block, vector, vector,
                   std::array<typename LaneBlock<S>::Values,
                              std::tuple_size_v<decltype(law.lane_parameters())>>{},
                   memory, true)
    } -> std::same_as<typename LaneBlockOf<L, S>::Vector>;
};

/// A LaneLaw that is Coulomb's, with natural_map() of one contact per lane:
///
/// - natural_map_lanes<S>(u, r, parameters): in every lane natural_map(u, r). Without this function the residual is computed contact
///   by contact
template <class L, class S>
concept MapsLanes = LaneLaw<L, S> && CoulombLaw<L, S> &&
    requires(const L law, const typename LaneBlock<S>::Vector vector) {
  {
    L::template natural_map_lanes<S>(
        vector, vector,
        std::array<typename LaneBlock<S>::Values,
                   std::tuple_size_v<decltype(law.lane_parameters())>>{})
    } -> std::same_as<typename LaneBlock<S>::Vector>;
};

}  // namespace moreau
