// SPDX-License-Identifier: MIT
// What takes long to compile of the usual worlds in space, compiled once for a program: balls and
// polyhedra in double under Signorini–Coulomb, with the default integrator, broad phase and solver.
// Include it in every unit; one of them defines MOREAU_INSTANTIATE before. Without that one, the
// linker misses what the others rely on. Other worlds of the same law share the solver too.
#pragma once

#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/sphere.hpp"
#include "moreau/world/simulation.hpp"

#ifdef MOREAU_INSTANTIATE
#define MOREAU_INSTANCE template
#else
#define MOREAU_INSTANCE extern template
#endif

namespace moreau {
/// @cond instances

MOREAU_INSTANCE class Polyhedron<double>;
MOREAU_INSTANCE class ContactDetector<Polyhedron<double>, SweepAndPrune<Space<3>>>;
MOREAU_INSTANCE class ContactDetector<Sphere<Space<3>>, SweepAndPrune<Space<3>>>;
MOREAU_INSTANCE class detail::ImpulseDynamics<Space<3>, SignoriniCoulomb<double>, MoreauJean,
                                              ColouredGaussSeidel>;

MOREAU_INSTANCE StepReport Simulation<Polyhedron<double>, SignoriniCoulomb<double>>::step(double);
MOREAU_INSTANCE StepReport Simulation<Sphere<Space<3>>, SignoriniCoulomb<double>>::step(double);

/// @endcond
}  // namespace moreau

#undef MOREAU_INSTANCE
