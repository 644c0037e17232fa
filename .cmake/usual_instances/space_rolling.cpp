// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
MOREAU_SPACE_INSTANCES(template, RollingResistance<double>)
}  // namespace moreau
