// SPDX-License-Identifier: MIT
// The criterion that a structure stands.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <vector>

#include "moreau/measure/energy.hpp"

#include "physics/masonry.hpp"

namespace masonry {

/// Simulates a structure. Every step must converge to the tolerance, and the motion must not exceed
/// the motion that the residual can cause. The bound of this motion is derived as follows.
///
/// In the natural map, a contact strictly inside its friction cone does not change its velocity. So
/// the slip velocities u of the sticking points satisfy |u| <= e (2-norm over all points), with e =
/// residual x impulse velocity. (The impulse velocity is about g h for one block; at a joint that
/// carries n blocks it is n times that.) Joints of width w rotate by at most 2 u/w. A block that is
/// connected to the floor by n joints, in a structure of diameter D, moves with at most sum u (1 +
/// 2 D/w) <= e sqrt(n) (1 + 2 D/w). Velocities do not accumulate over steps. So the displacement is
/// at most the sum of h times this velocity. Gaps that the error of a step has opened close in the next one, so that
/// the kinetic energy is at most m/2 times the square of the sum of the velocities of both. In addition, the overlap
/// correction displaces blocks by the amount that it reports.
template <class ShapeT, class Solver>
void check_stands(Structure<ShapeT, Solver>& structure, double step, int settle, int count) {
  const double lever =
      std::sqrt(double(structure.joints)) * (1 + 2 * structure.diameter / structure.joint);
  int failed = 0, sweeps = 0, first = 0;
  double residual = 0, allowed = 0, velocity = 0, corrected = 0, energy = 0;
  std::vector<typename Structure<ShapeT, Solver>::Vector> start;
  for (int k = 0; k < settle + count; ++k) {
    if (k == settle) start = structure.vertices();
    const moreau::StepReport report = structure.simulation.step(step);
    failed += !report.solve.converged;
    residual = std::max(residual, report.solve.residual);
    if (k == 0) first = report.solve.sweeps;
    if (k < settle) continue;
    sweeps = std::max(sweeps, report.solve.sweeps);
    const double before = velocity;
    velocity = lever * report.solve.residual * structure.impulse_velocity();
    allowed += step * velocity;
    const double most = structure.mass() * (before + velocity) * (before + velocity) / 2;
    if (k > settle)
      energy = std::max(energy, moreau::kinetic_energy(structure.simulation).total() / most);
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
  CHECK(energy <= 1);
}

/// Simulates a structure with the default options. No block may move by 1 % of the width of a joint. After the step in
/// which the load arrives, at most a hundredth of the steps may be unsolved; where a step converged, the error of the
/// velocities is within its tolerance.
template <class ShapeT>
void check_stands_by_default(Structure<ShapeT> structure, double step, int count) {
  using Scalar = typename Structure<ShapeT>::Scalar;
  const moreau::ColouredOptions options;
  structure.simulation.set_solver(moreau::ColouredGaussSeidel(options));
  const auto start = structure.vertices();
  int islands = 0, unsolved = 0;
  double error = 0;
  for (int k = 0; k < count; ++k) {
    const moreau::SolveReport report = structure.simulation.step(Scalar(step)).solve;
    CHECK(report.converged == !report.capped);
    islands = std::max(islands, report.islands);
    unsolved += !report.converged;
    if (report.converged) error = std::max(error, report.velocity_error);
  }
  double moved = 0;
  const auto end = structure.vertices();
  for (std::size_t i = 0; i < end.size(); ++i)
    moved = std::max(moved, double((end[i] - start[i]).norm()));
  CAPTURE(step);
  CAPTURE(structure.simulation.grain_count());
  CHECK(islands == 1);
  CHECK(unsolved <= 2 + count / 100);
  CHECK(error <= 100 * options.velocity_tolerance);
  CHECK(moved < 0.01 * structure.joint);
}

/// Simulates a structure at rest with the default options. Where a step converged, no block moves much faster than
/// SolveReport::velocity_error says: also where a light block under a heavy one shows little of the error.
template <class ShapeT>
void check_reported_errors(Structure<ShapeT> structure, double step, int count) {
  using S = typename Structure<ShapeT>::S;
  auto& simulation = structure.simulation;
  simulation.set_solver(moreau::ColouredGaussSeidel());
  double largest = 0;  // velocity over what is allowed
  for (int k = 0; k < count; ++k) {
    const moreau::SolveReport report = simulation.step(step).solve;
    if (!report.converged) break;  // blocks that have moved apart fall
    const double allowed = gravity * step * std::max(1e-6, 30 * report.velocity_error);
    for (std::size_t i = 0; i < simulation.grain_count(); ++i) {
      const auto& twist = simulation.bodies().velocity[simulation.grain(i).index()];
      largest = std::max(largest, twist.template head<S::dim>().norm() / allowed);
    }
  }
  CHECK(largest <= 1);
}

}  // namespace masonry
