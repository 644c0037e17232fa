// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: semicircular arch") {
  validation::check_full(validation::structures(), "arch");
}
