// SPDX-License-Identifier: MIT
#pragma once

#include "moreau/core/compiler.hpp"

namespace moreau {

/// How well the contact problem of one step was solved. Always filled. A solver that does not
/// converge is no error.
struct SolveReport {
  int sweeps = 0;         ///< passes over all contacts, those of a first attempt included
  bool converged = true;  ///< the stopping test was met
  /// Not converged: the cap on sweeps was reached before the stopping test was met with
  /// relative_approach <= max_relative_approach, islands are unsolved, or the strengths of bonds may still
  /// change after the last solution of the step.
  bool capped = false;

  /// Natural-map residual || r - P_K(r - (u + mu |u_t| n)) || / || r ||, after scaling so that the
  /// mean of diag W is 1 [-]; under rolling resistance with mu |u_t| + eta |w| in place of mu |u_t|. Absolute if r = 0 [m/s]. The squared
  /// rounding errors of the velocities, (8 epsilon)^2 |u|^2, are subtracted from the squared numerator: they are a lower bound
  /// of it. For contacts that attract the denominator contains the impulse r on the bodies, not the push p = r + h T against the
  /// attraction or the strength of a bond; the rounding of p, 32 epsilon |p|, is subtracted from the numerator, too.
  double residual = 0;
  /// max(natural-map residual, remaining approach velocity) / approach velocity without impulses.
  /// All three are root mean squares over the contacts [-]; 0 if nothing approaches.
  ///
  /// A solve is not converged while it is above max_relative_approach, however small the residual
  /// is. Both differ in two cases: where the problem has no solution and the impulses grow without
  /// bound, and where loads have not yet passed through a long chain of contacts.
  double relative_approach = 0;
  static constexpr double max_relative_approach = 0.1;  ///< bound on relative_approach [-]

  /// The largest error of the velocity of a body in a small island (a set of up to 200 bodies that contacts
  /// connect), as a root mean square over the mass of the body [-]. It is relative to the sum of the velocities that the impulses
  /// of its contacts gave to the body in the step, at most to the largest velocity that impulses gave to a body of its
  /// island. For a structure at rest this is g h. It is
  /// estimated by a direct method, which attempts structures at rest in every step, islands of many contacts
  /// per body in some steps, and colliding grains in few steps. Where the method does not succeed, it is a lower bound.
  /// 0 if no island was attempted: small errors of many contacts then add up unseen.
  double velocity_error = 0;
  int islands = 0;           ///< that the direct method attempted
  int unsolved_islands = 0;  ///< of these, those whose error is above a hundred times
                             ///< ColouredOptions::velocity_tolerance: not converged

  // Measures of the last plain sweep by LMGC90: dv = W (change of r), means over the contacts with
  // r != 0.
  double quad_dv = 0;   ///< sqrt<|dv|^2> / sqrt<|W r|^2> [-]
  double quad_dvr = 0;  ///< sqrt<|dv|^2 |r|^2> / <r . W r> [-]
  double maxm_dv = 0;   ///< quad_dv with the maximum in the numerator [-]
  double maxm_dvr = 0;  ///< quad_dvr with the maximum in the numerator [-]

  double worst_velocity = 0;  ///< largest remaining approach velocity -(u_n + offset) > 0 [m/s]
  double worst_gap = 0;       ///< worst_velocity times the step [m]; set by Simulation
  /// Largest distance of r from the impulses that the law allows, by the law's projection [N s].
  double worst_cone = 0;
  double worst_complementarity = 0;  ///< largest |(u_n + offset) r_n| [J]
  /// Sum of the positive u_t . r_t + w . m, the last term with the couples of rolling laws: energy that they add instead of
  /// dissipating it [J].
  double wrong_sign_dissipation = 0;
};

}  // namespace moreau
