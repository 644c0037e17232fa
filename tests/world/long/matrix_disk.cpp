// SPDX-License-Identifier: MIT
#include "moreau/shape/sphere.hpp"

#include "conformance/matrix.hpp"

TEST_CASE_TEMPLATE("disks under every law", T, double, float) {
  conformance::all_laws(moreau::Sphere<moreau::Space<2, T>>(T(0.005)), T(0.01));
}
