// SPDX-License-Identifier: MIT
// Which policies of a Simulation fit together, with an error of one line for each reason why not.
#pragma once

#include <concepts>

#include "moreau/detect/broad_phase.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/law/regularized.hpp"
#include "moreau/motion/concepts.hpp"
#include "moreau/solve/concepts.hpp"
#include "moreau/world/defaults.hpp"
#include "moreau/world/detail/force_dynamics.hpp"

namespace moreau::detail {

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
  static_assert(
      !(CompliantLaw<Law, S> && TangentialRestitutionLaw<Law, S>),
      "Simulation: Compliant<TangentialRestitution> would have two tangential restitutions, "
      "that of the springs and beta0; use Compliant<SignoriniCoulomb> or "
      "TangentialRestitution");
  static_assert(integrates,
                "Simulation: Integrator offers the functions neither of an ImpulseIntegrator nor "
                "of a ForceIntegrator with the types of the shape's space; assert the concept to "
                "see what is missing");
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
