// SPDX-License-Identifier: MIT
#include "moreau/shape/polygon.hpp"

#include "run_impl.hpp"

static const ratcheting::Runner runner("polygon", ratcheting::run<moreau::Polygon<double>>);
