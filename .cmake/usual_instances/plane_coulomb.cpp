// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
MOREAU_PLANE_INSTANCES(template, SignoriniCoulomb<double>)
}  // namespace moreau
