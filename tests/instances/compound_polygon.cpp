// SPDX-License-Identifier: MIT
#include "instances/compound.hpp"

namespace moreau {
COMPOUND_INSTANCES(template, Polygon<double>)
}  // namespace moreau
