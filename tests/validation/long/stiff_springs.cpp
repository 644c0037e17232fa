// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: springs tend to contact dynamics") {
  validation::check_full(validation::packings(), "stiff_springs");
}
