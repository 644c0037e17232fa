// SPDX-License-Identifier: MIT
// A broad phase for the plane in a simulation of balls in space.
// expect: Broad is no BroadPhase in the space of the shape
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_CORRECTED
using Broad = moreau::SweepAndPrune<moreau::Space<3>>;
#else
using Broad = moreau::SweepAndPrune<moreau::Space<2>>;
#endif

using Law = moreau::SignoriniCoulomb<double>;
moreau::Simulation<moreau::Ball<>, Law, moreau::MoreauJean, Broad> simulation(
    0.01, moreau::Materials<Law>(1));
