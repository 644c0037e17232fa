// SPDX-License-Identifier: MIT
// A law in single precision for grains in double precision.
// expect: Law offers neither velocity_offset, solve and natural_map
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_CORRECTED
using Law = moreau::SignoriniCoulomb<double>;
#else
using Law = moreau::SignoriniCoulomb<float>;
#endif

moreau::Simulation<moreau::Ball<double>, Law> simulation(0.01, moreau::Materials<Law>(1));
