// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>

#include "moreau/law/concepts.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/solve/solve_report.hpp"
#include "moreau/world/detail/attraction.hpp"
#include "moreau/world/detail/bonds/bond_list.hpp"
#include "moreau/world/detail/step_context.hpp"

namespace moreau::detail {

/// Solves the contact problem again while the strength of bonds that yield falls within the step. It ends if the impulses differ
/// from those of the strengths by no more than the tolerance of the solver, in two measures: the difference of all bonds relative to
/// all impulses on the bodies, as the residual of the solver; and that of each bond relative to its own strength, which a large load
/// elsewhere does not hide. An error of the impulses of a solution is an error of the velocity at which bonds yield. At most
/// BondList::max_solutions solutions are computed, that of the caller included. The last one is not compared any more: the report then
/// says that the problem is not solved (`capped`).
/// @param op       operator of the problem
/// @param pushes   p of the present solution, see pushes.hpp [N s]
/// @param roots    M^-1/2 of every body
/// @param free     velocities without contacts, one per body [m/s, rad/s]
/// @param tolerance of the solver [-]
/// @param solve    function: solves the problem and replaces the report
/// @param shared   bodies that other processes share; null: none
template <class S, class Law, class Operator>
void soften_bonds(const StepContext<S, Law>& context, BondList<S, Law>& bonds,
                  Attraction<S, Law>& attraction, Operator& op,
                  std::span<typename Operator::Vector> pushes,
                  std::span<const MobilityRoot<S>> roots, auto& free, double tolerance,
                  const auto& solve, SolveReport& report, SharedBodies* shared) {
  using Scalar = typename S::Scalar;
  const double enough = std::max(tolerance, std::is_same_v<Scalar, float> ? 1e-4 : 1e-8);
  const auto change = [&](std::size_t c, Scalar pull) {
    attraction.change(c, pull, context.contacts, roots, pushes[c]);
    if constexpr (CompliantLaw<Law, S>) {
      typename Operator::Vector normal = Operator::Vector::Zero();
      normal[0] = -pull * op.compliance(c)[0];
      op.offset(c, normal);
    }
  };
  for (int k = 1; k < BondList<S, Law>::max_solutions; ++k) {
    double sums[] = {0, 0};
    sums[0] = bonds.find_strengths(context.materials, op, context.contacts, pushes,
                                   attraction.pulls(), context.step);
    for (std::size_t c = 0; c < pushes.size(); ++c) {
      auto load = pushes[c];
      load[0] -= attraction.pulls()[c];
      sums[1] += load.template cast<double>().squaredNorm();
    }
    double farthest = bonds.farthest();
    if (shared) {
      shared->sum(sums);
      shared->largest(std::span(&farthest, 1));
    }
    if (sums[0] <= enough * enough * sums[1] && farthest <= enough) return;
    bonds.soften(change);
    attraction.offset(context.contacts, free, op, shared);
    const int sweeps = report.sweeps;
    solve();
    report.sweeps += sweeps;
  }
  report.converged = false;
  report.capped = true;
}

}  // namespace moreau::detail
