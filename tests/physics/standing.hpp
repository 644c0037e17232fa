// SPDX-License-Identifier: MIT
// What it means that a structure stands.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <vector>

#include "physics/masonry.hpp"
#include "physics/motion.hpp"

namespace masonry {

/// Lets a structure stand. Each step has to be solved to the tolerance, and what moves has to lie
/// within the residual:
///
/// In the natural map a contact strictly inside its cone leaves its velocity alone, so the sticking
/// points slip by |u| <= e := residual x impulse velocity (some g h for one block; a joint that
/// carries n blocks has n times that), together in the 2-norm. Joints of width w then turn by
/// 2 u/w at most. A block that reaches the floor by n joints within a structure of diameter D moves
/// by sum u (1 + 2 D/w) <= e sqrt(n) (1 + 2 D/w). Steps do not add up velocities, so the
/// displacement is the sum of h times that, and the kinetic energy below m/2 of its square.
/// Position moves by the correction of overlaps besides, as far as it reports.
template <class ShapeT, class Solver>
void check_stands(Structure<ShapeT, Solver>& structure, double step, int settle, int count) {
  const double lever =
      std::sqrt(double(structure.joints)) * (1 + 2 * structure.diameter / structure.joint);
  int failed = 0, sweeps = 0, first = 0;
  double residual = 0, allowed = 0, velocity = 0, corrected = 0;
  std::vector<typename Structure<ShapeT, Solver>::Vector> start;
  for (int k = 0; k < settle + count; ++k) {
    if (k == settle) start = structure.vertices();
    const moreau::StepReport report = structure.simulation.step(step);
    failed += !report.solve.converged;
    residual = std::max(residual, report.solve.residual);
    if (k == 0) first = report.solve.sweeps;
    if (k < settle) continue;
    sweeps = std::max(sweeps, report.solve.sweeps);
    velocity = lever * report.solve.residual * structure.impulse_velocity();
    allowed += step * velocity;
    corrected += report.correction.largest_shift;
  }
  double moved = 0;
  const auto end = structure.vertices();
  for (std::size_t i = 0; i < end.size(); ++i) moved = std::max(moved, (end[i] - start[i]).norm());
  INFO("sweeps of the first step " << first << ", later " << sweeps << ", correction "
                                   << corrected);
  CHECK(failed == 0);
  CHECK(residual <= tolerance);
  CHECK(moved <= allowed + corrected);
  CHECK(scenes::kinetic_energy(structure.simulation) <= structure.mass() * velocity * velocity / 2);
}

}  // namespace masonry
