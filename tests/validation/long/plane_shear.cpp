// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: plane shear of disks") {
  validation::check_full(validation::packings(), "plane_shear");
}
