// SPDX-License-Identifier: MIT
#define EXPERIMENTS_INSTANTIATE_BALLS
#include "../worlds.hpp"
