// SPDX-License-Identifier: MIT
#define EXPERIMENTS_INSTANTIATE_CAPSULES
#include "../worlds.hpp"
