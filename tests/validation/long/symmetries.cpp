// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: frames, order of the bodies, every step solved") {
  validation::check_full(validation::invariants(), "symmetries");
}
