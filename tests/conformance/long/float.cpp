// SPDX-License-Identifier: MIT
#include "conformance/shapes.hpp"

TEST_CASE("every shape, in single precision") {
  conformance::check_all_shapes<moreau::Space<2, float>>();
  conformance::check_all_shapes<moreau::Space<3, float>>();
}
