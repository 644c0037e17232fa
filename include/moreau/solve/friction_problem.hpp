// SPDX-License-Identifier: MIT
// A frictional contact problem given by its matrices, without bodies, as other codes write it to
// files. For each contact, normal first,
//
//     u = W r + b,        Signorini's condition and Coulomb's law between u and r.
//
// W may be any matrix: positive semi-definite in theory, of low rank if there are many contacts,
// slightly asymmetric if another code assembled it so.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/law/signorini_coulomb.hpp"

namespace moreau {

/// A problem of n contacts; the head of this file has its equations.
/// @tparam S the space; D numbers per contact, in its own frame, normal first
template <class S>
struct FrictionProblem {
  using Space = S;
  using Vector = typename S::Vector;

  Eigen::SparseMatrix<double, Eigen::RowMajor> delassus;  ///< W, D n x D n [1/kg]
  Eigen::VectorXd free_velocity;  ///< b, D n: relative velocities without impulses [m/s]
  Eigen::VectorXd friction;       ///< mu, n [-]

  /// Number of contacts.
  Eigen::Index size() const { return friction.size(); }
};

/// Checks the sizes and the numbers of a problem.
/// @param function the public name that the exception gives
/// @throws std::invalid_argument if W is not D n x D n, sizes differ, a number is not finite, a
///         friction is negative, or a diagonal entry of W is negative
template <class S>
void require_valid(const FrictionProblem<S>& problem, std::string_view function) {
  const auto& w = problem.delassus;
  const Eigen::Index rows = S::dim * problem.size();
  require(w.rows() == rows, function, "W.rows()", w.rows(), "must be D times the contacts");
  require(w.cols() == rows, function, "W.cols()", w.cols(), "must be D times the contacts");
  require(problem.free_velocity.size() == rows, function, "q.size()", problem.free_velocity.size(),
          "must be D times the contacts");
  for (Eigen::Index row = 0; row < rows; ++row) {
    const double q = problem.free_velocity[row];
    if (!std::isfinite(q))
      throw_invalid(function, "q[" + std::to_string(row) + "]", q, "must be finite");
    for (typename std::decay_t<decltype(w)>::InnerIterator entry(w, row); entry; ++entry)
      if (!(std::isfinite(entry.value()) && (entry.col() != row || entry.value() >= 0)))
        throw_invalid(function,
                      "W(" + std::to_string(row) + ", " + std::to_string(entry.col()) + ")",
                      entry.value(), "must be finite, and >= 0 on the diagonal");
  }
  for (Eigen::Index c = 0; c < problem.size(); ++c) {
    const double mu = problem.friction[c];
    if (!(std::isfinite(mu) && mu >= 0))
      throw_invalid(function, "mu[" + std::to_string(c) + "]", mu, "must be finite and >= 0");
  }
}

/// Mean of the diagonal of W [1/kg], or 1 if that is 0. W is divided and r multiplied by it, so
/// that r has the unit of u.
template <class S>
double delassus_scale(const FrictionProblem<S>& problem) {
  if (problem.size() == 0) return 1;
  const double mean = problem.delassus.diagonal().mean();
  return mean > 0 ? mean : 1;
}

namespace detail {

/// The natural map || r - P_K(r - (u + mu |u_t| n)) || and the norms that it is compared with, all
/// in one unit.
struct MapError {
  double map, velocity, impulse;  ///< the map, max(|b|, |u|), |r|
  double closing;                 ///< | min(0, u_n) |

  double residual() const { return relative(std::max(velocity, impulse)); }
  /// max(residual, factor times the map relative to the velocities, factor times the remaining
  /// approach velocity). Without the second, impulses that grow without bound because there is no
  /// solution would look like a solution. Without the third, no impulse would look like one if mu
  /// is large: the map of an approach with slip is then 1/mu of the approach.
  double guarded(double factor) const {
    return std::max(residual(), factor * std::max(relative(velocity), share(closing, velocity)));
  }
  double relative(double norm) const { return share(map, norm); }
  /// part / norm, or part if the norm is 0; infinite if a value is not finite.
  static double share(double part, double norm) {
    const double e = norm > 0 ? part / norm : part;
    return e >= 0 && std::isfinite(norm) ? e : std::numeric_limits<double>::infinity();
  }
};

template <class S>
MapError map_error(const Eigen::VectorXd& u, const Eigen::VectorXd& r, const Eigen::VectorXd& b,
                   const Eigen::VectorXd& friction) {
  double map = 0, closing = 0;
  for (Eigen::Index c = 0; c < friction.size(); ++c) {
    const SignoriniCoulomb<double> law(friction[c]);
    const typename S::Vector u_c = u.template segment<S::dim>(S::dim * c);
    const typename S::Vector r_c = r.template segment<S::dim>(S::dim * c);
    map += law.natural_map(u_c, r_c).squaredNorm();
    const double left = std::min(0.0, u_c[0]);
    closing += left * left;
  }
  return {std::sqrt(map), std::max(b.norm(), u.norm()), r.norm(), std::sqrt(closing)};
}

}  // namespace detail

/// The residual of a solution: that of the natural map, with u = W r + b, after scaling W and r so
/// that the mean of diag W is 1, relative to max(|b|, |r|, |u|) [-]. Infinite if it is not a
/// number. See SignoriniCoulomb::natural_map for the map.
/// @param problem  must be valid, which is not checked; see require_valid()
/// @param impulses D n, in the units of the problem [N s]
/// @throws std::invalid_argument for impulses of another size
template <class S>
double natural_map_residual(const FrictionProblem<S>& problem, const Eigen::VectorXd& impulses) {
  require(impulses.size() == problem.free_velocity.size(), "natural_map_residual",
          "impulses.size()", impulses.size(), "must be D times the contacts");
  const Eigen::VectorXd u = problem.delassus * impulses + problem.free_velocity;
  return detail::map_error<S>(u, delassus_scale(problem) * impulses, problem.free_velocity,
                              problem.friction)
      .residual();
}

}  // namespace moreau
