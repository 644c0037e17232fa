// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: random close packing") {
  validation::check_full(validation::packings(), "close_packing");
}
