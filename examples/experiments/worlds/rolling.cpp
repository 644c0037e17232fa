// SPDX-License-Identifier: MIT
#define EXPERIMENTS_INSTANTIATE_ROLLING
#include "../worlds.hpp"
