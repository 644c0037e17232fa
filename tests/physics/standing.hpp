// SPDX-License-Identifier: MIT
// The criterion for a structure that stands.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <vector>

#include "physics/masonry.hpp"
#include "physics/motion.hpp"

namespace masonry {

/// Runs a structure. Every step must converge to the tolerance, and every motion must be within the
/// residual:
///
/// In the natural map a contact strictly inside its cone does not change its velocity. The sticking
/// points therefore slip by |u| <= e := residual x impulse velocity (about g h for one block; a
/// joint that carries n blocks has n times that), together in the 2-norm. Joints of width w then
/// rotate by at most 2 u/w. A block that is connected to the floor by n joints in a structure of
/// diameter D moves by sum u (1 + 2 D/w) <= e sqrt(n) (1 + 2 D/w). Velocities do not accumulate
/// over steps. The displacement is therefore the sum of h times that bound, and the kinetic energy
/// is below m/2 of its square. In addition, positions move by the overlap correction, by as much as
/// it reports.
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
