// SPDX-License-Identifier: MIT
// Every shape of the plane in a periodic cell that deforms: rigid, wet, and with bonds on springs.
#include "conformance/cell_laws.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<2>;
using Sharp = moreau::Polygon<>;
using conformance::in_cell;

}  // namespace

TEST_CASE("cell of the plane: disks") {
  matrix::balls<S>(in_cell);
}
TEST_CASE("cell of the plane: stadiums") {
  matrix::capsules<S>(in_cell);
}
TEST_CASE("cell of the plane: polygons") {
  matrix::polytopes<Sharp>(in_cell);
}
TEST_CASE("cell of the plane: rounded polygons") {
  matrix::rounded<Sharp>(in_cell);
}
TEST_CASE("cell of the plane: disks, polygons and stadiums") {
  matrix::mixtures<Sharp>(in_cell);
}
TEST_CASE("cell of the plane: polygons with sharp and rounded corners") {
  matrix::sharp_and_rounded<Sharp>(in_cell);
}
TEST_CASE("cell of the plane: a shape known by its farthest points") {
  matrix::support_only<S>(in_cell);
}
TEST_CASE("cell of the plane: concave ballast") {
  matrix::ballast<Sharp>(in_cell);
}
TEST_CASE("cell of the plane: dumbbells") {
  matrix::dumbbells<S>(in_cell);
}
