// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: structures") {
  validation::check_quick(validation::structures());
}
