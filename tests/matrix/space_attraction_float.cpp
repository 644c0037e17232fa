// SPDX-License-Identifier: MIT
#include "conformance/matrix.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<3, float>;
using Sharp = moreau::Polyhedron<float>;

constexpr auto all_laws = [](const auto& shapes, S::Scalar size) {
  conformance::laws_of_attraction(shapes, size);
};

}  // namespace

TEST_CASE("space, float: spheres under laws that attract") {
  matrix::balls<S>(all_laws);
}
TEST_CASE("space, float: capsules under laws that attract") {
  matrix::capsules<S>(all_laws);
}
TEST_CASE("space, float: polyhedra under laws that attract") {
  matrix::polytopes<Sharp>(all_laws);
}
TEST_CASE("space, float: rounded polyhedra under laws that attract") {
  matrix::rounded<Sharp>(all_laws);
}
TEST_CASE("space, float: spheres, polyhedra and capsules under laws that attract") {
  matrix::mixtures<Sharp>(all_laws);
}
TEST_CASE("space, float: polyhedra with sharp and rounded corners under laws that attract") {
  matrix::sharp_and_rounded<Sharp>(all_laws);
}
TEST_CASE("space, float: a shape known by its farthest points under laws that attract") {
  matrix::support_only<S>(all_laws);
}
TEST_CASE("space, float: concave ballast under laws that attract") {
  matrix::ballast<Sharp>(all_laws);
}
TEST_CASE("space, float: dumbbells under laws that attract") {
  matrix::dumbbells<S>(all_laws);
}
