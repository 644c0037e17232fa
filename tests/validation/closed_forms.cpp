// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: closed forms") {
  validation::check_quick(validation::closed_forms());
}
