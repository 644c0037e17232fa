// SPDX-License-Identifier: MIT
// What is measured in a run.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "../periods.hpp"
#include "behaviour.hpp"
#include "closed_form.hpp"
#include "facts.hpp"
#include "plan.hpp"
#include "table.hpp"

namespace study {

/// Periods that begin before this time, the first force maximum of the baseline, are left out,
/// because the box is still filling [s]; not in runs that start from a jammed state.
constexpr double filling_time = 0.15;

/// The packing at a maximum of the force.
struct Jam {
  double t, x, rho_inner, rho_box;  ///< [s], [m], [-], [-]
};

/// Results of a run: means over its periods, nan if there is none. SI units.
struct Result {
  Case c;
  Facts facts;
  std::optional<WallClock> clock;  ///< not in the table of the runs
  double mass, wall_mass, length, height;
  double weight;  ///< m g [N]

  std::vector<ratcheting::Period> periods;  ///< that begin jammed, at filling_time or after
  std::vector<Jam> jams;                    ///< that bound these periods: one more than periods
  double dx_max, dx_spread;                 ///< mean, standard deviation over periods [m]
  double v_max;                             ///< mean of the largest inward speeds [m/s]
  double delay;                             ///< delta t_r [s]
  double dx_active, drift, thrust;          ///< see ActivePhase; thrust: f_a [N]
  double steady_thrust, carried_share;      ///< see CarriedGrains; of the weight, of the mass [-]
  double explained;                         ///< [-]
  /// Mean share of a period in which the wall is at rest, |v| below a hundredth of its maximum [-].
  /// It is 0 if the wall never jams. Runs of earlier versions do not have it.
  std::optional<double> rest_share;
  double net_contraction;                ///< (first x_j - last x_j') per period [m]
  std::size_t contracting;               ///< periods with x_j' < x_j
  double rho_initial, rho_0, rho_final;  ///< inner; rho_0 at 0.2 s [-]
  double box_initial, box_final;         ///< of the whole box [-]
  double rate;                           ///< d rho / (rho_0 dt) from jam to jam [1/s]
  double compaction_per_period;          ///< the same per period [-]
  double constant;                       ///< C of row 17, with m + m_w
  Behaviour behaviour;
  std::vector<Point> loop;  ///< see mean_loop(); only where a phase portrait shows it
  /// Columns of the run's own tables, to six digits; only of runs whose course a figure shows: the
  /// baseline's (wall, packing, state, velocity field, force chains) and the long ones'.
  Named<Columns> tables;

  Push push() const;
  /// Relative rate of a solid fraction [1/s] between the first jammed state and the last one in the
  /// first second (at least the second one): the same time window for all frequencies.
  double early_rate(double Jam::*rho) const;
  /// Opening displacement by the closed form, with the thrust and the moving mass that are fitted
  /// to the force on the wall [m].
  double flight_displacement() const;
  double scaled_load() const;  ///< (m g)^2 / ((m + m_w) fmax nu^2) [m]
  /// Whether the jammed wall moves by at most 30 % of the displacement, outward or inward, on average
  /// over the periods; the report uses no other runs for what depends on the excursion.
  bool is_judged() const;
};

inline bool Result::is_judged() const {
  double jammed = 0, moved = 0;  // [m]
  for (const ratcheting::Period& period : periods) {
    jammed += std::abs(period.active.drift);
    moved += std::abs(period.dx_max);
  }
  return !periods.empty() && jammed <= 0.3 * moved;
}

inline double Result::early_rate(double Jam::*rho) const {
  if (jams.size() < 2) return std::nan("");
  std::size_t last = 1;
  while (last + 1 < jams.size() && jams[last + 1].t <= 1 + 1e-9) ++last;
  const Jam &from = jams.front(), &to = jams[last];
  return (to.*rho / from.*rho - 1) / (to.t - from.t);
}

/// Measures a complete run.
/// @throws std::runtime_error if a file of the run cannot be read, or does not have the steps and
///         the duration that run.json gives
Result measure(const std::filesystem::path& folder, const Case& c);

}  // namespace study
