// SPDX-License-Identifier: MIT
// A law with couples and a solver that can treat only point contacts.
// expect: Solver cannot take this set-valued law
// and no other error
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_CORRECTED
using Solver = moreau::NonlinearGaussSeidel;
#else
using Solver = moreau::ColouredGaussSeidel;
#endif

using Law = moreau::RollingResistance<double>;
using Plane = moreau::Space<2>;
moreau::Simulation<moreau::Disk<>, Law, moreau::MoreauJean, moreau::SweepAndPrune<Plane>, Solver>
    simulation(0.01, moreau::Materials<Law>(1));
