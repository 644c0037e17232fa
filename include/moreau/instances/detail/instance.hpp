// SPDX-License-Identifier: MIT
// Macros of this folder. Templates that take long to compile are declared extern in every unit and
// instantiated in the one unit that defines MOREAU_INSTANTIATE before its includes.
#pragma once

#ifdef MOREAU_INSTANTIATE
#define MOREAU_INSTANCE template
#else
#define MOREAU_INSTANCE extern template
#endif

/// The worlds of one space: spheres and one kind of polytope in double under Signorini-Coulomb,
/// with the default integrator, broad phase and solver.
#define MOREAU_WORLD_INSTANCES(SpaceT, PolytopeT)                                             \
  MOREAU_INSTANCE class PolytopeT;                                                            \
  MOREAU_INSTANCE class ContactDetector<PolytopeT, CellGrid<SpaceT>>;                         \
  MOREAU_INSTANCE class ContactDetector<BallIn<SpaceT>, CellGrid<SpaceT>>;                    \
  MOREAU_INSTANCE class detail::ImpulseDynamics<SpaceT, SignoriniCoulomb<double>, MoreauJean, \
                                                ColouredGaussSeidel>;                         \
  MOREAU_INSTANCE StepReport Simulation<PolytopeT, SignoriniCoulomb<double>>::step(double);   \
  MOREAU_INSTANCE StepReport Simulation<BallIn<SpaceT>, SignoriniCoulomb<double>>::step(double);
