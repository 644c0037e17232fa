// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: forces in a packing at rest") {
  validation::check_full(validation::invariants(), "balance");
}
