// SPDX-License-Identifier: MIT
// Coulomb friction with resistance to rolling and twisting: beside the law of the point,
//
//     |m| <= eta r_n,    w = -beta m with beta >= 0,  beta = 0 inside,
//
// where m = couple / R and w = R w_rel are the last A rows of the contact (rolling_block.hpp), so
// that the couple is at most eta R r_n and eta is the coefficient of rolling resistance (K.
// Iwashita and M. Oda, J. Eng. Mech. 124 (1998) 285; J. Ai et al., Powder Technol. 206 (2011) 269,
// model A without a spring). Meant for spheres and disks.
//
// The local solution neither slips nor rolls if that obeys both limits. Else the two laws are
// solved in turn, each exactly with the impulse of the other held, until nothing changes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <tuple>

#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/detail/rolling_lanes.hpp"
#include "moreau/law/rolling_block.hpp"
#include "moreau/law/signorini_coulomb.hpp"

namespace moreau {

namespace detail {

/// Solves Q m + c = -beta m with |m| <= limit and beta >= 0; beta = 0 if |m| < limit.
template <class Matrix, class Vector, class T>
Vector solve_disc(const Matrix& q, const Vector& c, T limit) {
  constexpr T epsilon = std::numeric_limits<T>::epsilon();
  if (!(limit > 0) || c.isZero(0)) return Vector::Zero();
  // In units of the limit: products of small couples would underflow.
  const Vector load = c / limit;
  // So far outside that Q is below the rounding of beta; squares may overflow.
  if (!(epsilon * load.stableNorm() < q.trace())) return -limit * c.stableNormalized();
  T beta = 0;
  Vector m = Vector::Zero();
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Matrix inverse = inverse_of(Matrix(q + beta * Matrix::Identity()));
    m = -(inverse * load);
    const T length = m.norm(), excess = length - 1;
    if (excess <= (beta > 0 ? 4 * epsilon : T(0))) break;
    // Newton on 1/|m| - 1, which is concave in beta: monotone from below.
    beta += length * length / (m.dot(inverse * m)) * excess;
  }
  const T length = m.norm();
  return length > 1 ? Vector(m * (limit / length)) : Vector(limit * m);
}

}  // namespace detail

/// Signorini's condition with friction and rolling resistance for one pair of materials; the head
/// of this file has its equations and their source. Model of RollingLaw and LaneLaw.
template <std::floating_point T = double>
class RollingResistance {
 public:
  using ActsWhereGapsClose = RollingResistance;  ///< see the concept of this name
  static constexpr bool rolls = true;            ///< see SetValuedLaw
  static constexpr bool is_coulomb = true;       ///< see RollingCoulombLaw

  /// @param friction    mu >= 0 [-]
  /// @param rolling     eta >= 0 [-]: largest couple over (effective radius x normal impulse)
  /// @param restitution e in [0, 1] [-]: u_n' = -e u_n at an impact
  /// @throws std::invalid_argument outside these ranges
  explicit RollingResistance(T friction = T(0), T rolling = T(0), T restitution = T(0))
      : rolling_(rolling) {
    require(std::isfinite(friction) && friction >= 0, "RollingResistance", "friction", friction,
            "must be finite and >= 0");
    require(restitution >= 0 && restitution <= 1, "RollingResistance", "restitution", restitution,
            "must lie in [0, 1]");
    require(std::isfinite(rolling) && rolling >= 0, "RollingResistance", "rolling", rolling,
            "must be finite and >= 0");
    point_ = SignoriniCoulomb<T>(friction, restitution);
  }

  T friction() const { return point_.friction(); }        ///< mu [-]
  T rolling() const { return rolling_; }                  ///< eta [-]
  T restitution() const { return point_.restitution(); }  ///< e [-]

  /// Offset of u_n [m/s], as SignoriniCoulomb::velocity_offset.
  T velocity_offset(T gap, T before, T step) const {
    return point_.velocity_offset(gap, before, step);
  }

  /// A solution of the local problem to rounding: the impulse (r_n, r_t, couple / R) on b, in the
  /// frame of the contact [N s].
  /// @param block W of the contact [1/kg]
  /// @param b     D + A, (velocity, R spin) without impulse, with the offset [m/s]
  /// @param guess start of the iteration, zero allowed [N s]
  template <class S>
  typename RollingBlock<S>::Vector solve(const RollingBlock<S>& block,
                                         const typename RollingBlock<S>::Vector& b,
                                         const typename RollingBlock<S>::Vector& guess) const {
    using Vector = typename RollingBlock<S>::Vector;
    if (b[0] >= T(0)) return Vector::Zero();
    // In units of the velocity and of the block: squares of small velocities and of small and large impulses cannot be represented.
    const T unit = b.cwiseAbs().maxCoeff(), mass = reciprocal_power(block.trace());
    RollingBlock<S> scaled = block;
    scaled *= mass;
    const Vector start = guess / mass / unit;
    const Vector r = solve_unit<S>(scaled, b / unit, start.allFinite() ? start : Vector::Zero());
    return unit * Vector(mass * r);
  }

