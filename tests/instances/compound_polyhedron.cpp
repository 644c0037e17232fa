// SPDX-License-Identifier: MIT
#include "instances/compound.hpp"

namespace moreau {
COMPOUND_INSTANCES(template, Polyhedron<double>)
}  // namespace moreau
