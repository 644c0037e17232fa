// SPDX-License-Identifier: MIT
// A regularized law, for which there is nothing to solve, with a contact solver.
// expect: a regularized law leaves nothing to solve
// and no other error
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_CORRECTED
using Solver = moreau::NoSolver;
#else
using Solver = moreau::NonlinearGaussSeidel;
#endif

using Law = moreau::LinearSpringDashpot<double>;
using Plane = moreau::Space<2>;
moreau::Simulation<moreau::Disk<>, Law, moreau::VelocityVerlet, moreau::SweepAndPrune<Plane>,
                   Solver>
    simulation(0.01, moreau::Materials<Law>(1));
