// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: invariants in single precision") {
  validation::check_quick(validation::invariants_in_float());
}
