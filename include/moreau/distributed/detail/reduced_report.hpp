// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "moreau/distributed/communicator.hpp"
#include "moreau/world/step_report.hpp"

namespace moreau::detail {

/// Makes the report of each process that of all together. The report of the solver is so already.
/// @param report deepest_a and deepest_b are indices in the whole simulation
inline void reduce(StepReport& report, Communicator& processes) {
  std::size_t* const counts[] = {
      &report.candidate_pairs,    &report.pairs,       &report.points,
      &report.warm_started,       &report.overlapping, &report.correction.corrected,
      &report.correction.limited, &report.bonds,       &report.broken_bonds};
  double* const sums[] = {&report.dissipation,    &report.friction,     &report.rolling,
                          &report.elastic_energy, &report.elastic_work, &report.correction.work,
                          &report.fracture};
  double* const extremes[] = {&report.approach,
                              &report.max_overlap,
                              &report.max_elastic_overlap,
                              &report.correction.largest_shift,
                              &report.ms_detect,
                              &report.ms_solve,
                              &report.ms_total,
                              &report.ms_place,
                              &report.ms_pairs,
                              &report.ms_collide,
                              &report.ms_assemble,
                              &report.ms_correct,
                              &report.ms_contacts};
  // The smallest relative compliance is the inverse of the largest relative stiffness.
  const auto inverse = [](double x) { return x > 0 ? 1 / x : 0; };
  double depth = report.mean_overlap * double(report.overlapping);
  double largest[std::size(extremes) + 1];
  // The deepest point of each process, in numbers of its own: depth, first and second body.
  constexpr std::size_t numbers = std::size(counts) + std::size(sums) + 1;
  std::vector<double> added(numbers + 3 * std::size_t(processes.size()), 0);
  double* const deepest = added.data() + numbers;
  double* const own = deepest + 3 * std::size_t(processes.rank());
  own[0] = report.max_overlap, own[1] = report.deepest_a, own[2] = report.deepest_b;
  double* next = added.data();
  for (const std::size_t* count : counts) *next++ = double(*count);
  for (const double* sum : sums) *next++ = *sum;
  *next = depth;
  next = largest;
  for (const double* extreme : extremes) *next++ = *extreme;
  *next = inverse(report.relative_compliance);
  processes.sum(std::span(added));
  processes.largest(std::span(largest));
  next = added.data();
  for (std::size_t* count : counts) *count = std::size_t(*next++);
  for (double* sum : sums) *sum = *next++;
  depth = *next;
  report.mean_overlap = report.overlapping > 0 ? depth / double(report.overlapping) : 0;
  next = largest;
  for (double* extreme : extremes) *extreme = *next++;
  report.relative_compliance = inverse(*next);
  // Of points of the same depth that of the smallest bodies, as in one process.
  std::array<double, 3> first{};  // minus the depth, both bodies
  for (int k = 0; k < processes.size(); ++k)
    first = std::min(first, {-deepest[3 * k], deepest[3 * k + 1], deepest[3 * k + 2]});
  report.deepest_a = std::uint32_t(first[1]);
  report.deepest_b = std::uint32_t(first[2]);
}

}  // namespace moreau::detail
