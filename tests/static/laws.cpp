// SPDX-License-Identifier: MIT
// Every pair of a wrapper and a law for impulses that has a meaning, in every space. The others are refused with one
// message each, which rejected.cpp tests:
//
// | | Cohesive<..> | Bridged<.., ..> | Compliant<..> |
// |---|---|---|---|
// | SignoriniCoulomb, Frictionless, RollingResistance | yes | yes | yes |
// | TangentialRestitution | yes | yes | no: two tangential restitutions |
// | Bonded | no: two attractions | no: two attractions | yes |
// | Cohesive | no: two attractions | no: two attractions | yes |
// | Bridged | no: two attractions | no: two attractions | yes |
// | Compliant | no: springs go outside | no: springs go outside | no: springs twice |
// | LinearSpringDashpot, HertzMindlin | no: gives no impulses | no: gives no impulses | no: gives no impulses |
//
// Bonded has a scalar and no law as its parameter.
#include "moreau/core/space.hpp"
#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/cohesive.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/frictionless.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/law/tangential_restitution.hpp"

namespace {

using namespace moreau;

/// Whether a law is for impulses, with these properties and no others, in the plane and in space.
template <class Law, class S>
constexpr bool is(bool attracts, bool bridges, bool bonds, bool springs, bool rolls) {
  return SetValuedLaw<Law, S> && AttractiveLaw<Law, S> == attracts &&
         BridgingLaw<Law, S> == bridges && BondingLaw<Law, S> == bonds &&
         CompliantLaw<Law, S> == springs && RollingLaw<Law, S> == rolls && !RegularizedLaw<Law, S>;
}

/// The law, and what may be wrapped around it.
template <class Law, class S, bool springs_allowed = true>
constexpr bool wraps(bool rolls) {
  using T = typename S::Scalar;
  using Wet = Bridged<CapillaryBridge<T>, Law>;
  using Near = Bridged<LinearCohesion<T>, Law>;
  bool all = is<Law, S>(false, false, false, false, rolls) &&
             is<Cohesive<Law>, S>(true, false, false, false, rolls) &&
             is<Wet, S>(true, true, false, false, rolls) &&
             is<Near, S>(true, true, false, false, rolls);
  if constexpr (springs_allowed)
    all = all && is<Compliant<Law>, S>(false, false, false, true, rolls) &&
          is<Compliant<Cohesive<Law>>, S>(true, false, false, true, rolls) &&
          is<Compliant<Wet>, S>(true, true, false, true, rolls) &&
          is<Compliant<Near>, S>(true, true, false, true, rolls);
  return all;
}

template <class S>
constexpr bool all_pairs() {
  using T = typename S::Scalar;
  // The restitution across the normal is one property more.
  static_assert(TangentialRestitutionLaw<TangentialRestitution<T>, S> &&
                TangentialRestitutionLaw<Cohesive<TangentialRestitution<T>>, S> &&
                TangentialRestitutionLaw<Bridged<CapillaryBridge<T>, TangentialRestitution<T>>, S>);
  // Of static friction: in what wraps it, not in what derives from it without.
  static_assert(StaticFrictionLaw<Cohesive<SignoriniCoulomb<T>>, S> &&
                StaticFrictionLaw<Compliant<SignoriniCoulomb<T>>, S> &&
                StaticFrictionLaw<Bridged<CapillaryBridge<T>>, S> &&
                !StaticFrictionLaw<Cohesive<RollingResistance<T>>, S>);
  static_assert(RegularizedLaw<LinearSpringDashpot<T>, S> && RegularizedLaw<HertzMindlin<T>, S> &&
                !SetValuedLaw<LinearSpringDashpot<T>, S> && !SetValuedLaw<HertzMindlin<T>, S>);
  return wraps<SignoriniCoulomb<T>, S>(false) && wraps<Frictionless<T>, S>(false) &&
         wraps<RollingResistance<T>, S>(true) && wraps<TangentialRestitution<T>, S, false>(false) &&
         is<Bonded<T>, S>(true, false, true, false, true) &&
         is<Compliant<Bonded<T>>, S>(true, false, true, true, true);
}

static_assert(all_pairs<Space<2>>());
static_assert(all_pairs<Space<3>>());
static_assert(all_pairs<Space<2, float>>());
static_assert(all_pairs<Space<3, float>>());

}  // namespace
