// SPDX-License-Identifier: MIT
#include "conformance/matrix.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<3, float>;
using Sharp = moreau::Polyhedron<float>;

constexpr auto all_laws = [](const auto& shapes, S::Scalar size) {
  conformance::laws_of_pushes(shapes, size);
};

}  // namespace

TEST_CASE("space, float: spheres under laws without attraction") {
  matrix::balls<S>(all_laws);
}
TEST_CASE("space, float: capsules under laws without attraction") {
  matrix::capsules<S>(all_laws);
}
TEST_CASE("space, float: polyhedra under laws without attraction") {
  matrix::polytopes<Sharp>(all_laws);
}
TEST_CASE("space, float: rounded polyhedra under laws without attraction") {
  matrix::rounded<Sharp>(all_laws);
}
TEST_CASE("space, float: spheres, polyhedra and capsules under laws without attraction") {
  matrix::mixtures<Sharp>(all_laws);
}
TEST_CASE("space, float: polyhedra with sharp and rounded corners under laws without attraction") {
  matrix::sharp_and_rounded<Sharp>(all_laws);
}
TEST_CASE("space, float: a shape known by its farthest points under laws without attraction") {
  matrix::support_only<S>(all_laws);
}
TEST_CASE("space, float: concave ballast under laws without attraction") {
  matrix::ballast<Sharp>(all_laws);
}
TEST_CASE("space, float: dumbbells under laws without attraction") {
  matrix::dumbbells<S>(all_laws);
}
