// SPDX-License-Identifier: MIT
// What the direct method takes of a contact of the contact problem: the coefficients of its law, and b.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "moreau/solve/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/jacobian_rows.hpp"

namespace moreau::detail {

/// The coefficients of friction and of rolling resistance; the second is 0 for a law without couples [-].
template <class Law>
std::array<double, 2> friction_and_rolling(const Law& law) {
  if constexpr (Rolls<Law>)
    return {double(law.friction()), double(law.rolling())};
  else
    return {double(law.friction()), 0};
}
/// J of a contact for one of its bodies, see jacobian_rows().
template <bool Couples, class Operator>
auto jacobian_rows_of(const Operator& op, std::size_t c,
                      const typename Operator::Space::Vector& lever, double sign) {
  using S = typename Operator::Space;
  if constexpr (Couples)
    return jacobian_rows<S>(op.frame(c), lever, double(op.radius(c)), sign);
  else
    return jacobian_rows<S>(op.frame(c), lever, sign);
}
/// b of a contact [m/s]. In single precision b has the rounding of the velocities of the bodies. Two points of a face
/// would then have to close at velocities that no motion of the bodies has, and impulses become as large as this
/// rounding over the compliance of a step. In double precision the velocities of the bodies agree.
template <class Operator, class Law>
Eigen::Matrix<double, Operator::Vector::RowsAtCompileTime, 1> exact_free_velocity(
    const ContactProblem<Operator, Law>& problem, std::size_t c) {
  const auto rounded = problem.delassus.free_velocity(c).template cast<double>().eval();
  if constexpr (std::is_same_v<typename Operator::Scalar, float>) {
    if (problem.free.empty() || !rounded.allFinite()) return rounded;
    const auto [a, b] = problem.delassus.bodies(c);
    const auto of_a = problem.free[a].template cast<double>().eval(),
               of_b = problem.free[b].template cast<double>().eval();
    const auto rows_a = jacobian_rows_of<Rolls<Law>>(problem.delassus, c,
                                                     problem.delassus.lever_a(c), -1),
               rows_b = jacobian_rows_of<Rolls<Law>>(problem.delassus, c,
                                                     problem.delassus.lever_b(c), 1);
    Eigen::Matrix<double, Operator::Vector::RowsAtCompileTime, 1> exact = rounded;
    for (int k = 0; k < exact.size(); ++k) {
      const double sum = rows_a.row(k).dot(of_a) + rows_b.row(k).dot(of_b);
      const double terms = rows_a.row(k).cwiseAbs().dot(of_a.cwiseAbs()) +
                           rows_b.row(k).cwiseAbs().dot(of_b.cwiseAbs());
      // A smaller offset of the law is below the rounding of the sum.
      constexpr double several = 4 * double(std::numeric_limits<float>::epsilon());
      if (std::abs(rounded[k] - sum) <= several * terms) exact[k] = sum;
    }
    return exact;
  } else {
    return rounded;
  }
}
/// Part of exact_free_velocity() that an open gap adds; 0 if it is not known [m/s].
template <class Operator, class Law>
double opening_velocity(const ContactProblem<Operator, Law>& problem, std::size_t c) {
  if (problem.gap_velocity.empty() || !(problem.gap_velocity[c] > 0)) return 0;
  if constexpr (std::is_same_v<typename Operator::Scalar, float>) {
    // exact_free_velocity() has left the gap out: it is below the rounding.
    if (exact_free_velocity(problem, c)[0] != double(problem.delassus.free_velocity(c)[0]))
      return 0;
  }
  return double(problem.gap_velocity[c]);
}

}  // namespace moreau::detail
