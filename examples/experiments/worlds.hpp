// SPDX-License-Identifier: MIT
// The worlds of the experiments that moreau/instances does not have, each compiled once, in worlds/. A unit of
// worlds/ defines EXPERIMENTS_INSTANTIATE_... for its own.
#pragma once

#include <moreau/moreau.hpp>

#include "moreau/law/compliant.hpp"
#include "moreau/law/hertz_mindlin.hpp"
#include "moreau/law/rolling_resistance.hpp"
#include "moreau/shape/rounded.hpp"

namespace experiments {

using Rigid = moreau::SignoriniCoulomb<double>;
using Springs = moreau::Compliant<Rigid>;
using Hertz = moreau::HertzMindlin<double>;
using Rolling = moreau::RollingResistance<double>;

}  // namespace experiments

#ifdef EXPERIMENTS_INSTANTIATE_BALLS
#define EXPERIMENTS_BALLS template
#else
#define EXPERIMENTS_BALLS extern template
#endif
#ifdef EXPERIMENTS_INSTANTIATE_COMPLIANT
#define EXPERIMENTS_COMPLIANT template
#else
#define EXPERIMENTS_COMPLIANT extern template
#endif
#ifdef EXPERIMENTS_INSTANTIATE_CAPSULES
#define EXPERIMENTS_CAPSULES template
#else
#define EXPERIMENTS_CAPSULES extern template
#endif
#ifdef EXPERIMENTS_INSTANTIATE_ROLLING
#define EXPERIMENTS_ROLLING template
#else
#define EXPERIMENTS_ROLLING extern template
#endif
#ifdef EXPERIMENTS_INSTANTIATE_ROUNDED
#define EXPERIMENTS_ROUNDED template
#else
#define EXPERIMENTS_ROUNDED extern template
#endif

namespace moreau {

EXPERIMENTS_COMPLIANT class detail::ImpulseDynamics<Space<3>, experiments::Springs, MoreauJean,
                                                    ColouredGaussSeidel>;
EXPERIMENTS_COMPLIANT StepReport Simulation<Polyhedron<double>, experiments::Springs>::step(double);
EXPERIMENTS_BALLS StepReport Simulation<Ball<double>, experiments::Springs>::step(double);
EXPERIMENTS_BALLS StepReport Simulation<Ball<double>, experiments::Hertz>::step(double);
EXPERIMENTS_CAPSULES class ContactDetector<Capsule<double>, CellGrid<Space<3>>>;
EXPERIMENTS_CAPSULES StepReport Simulation<Capsule<double>, experiments::Rigid>::step(double);
EXPERIMENTS_CAPSULES StepReport Simulation<Capsule<double>, experiments::Springs>::step(double);
EXPERIMENTS_ROLLING class detail::ImpulseDynamics<Space<3>, experiments::Rolling, MoreauJean,
                                                  ColouredGaussSeidel>;
EXPERIMENTS_ROLLING StepReport Simulation<Ball<double>, experiments::Rolling>::step(double);
EXPERIMENTS_ROUNDED class ContactDetector<Rounded<Polyhedron<double>>, CellGrid<Space<3>>>;
EXPERIMENTS_ROUNDED StepReport
Simulation<Rounded<Polyhedron<double>>, experiments::Rigid>::step(double);

}  // namespace moreau
