// SPDX-License-Identifier: MIT
#include "moreau/shape/capsule.hpp"

#include "conformance/matrix.hpp"

TEST_CASE_TEMPLATE("capsules under every law", T, double, float) {
  conformance::all_laws(moreau::Capsule<T>(T(0.0025), T(0.0025)), T(0.01));
}
