// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "moreau/contact/contact.hpp"
#include "moreau/solve/report.hpp"
#include "moreau/world/overlap_correction.hpp"

namespace moreau {

/// What one step did. Lengths in metres, energies in joules, times in milliseconds.
struct StepReport {
  std::size_t candidate_pairs = 0;     ///< pairs of boxes that were looked at, without the walls
  std::size_t pairs = 0;               ///< pairs with at least one contact point
  std::size_t points = 0;              ///< contact points
  std::size_t warm_started = 0;        ///< points that found their impulse of the step before
  double max_overlap = 0;              ///< deepest point as detected, >= 0
  double mean_overlap = 0;             ///< mean depth of the points with gap < 0
  double dissipation = 0;              ///< energy that the contact impulses and couples took out
  double friction = 0;                 ///< of it, what the tangential impulses took
  double rolling = 0;                  ///< of it, what couples of rolling and twisting took
  SolveReport solve;                   ///< how well the contact problem was solved
  OverlapCorrectionReport correction;  ///< what the overlap correction did
  double ms_detect = 0;                ///< prediction and detection
  double ms_solve = 0;                 ///< contact problem, with assembly and correction
  double ms_total = 0;                 ///< the whole step

  /// Adds the contacts' overlaps to a report that has none.
  template <class S>
  void measure_overlaps(const Contacts<S>& contacts) {
    std::size_t overlapping = 0;
    for (const Contact<S>& contact : contacts.points) {
      if (!(contact.gap < 0)) continue;
      max_overlap = std::max(max_overlap, -double(contact.gap));
      mean_overlap -= double(contact.gap);
      ++overlapping;
    }
    if (overlapping > 0) mean_overlap /= double(overlapping);
  }
};

}  // namespace moreau
