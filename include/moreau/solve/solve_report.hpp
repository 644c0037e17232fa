// SPDX-License-Identifier: MIT
#pragma once

namespace moreau {

/// How well one step's contact problem was solved. Always filled; not converging is no error.
struct SolveReport {
  int sweeps = 0;         ///< passes over all contacts, those of a first try that failed included
  bool converged = true;  ///< the stopping test was met
  /// Not converged: the cap on sweeps came before the stopping test and `most_left_over` were met.
  bool capped = false;

  /// || r - P_K(r - (u + mu |u_t| n)) || / || r ||, after scaling so that the mean of diag W is 1
  /// [-]. Absolute where r = 0 [m/s].
  double residual = 0;
  /// The same map, or the approach that is left if that is larger, relative to the approach there
  /// would be without impulses; root mean squares over the contacts [-]. Where impulses grow
  /// without bound because there is no solution, or loads are still on their way through a long
  /// chain, the residual is small and this is not: beyond `most_left_over` no solution counts as
  /// converged, and sweeps go on. 0 where nothing approaches.
  double left_over = 0;
  static constexpr double most_left_over = 0.1;  ///< see left_over [-]

  // Of the last plain sweep, dv = W (change of r), means over the contacts with r != 0.
  double quad_dv = 0;   ///< LMGC90: sqrt<|dv|^2> / sqrt<|W r|^2> [-]
  double quad_dvr = 0;  ///< LMGC90: sqrt<|dv|^2 |r|^2> / <r . W r> [-]
  double maxm_dv = 0;   ///< quad_dv with the maximum in the numerator [-]
  double maxm_dvr = 0;  ///< quad_dvr with the maximum in the numerator [-]

  double worst_velocity = 0;  ///< largest -(u_n + offset) > 0 [m/s]: approach left over
  double worst_gap = 0;       ///< what that closes in a step beyond contact [m]; by Simulation
  double worst_cone =
      0;  ///< largest distance of r from what the law allows, by its own projection [N s]
  double worst_complementarity = 0;   ///< largest |(u_n + offset) r_n| [J]
  double wrong_sign_dissipation = 0;  ///< sum of positive u_t . r_t: friction that drives [J]
};

}  // namespace moreau
