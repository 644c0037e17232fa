// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: invariants") {
  validation::check_quick(validation::invariants());
}
