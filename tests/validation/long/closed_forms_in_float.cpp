// SPDX-License-Identifier: MIT
#include "validation/check.hpp"

TEST_CASE("validation: closed forms in single precision") {
  validation::check_quick(validation::closed_forms_in_float());
}
