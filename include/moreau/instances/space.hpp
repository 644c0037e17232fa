// SPDX-License-Identifier: MIT
// The usual worlds in space, compiled once for a program: balls and polyhedra. plane.hpp says how
// to use it.
#pragma once

#include "moreau/instances/detail/instance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/world/simulation.hpp"

namespace moreau {
/// @cond instances
MOREAU_WORLD_INSTANCES(MOREAU_INSTANCE, Space<3>, Polyhedron<double>)
/// @endcond
}  // namespace moreau
