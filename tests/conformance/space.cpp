// SPDX-License-Identifier: MIT
#include "conformance/shapes.hpp"

TEST_CASE_TEMPLATE("every shape", S, moreau::Space<3>, moreau::Space<3, float>) {
  conformance::check_all_shapes<S>();
}
