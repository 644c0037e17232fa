// SPDX-License-Identifier: MIT
// Unilateral contact with dry friction and Newton's restitution.
//
//   0 <= u_n + offset  _|_  r_n >= 0,     |r_t| <= mu r_n,  u_t = -alpha r_t with alpha >= 0,
//                                          alpha = 0 inside the cone.
//
// The local solution is exact. If the sticking impulse is outside of the cone, the contact slips,
// u_t = -alpha r_t, and alpha > 0 is the root of phi(alpha) = |r_t| - mu r_n, positive at 0 and
// negative at infinity (O. Bonnefon and G. Daviet, "Quartic formulation of Coulomb 3D frictional
// contact", INRIA RT-0400, 2011). Squaring phi would add roots with r_n < 0. Newton runs on 1/|r_t|
// - 1/(mu r_n) instead, which is nearly linear in alpha (as in the secular equation of J. J. More
// and D. C. Sorensen, SIAM J. Sci. Stat. Comput. 4 (1983) 553), inside a bracket for phi. In the
// plane the sign of r_t does not depend on alpha: the solution is explicit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <tuple>

#include "moreau/contact/local_block.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/space.hpp"
#include "moreau/law/detail/coulomb_lanes.hpp"
#include "moreau/law/detail/newton_restitution.hpp"

namespace moreau {

namespace detail {

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

}  // namespace detail

/// Signorini's condition with Coulomb friction and Newton's restitution for one pair of materials.
/// Model of LaneLaw and StatefulLaw.
template <std::floating_point T = double>
class SignoriniCoulomb {
 public:
  /// @param friction    mu >= 0 [-]
  /// @param restitution e in [0, 1] [-]: u_n' = -e u_n at an impact
  /// @throws std::invalid_argument outside these ranges
  explicit SignoriniCoulomb(T friction = T(0), T restitution = T(0))
      : SignoriniCoulomb(friction, restitution, friction) {}
  /// A law with static friction.
  /// @param friction        mu >= 0 if the contact slid in the step before [-]. With 0, a contact that slides
  ///                        does so until it opens
  /// @param restitution     e in [0, 1] [-]
  /// @param static_friction mu >= friction if the contact is new, or was stuck or open in the step before [-]
  /// @throws std::invalid_argument outside these ranges
  SignoriniCoulomb(T friction, T restitution, T static_friction)
      : friction_(friction), restitution_(restitution), static_(static_friction) {
    require(std::isfinite(friction) && friction >= T(0), "SignoriniCoulomb", "friction", friction,
            "must be finite and >= 0");
    require(restitution >= T(0) && restitution <= T(1), "SignoriniCoulomb", "restitution",
            restitution, "must lie in [0, 1]");
    require(std::isfinite(static_friction) && static_friction >= friction, "SignoriniCoulomb",
            "static_friction", static_friction, "must be finite and >= friction");
  }

  T friction() const { return friction_; }        ///< mu in slip [-]
  T static_friction() const { return static_; }   ///< mu at rest [-]
  T restitution() const { return restitution_; }  ///< e [-]

  /// Offset of u_n [m/s], see newton_restitution.hpp.
  /// @param gap    g [m], < 0 is penetration
  /// @param before u_n before the step [m/s], > 0 separates
  /// @param step   h [s], > 0
  /// @returns infinity if the contact cannot act in this step
  T velocity_offset(T gap, T before, T step) const {
    return detail::newton_offset(restitution_, gap, before, step);
  }

