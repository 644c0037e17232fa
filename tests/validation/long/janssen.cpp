// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

// R^2 is 0.86 for disks and 0.95 for spheres, not 0.98: in this one packing the stress falls again
// by a tenth to a fifth in the lowest two widths. The cause is not known.
TEST_CASE("validation: Janssen's silo" * doctest::may_fail()) {
  validation::check_full(validation::packings(), "janssen");
}
