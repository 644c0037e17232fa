// SPDX-License-Identifier: MIT
// The usual worlds in the plane, compiled once for a program: disks and polygons in double under
// Signorini-Coulomb, with the default integrator, broad phase and solver. Include this header in
// every unit of the program. Exactly one unit defines MOREAU_INSTANTIATE before; without it the
// program does not link. Other worlds of the same law share the solver.
#pragma once

#include "moreau/instances/detail/instance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {
/// @cond instances
MOREAU_WORLD_INSTANCES(MOREAU_INSTANCE, Space<2>, Polygon<double>)
/// @endcond
}  // namespace moreau
