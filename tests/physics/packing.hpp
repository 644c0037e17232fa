// SPDX-License-Identifier: MIT
// The test that a packing at rest remains at rest.
#pragma once

#include <algorithm>
#include <doctest/doctest.h>
#include <limits>

#include "moreau/measure/energy.hpp"

#include "world/assemblies.hpp"

namespace packing {

using Law = moreau::SignoriniCoulomb<double>;

/// 60 grains fall into a box and come to rest. After that, overlap and kinetic energy are recorded.
/// The largest overlap and the mean energy in the second half of the recorded time must not exceed those in the first
/// half, unless they are below what a packing at rest may have. This is an overlap equal to the
/// slop of the overlap correction, and a velocity caused by the residual: the residual times g h
/// times the number of grains that a contact carries. Not the largest energy: these velocities open gaps of some 1e-8 m, and a grain that
/// bears no load closes such a gap under its weight, in some ten steps. The residual does not bound its speed.
template <class ShapeT>
void check_rests(double duration) {
  constexpr double h = 1e-3, size = 0.02, gravity = 9.81;
  constexpr std::size_t count = 60;
  moreau::ColouredOptions options;
  options.tolerance = 1e-6;
  options.max_sweeps = 10000;
  scenes::BoxOfGrains<ShapeT> box(count, options, 0.5);
  for (int k = 0; k < 1500; ++k) box.simulation.step(h);
  double mass = 0;
  for (const double weight : box.simulation.bodies().grain_mass) mass += weight;
  double overlap[2] = {}, energy[2] = {};
  const int half = int(duration / h / 2);
  int capped = 0;
  for (int k = 0; k < 2 * half; ++k) {
    const moreau::StepReport report = box.simulation.step(h);
    overlap[k / half] = std::max(overlap[k / half], report.max_overlap);
    energy[k / half] += moreau::kinetic_energy(box.simulation).total() / half;
    capped += report.solve.capped;
  }
  const double slop = moreau::OverlapCorrectionOptions{}.slop * size;
  const double velocity = options.tolerance * gravity * h * double(count);
  CHECK(capped == 0);
  // Rounding error of a position [m].
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * 0.1;
  // The overlap is measured before its correction, after the motion of a step.
  CHECK(overlap[1] <= std::max(overlap[0], slop) + velocity * h + rounding);
  CHECK(energy[1] <= std::max(energy[0], mass * velocity * velocity / 2));
}

}  // namespace packing
