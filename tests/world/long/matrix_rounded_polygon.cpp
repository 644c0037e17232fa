// SPDX-License-Identifier: MIT
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/rounded.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("rounded polygons under every law", T, double, float) {
  const auto core = scenes::cuboid<moreau::Polygon<T>>({T(0.003), T(0.002)});
  conformance::all_laws(moreau::Rounded<moreau::Polygon<T>>(core, T(0.001)), T(0.0095));
}
