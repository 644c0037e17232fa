// SPDX-License-Identifier: MIT
#include "run_impl.hpp"

static const ratcheting::Runner runner("disk", ratcheting::run<moreau::Disk<>>);
