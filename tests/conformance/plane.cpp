// SPDX-License-Identifier: MIT
#include "conformance/shapes.hpp"

TEST_CASE("every shape of the plane") {
  conformance::check_all_shapes<moreau::Space<2>>();
}
