// SPDX-License-Identifier: MIT
#include "run_impl.hpp"

static const ratcheting::Runner runner("sphere", ratcheting::run<moreau::Ball<>>);
