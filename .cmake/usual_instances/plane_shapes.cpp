// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
MOREAU_MEASURE_INSTANCES(template, Space<2>)
MOREAU_BALL_AND_POLYTOPE_INSTANCES(template, Disk<double>, Polygon<double>)
}  // namespace moreau
