// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
MOREAU_PLANE_INSTANCES(template, Compliant<SignoriniCoulomb<double>>)
}  // namespace moreau
