// SPDX-License-Identifier: MIT
#include "moreau/shape/polyhedron.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("polyhedra under every law", T, double, float) {
  using Shape = moreau::Polyhedron<T>;
  conformance::all_laws(scenes::cuboid<Shape>({T(0.003), T(0.0025), T(0.002)}), T(0.009));
}
