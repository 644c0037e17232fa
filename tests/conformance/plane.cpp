// SPDX-License-Identifier: MIT
#include "conformance/shapes.hpp"

TEST_CASE_TEMPLATE("every shape", S, moreau::Space<2>, moreau::Space<2, float>) {
  conformance::check_all_shapes<S>();
}
