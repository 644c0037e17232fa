// SPDX-License-Identifier: MIT
#include "moreau/shape/half_space.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>

#include "shape/message_of.hpp"

namespace {

using moreau::HalfSpace;
using moreau::Space;

TEST_CASE("the normal is unit whatever the length given") {
  CHECK(HalfSpace<Space<3>>({0, 0, 5}).normal() == Eigen::Vector3d(0, 0, 1));
  CHECK((HalfSpace<Space<2>>({3, -4}).normal() - Eigen::Vector2d(0.6, -0.8)).norm() < 1e-15);
  CHECK((HalfSpace<Space<3>>({3e-300, 0, 4e-300}).normal() - Eigen::Vector3d(0.6, 0, 0.8)).norm() <
        1e-15);
  CHECK((HalfSpace<Space<2, float>>({3e30F, 4e30F}).normal() - Eigen::Vector2f(0.6F, 0.8F)).norm() <
        1e-6F);
}

TEST_CASE("bad normals are named") {
  CHECK(message_of([] {
          HalfSpace<Space<3>>({0, 0, 0});
        }) == "HalfSpace: normal = (0, 0, 0) must not be zero");
  CHECK(message_of([] {
          HalfSpace<Space<2>>({std::nan(""), 0});
        }) == "HalfSpace: normal = (nan, 0) must be finite");
  const float inf = std::numeric_limits<float>::infinity();
  CHECK(message_of([=] {
          HalfSpace<Space<3, float>>({1, inf, 0});
        }) == "HalfSpace: normal = (1, inf, 0) must be finite");
}

}  // namespace
