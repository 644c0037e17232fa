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

TEST_CASE("space, double: spheres under the other pairs") {
  matrix::balls<S>(other_pairs);
}
TEST_CASE("space, double: capsules under the other pairs") {
  matrix::capsules<S>(other_pairs);
}
TEST_CASE("space, double: polyhedra under the other pairs") {
  matrix::polytopes<Sharp>(other_pairs);
}
TEST_CASE("space, double: rounded polyhedra under the other pairs") {
  matrix::rounded<Sharp>(other_pairs);
}
TEST_CASE("space, double: a shape known by its farthest points under the other pairs") {
  matrix::support_only<S>(other_pairs);
}
