// SPDX-License-Identifier: MIT
#define MOREAU_INSTANTIATE
#include "moreau/instances/space.hpp"
