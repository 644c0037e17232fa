// SPDX-License-Identifier: MIT
// The worlds of compound grains, whose step is compiled once for each kind of part, in compound_*.cpp.
#pragma once

#include "moreau/instances/detail/instance.hpp"
#include "moreau/law/signorini_coulomb.hpp"
#include "moreau/shape/compound.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/world/simulation.hpp"

#define COMPOUND_INSTANCES(KEYWORD, PartT)         \
  MOREAU_SHAPE_INSTANCES(KEYWORD, Compound<PartT>) \
  MOREAU_STEP_INSTANCE(KEYWORD, Compound<PartT>, SignoriniCoulomb<double>)

namespace moreau {
COMPOUND_INSTANCES(extern template, Polygon<double>)
COMPOUND_INSTANCES(extern template, Polyhedron<double>)
}  // namespace moreau
