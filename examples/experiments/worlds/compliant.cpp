// SPDX-License-Identifier: MIT
#define EXPERIMENTS_INSTANTIATE_COMPLIANT
#include "../worlds.hpp"
