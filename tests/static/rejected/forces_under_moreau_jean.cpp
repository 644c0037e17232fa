// SPDX-License-Identifier: MIT
// A regularized law with an integrator of impulses.
// expect: a regularized law gives forces, which an integrator of impulses such as MoreauJean
// and no other error
#include "moreau/law/linear_spring_dashpot.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_CORRECTED
using Integrator = moreau::VelocityVerlet;
#else
using Integrator = moreau::MoreauJean;
#endif

using Law = moreau::LinearSpringDashpot<double>;
moreau::Simulation<moreau::Ball<double>, Law, Integrator> simulation(0.01,
                                                                     moreau::Materials<Law>(1));
