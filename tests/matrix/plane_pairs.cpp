// SPDX-License-Identifier: MIT
#include "conformance/matrix.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<2, double>;
using Sharp = moreau::Polygon<double>;

constexpr auto other_pairs = [](const auto& shapes, S::Scalar size) {
  conformance::other_pairs(shapes, size);
};

}  // namespace

TEST_CASE("plane, double: disks under the other pairs") {
  matrix::balls<S>(other_pairs);
}
TEST_CASE("plane, double: stadiums under the other pairs") {
  matrix::capsules<S>(other_pairs);
}
TEST_CASE("plane, double: polygons under the other pairs") {
  matrix::polytopes<Sharp>(other_pairs);
}
TEST_CASE("plane, double: rounded polygons under the other pairs") {
  matrix::rounded<Sharp>(other_pairs);
}
TEST_CASE("plane, double: a shape known by its farthest points under the other pairs") {
  matrix::support_only<S>(other_pairs);
}
