// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace moreau {
MOREAU_PYTHON_WORLDS(template, Space<2>, Polygon<double>, moreau_python::Rolling)
}  // namespace moreau
