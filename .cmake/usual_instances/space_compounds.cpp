// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
MOREAU_CAPSULE_AND_COMPOUND_INSTANCES(template, Capsule<double>, Polyhedron<double>)
}  // namespace moreau
