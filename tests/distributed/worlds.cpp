// SPDX-License-Identifier: MIT
#define MOREAU_DISTRIBUTED_INSTANTIATE
#include "distributed/worlds.hpp"
