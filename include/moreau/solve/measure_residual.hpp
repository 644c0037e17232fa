// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "moreau/law/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau {

namespace detail {

/// The mean of the diagonal of W, which makes velocities of impulses in residuals [1/kg]; 1 if it is
/// not positive.
template <class Operator>
double mean_diagonal(const Operator& op) {
  constexpr int rows = Operator::Vector::RowsAtCompileTime;
  double trace = 0;
  for (std::size_t c = 0; c < op.size(); ++c) trace += double(op.block(c).trace());
  return trace > 0 ? trace / (double(op.size()) * rows) : 1;
}

}  // namespace detail

/// How far impulses and velocities are from solving the contact problem: the natural-map residual
/// and the separate violations of the laws, in one pass over all contacts.
/// @param problem  its operator carries the velocities of the impulses
/// @param impulses one per contact, in its frame, normal first [N s]
/// @param report   out: residual, relative_approach, worst_velocity, worst_cone,
///                 worst_complementarity, wrong_sign_dissipation. The first two are infinite if
///                 velocities or impulses are not finite. Its other fields are not changed
template <class Operator, class Law>
void measure_residual(const ContactProblem<Operator, Law>& problem,
                      std::span<const typename Operator::Vector> impulses, SolveReport& report) {
  using Vector = typename Operator::Vector;
  const Operator& op = problem.delassus;
  double map = 0, norm = 0, approach = 0, closing = 0;
  report.worst_velocity = report.worst_cone = report.worst_complementarity = 0;
  report.wrong_sign_dissipation = 0;
  const Vector still = Vector::Zero();
  const double scale = detail::mean_diagonal(op);
  for (std::size_t c = 0; c < op.size(); ++c) {
    const Vector& r = impulses[c];
    const double free = std::min(0.0, double(op.free_velocity(c)[0]));
    approach += free * free;
    if (r[0] == 0 && op.normal_velocity(c) >= 0) continue;
    const Vector u = op.velocity(c);
    if (std::isinf(u[0]) && u[0] > 0) continue;  // cannot act in this step
    const auto to_velocity = static_cast<typename Operator::Scalar>(scale);
    const Vector scaled = r * to_velocity;
    const double left = std::min(0.0, double(u[0]));
    closing += left * left;
    map += double(detail::natural_map(problem.law(c), u, scaled, to_velocity).squaredNorm());
    norm += double(scaled.squaredNorm());
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    const double power = double(u.template tail<tangents>().dot(r.template tail<tangents>()));
    report.worst_velocity = std::max(report.worst_velocity, -double(u[0]));
    report.worst_complementarity =
        std::max(report.worst_complementarity, std::abs(double(u[0] * r[0])));
    report.wrong_sign_dissipation += std::max(0.0, power);
    report.worst_cone =
        std::max(report.worst_cone, double(problem.law(c).natural_map(still, r).norm()));
  }
  report.residual = norm > 0 ? std::sqrt(map / norm) : std::sqrt(map);
  // The map has the rounding of r at least: impulses so large that the velocities vanish in it show
  // nothing else. Beside the map stands the approach velocity, because with large mu the map of an
  // approach with slip and without impulse is only 1/mu of the approach.
  const double rounding = double(std::numeric_limits<typename Operator::Scalar>::epsilon());
  const double remaining = std::max(map + rounding * rounding * norm, closing);
  report.relative_approach = approach > 0 ? std::sqrt(remaining / approach) : 0;
  if (std::isfinite(map) && std::isfinite(norm)) return;
  report.residual = report.relative_approach = std::numeric_limits<double>::infinity();
}

}  // namespace moreau
