// SPDX-License-Identifier: MIT
// A set-valued law with an integrator of forces.
// expect: a set-valued law gives impulses, which an integrator of forces such as VelocityVerlet
// and no other error
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_CORRECTED
using Integrator = moreau::MoreauJean;
#else
using Integrator = moreau::VelocityVerlet;
#endif

using Law = moreau::SignoriniCoulomb<double>;
moreau::Simulation<moreau::Ball<double>, Law, Integrator> simulation(0.01,
                                                                     moreau::Materials<Law>(1));
