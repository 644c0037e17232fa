// SPDX-License-Identifier: MIT
// The impulse of a contact with couples as a function of its velocity, for the direct method (solve/island_newton.hpp):
// the cone of RollingResistance is
//
//     K = { |r_t| <= mu r_n, |m| <= eta r_n },      K* = { u_n >= mu |u_t| + eta |w| },
//
// with m = couple / R and w = R spin (law/rolling_block.hpp). It has two discs in place of the one of Coulomb's cone.
// Slip and rotation give the lift sigma = mu |u_t| + eta |w|.
//
// With the diagonal compliance s, equal for all tangents and for all couples, the impulse with K* containing s r + b,
// perpendicular to r, has r_t = -b_t / s_t and m = -b_m / s_m inside of their discs, and otherwise lies on the rim. r_n is
// the zero of a rising function that is linear in pieces,
//
//     s_n r_n + b_n - mu max(0, |b_t| - s_t mu r_n) - eta max(0, |b_m| - s_m eta r_n),
//
// which is the smallest of four: each of the two limits may bind or not. So r_n is the largest of their zeros.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "moreau/solve/detail/island_points.hpp"

namespace moreau::detail {

/// The norm of the rows of a vector from first to last - 1.
double length_between(const auto& rows, int first, int last) {
  double square = 0;
  for (int k = first; k < last; ++k) square += rows[k] * rows[k];
  return std::sqrt(square);
}
/// |u_t| and |w| of the rows of a contact with couples, or |r_t| and |m|.
template <class S>
double couple_of(const auto& rows) {
  return length_between(rows, S::dim, S::dofs);
}

/// Whether couple_response() has no impulse: b is in K*.
template <class S>
bool is_open(double mu, double eta, const Eigen::Matrix<double, S::dofs, 1>& b) {
  return b[0] >= 0 && mu * length_between(b, 1, S::dim) + eta * couple_of<S>(b) <= b[0];
}

/// Adds to a response the rows of a disc with a given radius: those of -b / s, or on the rim.
/// @param answer in, out: rows from first to last - 1 of the impulse, and their block of the stiffness
/// @param s      compliance of these rows [1/kg]
/// @param limit  radius of the disc [N s]
/// @returns whether the impulse is on the rim
template <int Rows>
bool add_disc(ContactResponse<Rows>& answer, int first, int last, double s,
              const Eigen::Matrix<double, Rows, 1>& b, double limit) {
  const double load = length_between(b, first, last);
  const bool binds = !(load < limit * s);
  const double share = binds ? (load > 0 ? limit / load : 0) : 1 / s;
  for (int k = first; k < last; ++k) {
    answer.impulse[k] = -share * b[k];
    answer.stiffness(k, k) += share;
    if (binds && load > 0)
      for (int l = first; l < last; ++l)
        answer.stiffness(k, l) -= share * (b[k] / load) * (b[l] / load);
  }
  return binds;
}

/// The impulse in K with K* containing s r + b, perpendicular to r, and its derivative; the head of this file has the
/// equations.
/// @param mu,eta coefficients of friction and of rolling resistance [-]
/// @param s      diagonal of the compliance, > 0 [1/kg]
/// @param b      (velocity, R spin) without the impulse, with the lift [m/s]
template <class S>
ContactResponse<S::dofs> couple_response(double mu, double eta,
                                         const Eigen::Matrix<double, S::dofs, 1>& s,
                                         const Eigen::Matrix<double, S::dofs, 1>& b) {
  ContactResponse<S::dofs> answer;
  answer.impulse.setZero();
  answer.stiffness.setZero();
  const double slide = length_between(b, 1, S::dim), roll = couple_of<S>(b);
  const double s_t = s[1], s_m = s[S::dim];
  double normal = 0;
  for (const double a : {0.0, mu})
    for (const double e : {0.0, eta})
      normal = std::max(normal, (a * slide + e * roll - b[0]) / (s[0] + a * a * s_t + e * e * s_m));
  if (!(normal > 0)) return answer;
  const bool slides = add_disc(answer, 1, S::dim, s_t, b, mu * normal),
             rolls = add_disc(answer, S::dim, S::dofs, s_m, b, eta * normal);
  // The change of r by that of r_n.
  Eigen::Matrix<double, S::dofs, 1> along = Eigen::Matrix<double, S::dofs, 1>::Zero();
  along[0] = 1;
  for (int k = 1; k < S::dofs; ++k)
    if (k < S::dim ? slides : rolls) along[k] = answer.impulse[k] / normal;
  const double by = 1 / (s[0] + (slides ? mu * mu * s_t : 0) + (rolls ? eta * eta * s_m : 0));
  for (int k = 0; k < S::dofs; ++k)
    for (int l = 0; l < S::dofs; ++l) answer.stiffness(k, l) += by * along[k] * along[l];
  answer.impulse[0] = normal;
  return answer;
}

/// The response of a contact with couples whose friction and couple have given limits.
/// @param limit,roll_limit of |r_t| and |m| [N s]
/// @param s compliances in series [1/kg]
/// @param b (velocity, R spin) without an impulse [m/s]
template <class S>
ContactResponse<S::dofs> couple_response_within(double limit, double roll_limit,
                                                const Eigen::Matrix<double, S::dofs, 1>& s,
                                                const Eigen::Matrix<double, S::dofs, 1>& b) {
  ContactResponse<S::dofs> answer;
  answer.impulse.setZero();
  answer.stiffness.setZero();
  if (b[0] < 0) {
    answer.impulse[0] = -b[0] / s[0];
    answer.stiffness(0, 0) = 1 / s[0];
  }
  add_disc(answer, 1, S::dim, s[1], b, limit);
  add_disc(answer, S::dim, S::dofs, s[S::dim], b, roll_limit);
  return answer;
}

}  // namespace moreau::detail
