// SPDX-License-Identifier: MIT
// Totals of the solver over a run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include "moreau/world/step_report.hpp"

#include "periods.hpp"

namespace ratcheting {

/// Sums over the reports of all steps under the force.
struct SolverTotals {
  std::size_t steps = 0, capped = 0;
  int most_sweeps = 0;
  double sweeps = 0, residual = 0, worst_residual = 0, pairs = 0, points = 0;
  double max_overlap = 0;         ///< deepest of the run [m]
  double mean_overlap = 0;        ///< mean over steps of the mean depth [m]
  double mean_overlap_first = 0;  ///< the same over the first and over the last tenth of the steps
  double mean_overlap_last = 0;
  double rigid_residual = 0;       ///< sum over steps, of compliant contacts
  double max_elastic_overlap = 0;  ///< of the run [m]
  double gained = 0;               ///< sum of the energies that contacts gave to the grains [J]
  double dissipation = 0;          ///< by the contacts [J]
  double correction_work = 0;      ///< sum of |work| of the overlap correction [J]
  double correction_travel = 0;    ///< sum of |shift| of the moving wall [m]
  double correction_drift = 0;     ///< signed sum of it [m]
  double ms_detect = 0, ms_solve = 0, ms_total = 0;
  std::vector<double> ms_of_step;

  void add(const moreau::StepReport& report, double wall_shift, std::size_t total_steps) {
    ++steps;
    capped += report.solve.capped;
    sweeps += report.solve.sweeps;
    most_sweeps = std::max(most_sweeps, report.solve.sweeps);
    residual += report.solve.residual;
    worst_residual = std::max(worst_residual, report.solve.residual);
    pairs += double(report.pairs);
    points += double(report.points);
    max_overlap = std::max(max_overlap, report.max_overlap);
    mean_overlap += report.mean_overlap;
    const std::size_t tenth = std::max<std::size_t>(1, total_steps / 10);
    if (steps <= tenth) mean_overlap_first += report.mean_overlap / double(tenth);
    if (steps > total_steps - tenth) mean_overlap_last += report.mean_overlap / double(tenth);
    rigid_residual += report.rigid_residual;
    max_elastic_overlap = std::max(max_elastic_overlap, report.max_elastic_overlap);
    gained -= std::min(0.0, report.dissipation);
    dissipation += report.dissipation;
    correction_work += std::abs(report.correction.work);
    correction_travel += std::abs(wall_shift);
    correction_drift += wall_shift;
    ms_detect += report.ms_detect;
    ms_solve += report.ms_solve;
    ms_total += report.ms_total;
    ms_of_step.push_back(report.ms_total);
  }
  auto serialized_members() {  ///< see moreau/core/serialize.hpp
    return std::tie(steps, capped, most_sweeps, sweeps, residual, worst_residual, pairs, points,
                    max_overlap, mean_overlap, mean_overlap_first, mean_overlap_last,
                    rigid_residual, max_elastic_overlap, gained, dissipation, correction_work,
                    correction_travel, correction_drift, ms_detect, ms_solve, ms_total, ms_of_step);
  }
  double mean(double sum) const { return steps > 0 ? sum / double(steps) : 0; }
  double median_ms() const {
    if (ms_of_step.empty()) return 0;
    std::vector<double> sorted = ms_of_step;
    std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2),
                     sorted.end());
    return sorted[sorted.size() / 2];
  }
};

}  // namespace ratcheting
