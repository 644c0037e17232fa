// SPDX-License-Identifier: MIT
// The oracle of Coulomb's local problem: a solution of its own, written for one contact, by a root of
// phi(alpha) = |r_t| - mu r_n in a bracket. SignoriniCoulomb::solve and its lanes must agree with it,
// and RollingResistance::solve and its lanes with the same beside a couple.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/local_block.hpp"
#include "moreau/law/rolling_block.hpp"

namespace law_oracle {

using moreau::LocalBlock;
using moreau::RollingBlock;
using moreau::Space;

/// The impulse of slip in the plane: r_t = s mu r_n, where the sign s of r_t does not depend on
/// alpha.
template <std::floating_point T>
Eigen::Matrix<T, 2, 1> solve_slip(const LocalBlock<Space<2, T>>& block,
                                  const Eigen::Matrix<T, 2, 1>& b, T friction,
                                  const Eigen::Matrix<T, 2, 1>&) {
  const T s = b[1] > block.coupling[0] * b[0] ? -friction : friction;
  const T normal = -b[0] / (block.normal * (T(1) + s * block.coupling[0]));
  return {normal, s * normal};
}

/// A contact whose sticking impulse is longer than this, in units of the impulse without friction and of
/// 1 + mu, slips against an alpha beside which the slip of the block is below rounding.
template <std::floating_point T>
inline constexpr T far_outside = std::numeric_limits<T>::epsilon() < T(1e-10) ? T(1e30) : T(1e9);

/// The impulse of slip in space; Newton's method starts from the alpha of the guess.
template <std::floating_point T>
Eigen::Matrix<T, 3, 1> solve_slip(const LocalBlock<Space<3, T>>& block,
                                  const Eigen::Matrix<T, 3, 1>& b, T friction,
                                  const Eigen::Matrix<T, 3, 1>& guess) {
  // Within this relative |phi| the last Newton step is taken along the derivative at hand, which
  // leaves an error of its square: rounding.
  constexpr T close = std::numeric_limits<T>::epsilon() < T(1e-10) ? T(2e-8) : T(2e-4);
  // Velocities and impulses are divided by `free`, the impulse of the problem without friction.
  // Otherwise products of small impulses would underflow.
  const T free = -b[0] / block.normal, unit = T(1) / free;
  if (!std::isfinite(unit))
    return Eigen::Matrix<T, 3, 1>::Zero();  // below the smallest normal number
  const T k1 = block.coupling[0], k2 = block.coupling[1];
  const T c1 = unit * (b[1] - k1 * b[0]), c2 = unit * (b[2] - k2 * b[0]);
  const T l1 = block.slip[0], l2 = block.slip[1];
  if (!(std::max(std::abs(c1), std::abs(c2)) < far_outside<T> * (l1 + l2) * (1 + friction))) {
    // slip + alpha is alpha to rounding: r_t has the direction of -c. Powers of c1 would overflow, c1
    // itself may have.
    const T p1 = b[1] - k1 * b[0], p2 = b[2] - k2 * b[0];
    const T most = std::max(std::abs(p1), std::abs(p2)), q1 = p1 / most, q2 = p2 / most;
    const T length = std::sqrt(q1 * q1 + q2 * q2), t1 = -q1 / length, t2 = -q2 / length;
    const T share = T(1) + friction * (k1 * t1 + k2 * t2);
    if (share > T(0)) {
      const T normal = free / share;
      return {normal, friction * normal * t1, friction * normal * t2};
    }
  }
  T lower = 0, upper = std::numeric_limits<T>::infinity(), alpha = 0;
  const T g1 = unit * guess[1], g2 = unit * guess[2], squared = g1 * g1 + g2 * g2;
  if (squared > T(0)) {
    alpha = -((c1 + l1 * g1) * g1 + (c2 + l2 * g2) * g2) / squared;
    if (!(alpha > T(0) && std::isfinite(alpha))) alpha = 0;
  }
  T r1 = 0, r2 = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const T i1 = T(1) / (l1 + alpha), i2 = T(1) / (l2 + alpha);
    r1 = -c1 * i1, r2 = -c2 * i2;
    const T s1 = r1 * i1, s2 = r2 * i2;  // -dr_t/dalpha
    const T length2 = r1 * r1 + r2 * r2, length = std::sqrt(length2);
    const T limit = friction * (T(1) - k1 * r1 - k2 * r2);
    const T fall = r1 * s1 + r2 * s2;                      // -|r_t| d|r_t|/dalpha
    const T limit_slope = friction * (k1 * s1 + k2 * s2);  // d limit/dalpha
    const T phi = length - limit;
    // Newton on the reciprocals where the limit is positive, on phi itself where it is not.
    const T change = limit > T(0) ? phi * length2 * limit /
                                        (limit_slope * length2 * length + fall * limit * limit)
                                  : phi * length / (fall + limit_slope * length);
    if (std::abs(phi) <= close * (length + std::abs(limit))) {
      r1 -= change * s1;
      r2 -= change * s2;
      break;
    }
    (phi > T(0) ? lower : upper) = alpha;
    if (std::isfinite(upper) && upper - lower <= close * close * upper) break;
    T next = alpha + change;
    if (!(next > lower && next < upper))
      next = std::isinf(upper) ? T(2) * lower + l1 + l2 : (lower + upper) / T(2);
    alpha = next;
  }
  // Projects the result onto the cone: Newton's method leaves a small distance.
  const T normal = free * (T(1) - k1 * r1 - k2 * r2);
  const T length2 = r1 * r1 + r2 * r2;
  const T scale = length2 > T(0) ? friction * normal / std::sqrt(length2) : T(0);
  if (!std::isfinite(scale * length2)) return {free, 0, 0};  // a load at the limit of the numbers
  return {normal, scale * r1, scale * r2};
}

