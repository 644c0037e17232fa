// SPDX-License-Identifier: MIT
#include "moreau/shape/ball.hpp"

#include "conformance/matrix.hpp"

TEST_CASE_TEMPLATE("spheres under every law", T, double, float) {
  conformance::all_laws(moreau::Ball<T>(T(0.005)), T(0.01));
}
