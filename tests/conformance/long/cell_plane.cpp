// SPDX-License-Identifier: MIT
// Every shape of the plane in a periodic cell that deforms: rigid, wet, and with bonds on springs.
#include "moreau/law/bonded.hpp"
#include "moreau/law/bridges.hpp"
#include "moreau/law/compliant.hpp"
#include "moreau/law/rolling_resistance.hpp"

#include "conformance/cell.hpp"
#include "matrix/shapes.hpp"

namespace {

using S = moreau::Space<2>;
using Sharp = moreau::Polygon<>;
using Water = moreau::CapillaryBridge<>;
using Rolling = moreau::RollingResistance<>;

constexpr auto in_cell = [](const auto& shapes, double size) {
  const moreau::Bonded<> bonds({2, 1.5, 1}, 0.4, 0.1);
  conformance::cell(shapes, moreau::SignoriniCoulomb<>(0.4), size, 4);
  conformance::cell(shapes, moreau::Bridged<Water, Rolling>(Water(1e-12), Rolling(0.4, 0.1)), size,
                    4);
  conformance::cell(shapes, moreau::Compliant<moreau::Bonded<>>(bonds, 1e6, 5e5), size, 4);
};

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
