// SPDX-License-Identifier: MIT
// ProximalSolver, compiled once for a program. Include this header in every unit that solves
// friction problems. Exactly one unit defines MOREAU_INSTANTIATE before; without it the program
// does not link.
#pragma once

#include "moreau/instances/detail/instance.hpp"
#include "moreau/solve/proximal_solver.hpp"

namespace moreau {
/// @cond instances
MOREAU_INSTANCE ProblemReport ProximalSolver::solve(const FrictionProblem<Space<2>>&,
                                                    Eigen::VectorXd&) const;
MOREAU_INSTANCE ProblemReport ProximalSolver::solve(const FrictionProblem<Space<3>>&,
                                                    Eigen::VectorXd&) const;
/// @endcond
}  // namespace moreau
