// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: energy without drive, 1e5 steps") {
  validation::check_full(validation::invariants(), "energy");
}