/// The impulse that solves Signorini's and Coulomb's conditions for u = W r + b.
template <class S>
typename S::Vector solve_coulomb(const LocalBlock<S>& block, const typename S::Vector& b,
                                 typename S::Scalar friction, const typename S::Vector& guess) {
  using T = typename S::Scalar;
  constexpr int tangents = S::dim - 1;
  typename S::Vector r = S::Vector::Zero();
  if (b[0] >= T(0)) return r;
  const T free = -b[0] / block.normal;
  if (friction == T(0)) {
    r[0] = free;
    return r;
  }
  const auto c = b.template tail<tangents>() - b[0] * block.coupling;
  r.template tail<tangents>() = -c.cwiseQuotient(block.slip);
  r[0] = free - block.coupling.dot(r.template tail<tangents>());
  // In units of the impulse without friction: squares of small impulses would underflow.
  const T unit = T(1) / free, limit = unit * friction * r[0];
  if (std::isfinite(limit * limit)
          ? limit >= T(0) && (unit * r.template tail<tangents>()).squaredNorm() <= limit * limit
          : r.template tail<tangents>().stableNorm() <= friction * r[0])
    return r;
  return solve_slip<T>(block, b, friction, guess);
}

/// The couple m / R with Q m + c = -beta m, |m| <= limit, beta >= 0, and beta = 0 if |m| < limit, for Q = q I.
template <class Vector>
Vector solve_couple(typename Vector::Scalar q, const Vector& c, typename Vector::Scalar limit) {
  const Vector rests = -c / q;
  const auto length = rests.norm();
  return length <= limit || !(length > 0) ? rests : Vector(rests * (limit / length));
}

/// The impulse that solves Coulomb's law and the law of rolling for u = W r + b, for a round block: the two in turn,
/// each with the impulse of the other.
template <class S>
typename RollingBlock<S>::Vector solve_rolling(const RollingBlock<S>& block,
                                               const typename RollingBlock<S>::Vector& b,
                                               typename S::Scalar friction,
                                               typename S::Scalar rolling) {
  using Row = typename RollingBlock<S>::Vector;
  using T = typename S::Scalar;
  Row r = Row::Zero();
  for (int turn = 0; turn < 4000; ++turn) {
    const Row before = r;
    const typename S::Vector b_point = moreau::linear<S>(b) + block.cross * moreau::angular<S>(r);
    moreau::linear<S>(r) =
        solve_coulomb<S>(block.point, b_point, friction, typename S::Vector(moreau::linear<S>(r)));
    const typename S::Angular c =
        moreau::angular<S>(b) + block.cross.transpose() * moreau::linear<S>(r);
    moreau::angular<S>(r) = solve_couple(block.spin(0, 0), c, T(rolling * r[0]));
    if ((r - before).norm() <= std::numeric_limits<T>::epsilon() / 4 * r.norm()) break;
  }
  return r;
}

}  // namespace law_oracle
