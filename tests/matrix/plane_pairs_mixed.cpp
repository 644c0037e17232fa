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

TEST_CASE("plane, double: disks, polygons and stadiums under the other pairs") {
  matrix::mixtures<Sharp>(other_pairs);
}
TEST_CASE("plane, double: polygons with sharp and rounded corners under the other pairs") {
  matrix::sharp_and_rounded<Sharp>(other_pairs);
}
TEST_CASE("plane, double: concave ballast under the other pairs") {
  matrix::ballast<Sharp>(other_pairs);
}
TEST_CASE("plane, double: dumbbells under the other pairs") {
  matrix::dumbbells<S>(other_pairs);
}
