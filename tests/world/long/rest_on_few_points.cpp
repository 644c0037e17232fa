// SPDX-License-Identifier: MIT
// A grain that stands on more than three points also rests if each pair keeps at most three contact
// points: it neither rocks about the sides of its triangle nor drifts.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/sample/ballast.hpp"

#include "world/assemblies.hpp"

TEST_CASE("nine polyhedra on a floor come to rest") {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    moreau::ColouredOptions options;
    options.tolerance = 1e-8;
    scenes::BoxOfGrains<moreau::Polyhedron<>> scene(9, options, 0.4, seed);
    double spin = 0;
    for (int k = 0; k < 3000; ++k) {
      scene.simulation.step(1e-3);
      if (k < 2500) continue;
      for (const auto grain : scene.grains)
        spin = std::max(spin, scene.simulation.bodies().velocity[grain.index()].tail<3>().norm());
    }
    CHECK(spin < 1e-6);
  }
}
