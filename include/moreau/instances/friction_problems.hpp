// SPDX-License-Identifier: MIT
// The solver of problems that are given by their matrices, compiled once for a program: include
// this in every unit that solves such; one of them defines MOREAU_INSTANTIATE before. Without that
// one, the linker misses what the others rely on.
#pragma once

#include "moreau/solve/proximal_solver.hpp"

#ifdef MOREAU_INSTANTIATE
#define MOREAU_INSTANCE template
#else
#define MOREAU_INSTANCE extern template
#endif

namespace moreau {
/// @cond instances

MOREAU_INSTANCE ProblemReport ProximalSolver::solve(const FrictionProblem<Space<2>>&,
                                                    Eigen::VectorXd&) const;
MOREAU_INSTANCE ProblemReport ProximalSolver::solve(const FrictionProblem<Space<3>>&,
                                                    Eigen::VectorXd&) const;

/// @endcond
}  // namespace moreau

#undef MOREAU_INSTANCE
