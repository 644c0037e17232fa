// SPDX-License-Identifier: MIT
#include "moreau/instances/usual.hpp"

namespace moreau {
MOREAU_MEASURE_INSTANCES(template, Space<3>)
MOREAU_BALL_AND_POLYTOPE_INSTANCES(template, Ball<double>, Polyhedron<double>)
}  // namespace moreau
