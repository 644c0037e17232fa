// SPDX-License-Identifier: MIT
#define EXPERIMENTS_INSTANTIATE_ROUNDED
#include "../worlds.hpp"
