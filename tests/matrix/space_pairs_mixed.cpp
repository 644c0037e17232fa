// SPDX-License-Identifier: MIT
#include "conformance/matrix.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<3, double>;
using Sharp = moreau::Polyhedron<double>;

constexpr auto other_pairs = [](const auto& shapes, S::Scalar size) {
  conformance::other_pairs(shapes, size);
};

}  // namespace

TEST_CASE("space, double: spheres, polyhedra and capsules under the other pairs") {
  matrix::mixtures<Sharp>(other_pairs);
}
TEST_CASE("space, double: polyhedra with sharp and rounded corners under the other pairs") {
  matrix::sharp_and_rounded<Sharp>(other_pairs);
}
TEST_CASE("space, double: concave ballast under the other pairs") {
  matrix::ballast<Sharp>(other_pairs);
}
TEST_CASE("space, double: dumbbells under the other pairs") {
  matrix::dumbbells<S>(other_pairs);
}
