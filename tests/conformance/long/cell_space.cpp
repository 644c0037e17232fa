// SPDX-License-Identifier: MIT
// Every shape of space in a periodic cell that deforms: rigid, wet, and with bonds on springs.
#include "conformance/cell_laws.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<3>;
using Sharp = moreau::Polyhedron<>;
using conformance::in_cell;

}  // namespace

TEST_CASE("cell of the space: spheres") {
  matrix::balls<S>(in_cell);
}
TEST_CASE("cell of the space: capsules") {
  matrix::capsules<S>(in_cell);
}
TEST_CASE("cell of the space: polyhedra") {
  matrix::polytopes<Sharp>(in_cell);
}
TEST_CASE("cell of the space: rounded polyhedra") {
  matrix::rounded<Sharp>(in_cell);
}
TEST_CASE("cell of the space: spheres, polyhedra and capsules") {
  matrix::mixtures<Sharp>(in_cell);
}
TEST_CASE("cell of the space: polyhedra with sharp and rounded corners") {
  matrix::sharp_and_rounded<Sharp>(in_cell);
}
TEST_CASE("cell of the space: a shape known by its farthest points") {
  matrix::support_only<S>(in_cell);
}
TEST_CASE("cell of the space: concave ballast") {
  matrix::ballast<Sharp>(in_cell);
}
TEST_CASE("cell of the space: dumbbells") {
  matrix::dumbbells<S>(in_cell);
}