  /// See LaneLaw: the friction and the coefficient of rolling resistance [-].
  std::array<T, 2> lane_parameters() const { return {friction(), rolling_}; }
  /// See LaneLaw: RollingLanes, whose memory is alpha, and whether the contact rolls.
  template <class S>
  static typename RoundBlock<S>::Vector solve_lanes(
      const RoundBlock<S>& block, const typename RoundBlock<S>::Vector& b,
      const typename RoundBlock<S>::Vector& guess,
      const std::array<typename RoundBlock<S>::Values, 2>& parameters,
      typename RoundBlock<S>::Memory& memory, bool polish) {
    return detail::RollingLanes<S>::solve(block, b, guess, parameters[0], parameters[1], memory,
                                          polish);
  }

  /// r - P_K(r - (u + (mu |u_t| + eta |w|) n)), K the cone of project(). Zero iff (u, r) satisfies
  /// the law.
  /// @param u,r D + A, in one unit, which is that of the result
  template <class Vector>
  Vector natural_map(const Vector& u, const Vector& r) const {
    using S = SpaceOfTwist<Vector>;
    Vector x = r - u;
    x[0] -= friction() * u.template segment<S::dim - 1>(1).norm() + rolling_ * angular<S>(u).norm();
    return r - project(x);
  }

  /// The projection of x = (x_n, x_t, m) onto the cone |x_t| <= mu x_n, |m| <= eta x_n, in the unit
  /// of x.
  template <class Vector>
  Vector project(const Vector& x) const {
    using S = SpaceOfTwist<Vector>;
    constexpr int tangents = S::dim - 1;
    const T slide = x.template segment<tangents>(1).norm(), roll = angular<S>(x).norm();
    const T mu = friction(), eta = rolling_;
    // x_n of the projection is the zero of the smallest of four rising functions: each of the two limits
    // may bind or not. So it is the largest of their zeros.
    T normal = 0;
    for (int binds = 0; binds < 4; ++binds) {
      const T a = binds & 1 ? mu : T(0), b = binds & 2 ? eta : T(0);
      normal = std::max(normal, (x[0] + a * slide + b * roll) / (1 + a * a + b * b));
    }
    Vector p = Vector::Zero();
    if (!(normal > 0)) return p;
    p[0] = normal;
    p.template segment<tangents>(1) =
        x.template segment<tangents>(1) * (slide > mu * normal ? mu * normal / slide : T(1));
    angular<S>(p) = angular<S>(x) * (roll > eta * normal ? eta * normal / roll : T(1));
    return p;
  }

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(point_, rolling_); }

  /// solve() for b whose largest entry is 1 and a block whose trace is near 1.
  template <class S>
  typename RollingBlock<S>::Vector solve_unit(const RollingBlock<S>& block,
                                              const typename RollingBlock<S>::Vector& b,
                                              const typename RollingBlock<S>::Vector& guess) const {
    using Vector = typename RollingBlock<S>::Vector;
    const Vector firm = sticking<S>(block, b);
    if ((firm - project(firm)).isZero(0)) return firm;
    Vector r = guess;
    for (int iteration = 0; iteration < 1000; ++iteration) {
      const Vector before = r;
      const typename S::Vector b_point = linear<S>(b) + block.cross * angular<S>(r);
      linear<S>(r) = point_.template solve<S>(block.point, b_point, linear<S>(r));
      const typename S::Angular c = angular<S>(b) + block.cross.transpose() * linear<S>(r);
      const typename S::Angular couple =
          detail::solve_disc<typename S::Inertia, typename S::Angular, T>(block.spin, c,
                                                                          rolling_ * r[0]);
      // Damped after 30 iterations: a couple that opens a contact, which closes without the couple,
      // would alternate for ever.
      const T share = iteration < 30 ? T(1) : T(0.5);
      angular<S>(r) += share * (couple - angular<S>(r));
      if ((r - before).norm() <= 4 * std::numeric_limits<T>::epsilon() * r.norm()) return r;
    }
    return damped<S>(block, b, r);
  }
  /// The fixed point of the natural map, by damped iteration from r. With a friction above 1 and levers
  /// off the line of the centres the two halves of solve_unit() can alternate for ever.
  /// @returns r if this does not converge
  template <class S>
  typename RollingBlock<S>::Vector damped(const RollingBlock<S>& block,
                                          const typename RollingBlock<S>::Vector& b,
                                          const typename RollingBlock<S>::Vector& r) const {
    using Vector = typename RollingBlock<S>::Vector;
    const auto w = block.matrix();
    const T scale = w.trace() / T(RollingBlock<S>::rows);
    for (const T damping : {T(0.3), T(0.1), T(0.03)}) {
      Vector x = r;
      for (int iteration = 0; iteration < 20000; ++iteration) {
        const Vector u = damping * (w * x + b);
        const Vector change = natural_map(u, Vector(scale * x)) / scale;
        x -= change;
        if (change.norm() <= 4 * std::numeric_limits<T>::epsilon() * x.norm()) return x;
      }
    }
    return r;
  }

  /// u = 0 in all rows.
  template <class S>
  static typename RollingBlock<S>::Vector sticking(const RollingBlock<S>& block,
                                                   const typename RollingBlock<S>::Vector& b) {
    return solve_linear(block.matrix(), typename RollingBlock<S>::Vector(-b));
  }

  SignoriniCoulomb<T> point_;
  T rolling_;
};

}  // namespace moreau
