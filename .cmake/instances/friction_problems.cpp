// SPDX-License-Identifier: MIT
#define MOREAU_INSTANTIATE
#include "moreau/instances/friction_problems.hpp"
