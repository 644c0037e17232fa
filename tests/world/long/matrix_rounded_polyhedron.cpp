// SPDX-License-Identifier: MIT
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/rounded.hpp"

#include "conformance/matrix.hpp"
#include "world/assemblies.hpp"

TEST_CASE_TEMPLATE("rounded polyhedra under every law", T, double, float) {
  const auto core = scenes::cuboid<moreau::Polyhedron<T>>({T(0.0025), T(0.002), T(0.0015)});
  conformance::all_laws(moreau::Rounded<moreau::Polyhedron<T>>(core, T(0.001)), T(0.0095));
}
