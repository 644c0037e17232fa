// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "moreau/solve/shared_bodies.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau::detail {

/// Changes by one plain sweep in the measures of LMGC90: dv = W (r_new - r_old) of each contact,
/// sums and maxima over the contacts with r != 0.
struct SweepChange {
  double acting = 0;   ///< contacts with r != 0
  double dv2 = 0;      ///< sum |dv|^2
  double dvr2 = 0;     ///< sum |dv|^2 |r|^2
  double max_dv2 = 0;  ///< largest |dv|^2
  double max_dvr2 = 0;
  double wr2 = 0;  ///< sum |W r|^2
  double rwr = 0;  ///< sum r . W r

  /// Adds a contact if its r != 0. All arguments but work are squared norms.
  /// @param change2 |dv|^2
  /// @param own2    |r|^2
  /// @param pushed2 |W r|^2
  /// @param work    r . W r
  void add(double change2, double own2, double pushed2, double work) {
    if (!(own2 > 0)) return;
    ++acting;
    dv2 += change2;
    dvr2 += change2 * own2;
    max_dv2 = std::max(max_dv2, change2);
    max_dvr2 = std::max(max_dvr2, change2 * own2);
    wr2 += pushed2;
    rwr += work;
  }

  void add(const SweepChange& other) {
    acting += other.acting;
    dv2 += other.dv2;
    dvr2 += other.dvr2;
    max_dv2 = std::max(max_dv2, other.max_dv2);
    max_dvr2 = std::max(max_dvr2, other.max_dvr2);
    wr2 += other.wr2;
    rwr += other.rwr;
  }

  /// Makes the measures those of all processes.
  void add_up(SharedBodies& shared) {
    double sums[] = {acting, dv2, dvr2, wr2, rwr}, extremes[] = {max_dv2, max_dvr2};
    shared.sum(sums);
    shared.largest(extremes);
    acting = sums[0], dv2 = sums[1], dvr2 = sums[2], wr2 = sums[3], rwr = sums[4];
    max_dv2 = extremes[0], max_dvr2 = extremes[1];
  }

  void write(SolveReport& report) const {
    report.quad_dv = report.quad_dvr = report.maxm_dv = report.maxm_dvr = 0;
    if (acting == 0) return;
    report.quad_dv = std::sqrt(dv2 / wr2);
    report.quad_dvr = std::sqrt(dvr2 / acting) / (rwr / acting);
    report.maxm_dv = std::sqrt(max_dv2 / (wr2 / acting));
    report.maxm_dvr = std::sqrt(max_dvr2) / (rwr / acting);
  }
};

}  // namespace moreau::detail
