// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: structures in single precision") {
  validation::check_quick(validation::structures_in_float());
}
