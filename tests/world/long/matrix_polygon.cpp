// SPDX-License-Identifier: MIT
#include "moreau/shape/polygon.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("polygons under every law", T, double, float) {
  using Shape = moreau::Polygon<T>;
  conformance::all_laws(scenes::cuboid<Shape>({T(0.004), T(0.0025)}), T(0.01));
}
