// SPDX-License-Identifier: MIT
// Which policies of a Simulation fit together, with an error of one line for each reason why not.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

#include "moreau/detect/broad_phase.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/regularized.hpp"
#include "moreau/motion/concepts.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/defaults.hpp"
#include "moreau/world/detail/force_dynamics.hpp"

namespace moreau::detail {

/// Whether a set-valued law has a function of an optional concept, of whatever type, const or not. Without the error messages
/// below a function of another type would be ignored.
template <class Law, class S>
struct NamesOf {
  using Scalar = typename S::Scalar;
  static constexpr bool attraction = requires(Law & law, Scalar x) { law.attraction(x); };
  static constexpr bool range = requires(Law & law) { law.range(); };
  static constexpr bool springs = requires(Law & law) { law.normal_compliance(); };
  static constexpr bool share = requires(Law & law, Scalar x) { law.tangential_share(x, x); };
  static constexpr bool bridges = requires(Law & law) { law.is_bridged(std::size_t{}); };
  static constexpr bool bonds = requires(Law & law) { law.is_bonded(std::size_t{}); };
  static constexpr bool coulomb = requires { requires Law::is_coulomb; };
  static constexpr bool rolling = requires(const Law law) {
    { law.rolling() } -> std::convertible_to<double>;
  };
  /// Variants of this law; a law that derives from one with variants inherits none.
  static constexpr bool variants = requires(Law & law, std::size_t k) {
    requires std::same_as<std::remove_cvref_t<decltype(law.variant(k))>, Law>;
  };
  static constexpr bool at_rest = requires(Law & law, std::size_t k) { law.variant_at_rest(k); };
  static constexpr bool static_friction = requires(Law & law) { law.has_static_friction(); };
  static constexpr bool friction = requires(Law & law) { law.friction(); };
  static constexpr bool restitution = requires(Law & law) { law.restitution(); };
  static constexpr bool lanes = requires(Law & law) { law.lane_parameters(); };
  static constexpr bool maps_lanes = requires { &Law::template natural_map_lanes<S>; };
  /// Whether the lanes are those of the class that has solve().
  static constexpr bool own_lanes = requires {
    requires SolvesAs<Law, S, decltype(class_of(&Law::lane_parameters))>;
  };
  /// Whether lane_parameters() can be called for a law that is not const alone.
  static constexpr bool changing_lanes = lanes && !requires(const Law& law) {
    law.lane_parameters();
  };
  static constexpr bool changing_friction = friction && !requires(const Law& law) {
    law.friction();
  };
};
template <class Law, class S>
requires(!SetValuedLaw<Law, S>) struct NamesOf<Law, S> {
  static constexpr bool attraction = false, range = false, springs = false, share = false,
                        bridges = false, bonds = false, variants = false, at_rest = false,
                        static_friction = false, friction = false, restitution = false,
                        coulomb = false, rolling = false, lanes = false, maps_lanes = false,
                        own_lanes = false, changing_lanes = false, changing_friction = false;
};

/// Does not compile for policies that do not fit together.
template <class S, class Law, class Integrator, class Broad, class Solver>
struct Policies {
  static constexpr bool set_valued = SetValuedLaw<Law, S>;
  static constexpr bool forces = RegularizedLaw<Law, S>;
  static constexpr bool integrates = TimeIntegrator<Integrator, S>;

