// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: Janssen's silo") {
  validation::check_full(validation::packings(), "janssen");
}
