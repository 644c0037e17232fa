// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: energy without drive while grains fall") {
  validation::check_full(validation::invariants(), "energy_of_fall");
}
