// SPDX-License-Identifier: MIT
#include "moreau/shape/polyhedron.hpp"

#include "run_impl.hpp"

template int ratcheting::run<moreau::Polyhedron<double>>(const Parameters&);
