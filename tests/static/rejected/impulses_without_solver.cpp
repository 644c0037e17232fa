// SPDX-License-Identifier: MIT
// A set-valued law without a contact solver.
// expect: Solver cannot take this set-valued law
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_CORRECTED
using Solver = moreau::NonlinearGaussSeidel;
#else
using Solver = moreau::NoSolver;
#endif

using Law = moreau::SignoriniCoulomb<double>;
using Plane = moreau::Space<2>;
moreau::Simulation<moreau::Disk<>, Law, moreau::MoreauJean, moreau::SweepAndPrune<Plane>, Solver>
    simulation(0.01, moreau::Materials<Law>(1));
