// SPDX-License-Identifier: MIT
// The core of moreau in one include: shapes, Coulomb's law, the default solver, Simulation. Include
// all other headers one by one: further laws and solvers, drives (boundary/), measurements
// (measure/), samples (sample/), files (io/), threads. examples/guide/headers.md lists the public
// headers.
//
// To read the code, begin here (examples/guide/where.md has more):
//   stages of a step             Simulation::step()             world/simulation.hpp
//                                ImpulseDynamics::advance()     world/detail/impulse_dynamics.hpp
//   pairs that may touch         ContactDetector::find_pairs()  world/contact_detector.hpp
//   contact of two polytopes     collide()                      detect/pairs/collide_polytopes.hpp
//   gap of a contact point       ContactPolygon::point()        detect/polytope/contact_polygon.hpp
//   Delassus operator            BodyDelassus::assemble()       contact/body_delassus.hpp
//   impulse of a contact point   GroupKernel::visit()           solve/coloured/group_kernel.hpp
//   Coulomb's law for a contact  CoulombLanes::solve()          law/detail/coulomb_lanes.hpp
//   residual                     measure_residual()             solve/measure_residual.hpp
#pragma once

#include "moreau/core/compiler.hpp"
#include "moreau/law/materials.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/rounded.hpp"
#include "moreau/solve/coloured_gauss_seidel.hpp"
#include "moreau/version.hpp"
#include "moreau/world/simulation.hpp"