  static_assert(
      set_valued || forces,
      "Simulation: Law offers neither the functions velocity_offset, solve and natural_map "
      "(SetValuedLaw) nor the function force (RegularizedLaw) for the dimension and the scalar of "
      "the shape; static_assert the concept to see what is missing");
  using Has = NamesOf<Law, S>;
  static_assert(!Has::attraction || AttractiveLaw<Law, S>,
                "Simulation: Law has attraction(), but is no AttractiveLaw; static_assert the "
                "concept to see what is missing");
  static_assert(!(AttractiveLaw<Law, S> && Has::range) || AttractsInRange<Law, S>,
                "Simulation: Law has range(), but is no AttractsInRange: range() must be const and "
                "return the scalar of the law");
  static_assert(!Has::springs || CompliantLaw<Law, S>,
                "Simulation: Law has normal_compliance(), but is no CompliantLaw; static_assert "
                "the concept to see what is missing");
  static_assert(!Has::share || TangentialRestitutionLaw<Law, S>,
                "Simulation: Law has tangential_share(), but is no TangentialRestitutionLaw; "
                "static_assert the concept to see what is missing");
  static_assert(!Has::bridges || BridgingLaw<Law, S>,
                "Simulation: Law has is_bridged(), but is no BridgingLaw; static_assert the "
                "concept to see what is missing");
  static_assert(!Has::bonds || BondingLaw<Law, S>,
                "Simulation: Law has is_bonded(), but is no BondingLaw; static_assert the concept "
                "to see what is missing");
  static_assert(
      !Has::variants || StatefulLaw<Law, S>,
      "Simulation: Law has variant(), but is no StatefulLaw; static_assert the concept to "
      "see what is missing");
  static_assert(!(StatefulLaw<Law, S> && (Has::at_rest || Has::static_friction)) ||
                    StaticFrictionLaw<Law, S>,
                "Simulation: Law has variant_at_rest() or has_static_friction(), but is no "
                "StaticFrictionLaw; static_assert the concept to see what is missing");
  static_assert(!Has::coulomb || FrictionLaw<Law>,
                "Simulation: Law has is_coulomb, but no friction() const that returns a number");
  static_assert(!(Has::coulomb && Rolls<Law>) || Has::rolling,
                "Simulation: Law has couples and is_coulomb, but no rolling() const that returns a "
                "number, the coefficient of rolling resistance");
  static_assert(!Has::changing_friction, "Simulation: friction() of Law must be const");
  static_assert(!Has::restitution || RestitutionLaw<Law>,
                "Simulation: restitution() of Law must be const and return a number");
  static_assert(!Has::changing_lanes, "Simulation: lane_parameters() of Law must be const");
  static_assert(!(Has::maps_lanes && Has::own_lanes && CoulombLaw<Law, S>) || MapsLanes<Law, S>,
                "Simulation: Law has natural_map_lanes(), but is no MapsLanes; static_assert the "
                "concept to see what is missing");
  static_assert(!Has::own_lanes || LaneLaw<Law, S>,
                "Simulation: Law has lane_parameters(), but is no LaneLaw; static_assert the "
                "concept to see what is missing");
  static_assert(!(Has::coulomb || Has::lanes) || SolvesAs<Law, S, Law>,
                "Simulation: the function solve() of a law with is_coulomb or lanes must be one "
                "const member function (or template) whose parameters are references to const");
  static_assert(
      !(CompliantLaw<Law, S> && TangentialRestitutionLaw<Law, S>),
      "Simulation: Compliant<TangentialRestitution> would have two tangential restitutions, "
      "that of the springs and beta0; use Compliant<SignoriniCoulomb> or "
      "TangentialRestitution");
  static_assert(
      !ActsWhereGapsClose<Law> || !(CompliantLaw<Law, S> || BridgingLaw<Law, S> ||
                                    (AttractiveLaw<Law, S> && !BondingLaw<Law, S>)),
      "Simulation: a law with springs, bridges or an attraction acts where gaps are open, too; it "
      "must not have the member type ActsWhereGapsClose");
  static_assert(integrates,
                "Simulation: Integrator offers the functions neither of an ImpulseIntegrator nor "
                "of a ForceIntegrator with the types of the shape's space; assert the concept to "
                "see what is missing");
  static_assert(
      !requires(Integrator & i) { i.theta(); } ||
          requires(const Integrator& i) {
            { i.theta() } -> std::convertible_to<double>;
          },
      "Simulation: theta() of Integrator must be const and return a number");
  static_assert(
      !requires(Integrator & i) { i.with_theta(0.5); } ||
          requires(const Integrator& i) { i.with_theta(0.5); },
      "Simulation: with_theta() of Integrator must be const");
  static_assert(!set_valued || !integrates || ImpulseIntegrator<Integrator, S>,
                "Simulation: a set-valued law gives impulses, which an integrator of forces such "
                "as VelocityVerlet cannot take; use MoreauJean or a regularized law");
  static_assert(!forces || !integrates || ForceIntegrator<Integrator, S>,
                "Simulation: a regularized law gives forces, which an integrator of impulses such "
                "as MoreauJean cannot take; use VelocityVerlet or a set-valued law");
  static_assert(BroadPhase<Broad, S>,
                "Simulation: Broad is no BroadPhase in the space of the shape, whose dimension and "
                "scalar must be its own");
  static_assert(!set_valued || ContactSolver<Solver, Law, S>,
                "Simulation: Solver cannot take this set-valued law: ColouredGaussSeidel and "
                "NonlinearGaussSeidel take all, NoSolver none");
  static_assert(!forces || std::same_as<Solver, NoSolver>,
                "Simulation: a regularized law leaves nothing to solve; its Solver is NoSolver");
};

}  // namespace moreau::detail
