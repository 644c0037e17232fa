// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace moreau {
MOREAU_PYTHON_WORLDS(template, Space<3>, Polyhedron<double>, moreau_python::Compliant)
}  // namespace moreau