  /// The exact solution of the local problem: the impulse on b, in the frame of the contact, normal
  /// first [N s]. Its friction is friction(); static friction is that of a variant().
  /// @param block W of the contact [1/kg]
  /// @param b     D, relative velocity without impulse, with the offset [m/s]
  /// @param guess start of the iteration, zero allowed [N s]
  template <class S>
  typename S::Vector solve(const LocalBlock<S>& block, const typename S::Vector& b,
                           const typename S::Vector& guess) const {
    constexpr int tangents = S::dim - 1;
    typename S::Vector r = S::Vector::Zero();
    if (b[0] >= T(0)) return r;
    const T free = -b[0] / block.normal;
    if (friction_ == T(0)) {
      r[0] = free;
      return r;
    }
    const auto c = b.template tail<tangents>() - b[0] * block.coupling;
    r.template tail<tangents>() = -c.cwiseQuotient(block.slip);
    r[0] = free - block.coupling.dot(r.template tail<tangents>());
    // In units of the impulse without friction: squares of small impulses would underflow.
    const T unit = T(1) / free, limit = unit * friction_ * r[0];
    if (std::isfinite(limit * limit)
            ? limit >= T(0) && (unit * r.template tail<tangents>()).squaredNorm() <= limit * limit
            : r.template tail<tangents>().stableNorm() <= friction_ * r[0])
      return r;
    return detail::solve_slip<T>(block, b, friction_, guess);
  }

  /// See StatefulLaw: static friction, friction in slip.
  static constexpr std::size_t variants = 2;
  /// See StatefulLaw: 0 at rest, 1 in slip.
  SignoriniCoulomb variant(std::size_t k) const {
    return SignoriniCoulomb(k == 0 ? static_ : friction_, restitution_);
  }
  /// See StatefulLaw: the contact slid if its impulse [N s] lies on the cone of variant k. Always 0 if
  /// static and kinetic friction are equal.
  template <class Vector>
  std::size_t variant_after(std::size_t k, const Vector& impulse) const {
    if (static_ == friction_ || !(impulse[0] > T(0))) return 0;
    const T length = impulse.template tail<Vector::RowsAtCompileTime - 1>().norm();
    const T limit = (k == 0 ? static_ : friction_) * impulse[0];
    return length >= limit * (T(1) - std::sqrt(std::numeric_limits<T>::epsilon())) ? 1 : 0;
  }

  /// See LaneLaw: the friction [-].
  std::array<T, 1> lane_parameters() const { return {friction_}; }
  /// See LaneLaw: CoulombLanes, whose memory is alpha.
  template <class S>
  static typename LaneBlock<S>::Vector solve_lanes(
      const LaneBlock<S>& block, const typename LaneBlock<S>::Vector& b,
      const typename LaneBlock<S>::Vector&,
      const std::array<typename LaneBlock<S>::Values, 1>& parameters,
      typename LaneBlock<S>::Values& memory, bool polish) {
    return detail::CoulombLanes<S>::solve(block, b, parameters[0], memory, polish);
  }

  /// r - P_K(r - (u + mu |u_t| n)), K the Coulomb cone. Zero iff (u, r) satisfies the law
  /// (G. De Saxce and Z.-Q. Feng, Math. Comput. Modelling 28 (1998) 225).
  /// @param u,r D entries, normal first, in one unit, which is that of the result
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r) const {
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    Vector x = r - u;
    x[0] -= friction_ * u.template tail<tangents>().norm();
    return r - project(x);
  }

  /// The projection of x onto the cone |x_t| <= mu x_n; D entries, normal first, in the unit of x.
  template <class Vector>
  Vector project(const Vector& x) const {
    constexpr int tangents = Vector::RowsAtCompileTime - 1;
    const T length = x.template tail<tangents>().norm();
    if (friction_ * length <= -x[0]) return Vector::Zero();  // first: 0 <= -0 would hold below
    if (length <= friction_ * x[0]) return x;
    const T normal = (x[0] + friction_ * length) / (T(1) + friction_ * friction_);
    Vector p;
    p[0] = normal;
    for (int k = 1; k <= tangents; ++k) p[k] = x[k] * (friction_ * normal / length);
    return p;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(friction_, restitution_, static_); }

  T friction_, restitution_, static_;
};

}  // namespace moreau
