// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: column of bodies") {
  validation::check_full(validation::structures(), "column");
}
