// SPDX-License-Identifier: MIT
#include "moreau/shape/polyhedron.hpp"

#include "run_impl.hpp"

static const ratcheting::Runner runner("polyhedron", ratcheting::run<moreau::Polyhedron<double>>);
