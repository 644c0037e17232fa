// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <doctest/doctest.h>

#include "sanitized.hpp"
#include "world/assemblies.hpp"

namespace scenes {

/// 27 grains fall into a box. Their overlaps stay below 1 % of the grain size, and none leaves the box
/// through the walls at the origin.
template <class ShapeT>
void check_rest() {
  BoxOfGrains<ShapeT> scene(27);
  double overlap = 0;
  for (int k = 0; k < rounds(1500); ++k)
    overlap = std::max(overlap, scene.simulation.step(5e-4f).max_overlap);
  CHECK(overlap < 1e-2 * 0.02);
  for (const BodyId grain : scene.grains)
    CHECK(scene.simulation.pose(grain).position.minCoeff() > 0);
}

}  // namespace scenes
