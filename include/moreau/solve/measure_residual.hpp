// SPDX-License-Identifier: MIT
// How far impulses and velocities are from solving the contact problem.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/law/concepts.hpp"
#include "moreau/solve/solve_report.hpp"

namespace moreau {

/// One pass over all contacts: the natural-map residual and the separate violations of the law.
/// Fills residual, worst_* and wrong_sign_dissipation of the report.
/// @param op       the operator, carrying the velocities that the impulses make
/// @param laws     the table of laws
/// @param law_of   one per contact: its entry in the table
/// @param impulses one per contact, in its frame, normal first [N s]
/// @param report   the rest of it stays, worst_gap among it; residual and left_over are infinite
///                 where velocities or impulses are not finite
template <class Operator, class Law>
void measure_residual(const Operator& op, std::span<const Law> laws,
                      std::span<const std::uint32_t> law_of,
                      std::span<const typename Operator::Vector> impulses, SolveReport& report) {
  using Vector = typename Operator::Vector;
  double trace = 0, map = 0, norm = 0, approach = 0, closing = 0;
  report.worst_velocity = report.worst_cone = report.worst_complementarity = 0;
  report.wrong_sign_dissipation = 0;
  for (std::size_t c = 0; c < op.size(); ++c) trace += double(op.block(c).trace());
  constexpr int rows = Vector::RowsAtCompileTime;
  const Vector still = Vector::Zero();
  const double entries = double(op.size()) * rows;
  const double scale = trace > 0 ? trace / entries : 1;
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
    map += double(detail::natural_map(laws[law_of[c]], u, scaled, to_velocity).squaredNorm());
    norm += double(scaled.squaredNorm());
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    const double power = double(u.template tail<tangents>().dot(r.template tail<tangents>()));
    report.worst_velocity = std::max(report.worst_velocity, -double(u[0]));
    report.worst_complementarity =
        std::max(report.worst_complementarity, std::abs(double(u[0] * r[0])));
    report.wrong_sign_dissipation += std::max(0.0, power);
    report.worst_cone =
        std::max(report.worst_cone, double(laws[law_of[c]].natural_map(still, r).norm()));
  }
  report.residual = norm > 0 ? std::sqrt(map / norm) : std::sqrt(map);
  // Impulses so large that the velocities are lost in their rounding leave nothing to be read. The
  // map of an approach without impulse is 1/mu of it, where mu is large and there is some slip.
  const double rounding = double(std::numeric_limits<typename Operator::Scalar>::epsilon());
  const double left = std::max(map + rounding * rounding * norm, closing);
  report.left_over = approach > 0 ? std::sqrt(left / approach) : 0;
  if (std::isfinite(map) && std::isfinite(norm)) return;
  // Not a number, or beyond all numbers: no solution.
  report.residual = report.left_over = std::numeric_limits<double>::infinity();
}

}  // namespace moreau
