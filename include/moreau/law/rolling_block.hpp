// SPDX-License-Identifier: MIT
// The Delassus block of a contact with a couple. The rows of rolling are the relative spin times
// the effective radius R, so that all rows of u are velocities and all rows of r are impulses:
//
//     u = (u_n, u_t, R w_rel),     r = (r_n, r_t, couple / R),
//     W = [P  C; C^T  Q],          P the LocalBlock of the point, C (D x A), Q (A x A).
//
// Where round bodies touch on the line of their centres, a couple does not move the point along the normal,
// and a couple about the normal does not move the point at all:
//
//     C = c lever(n),     Q = q I,     n the normal in the frame, (1, 0[, 0]).
//
// RoundBlock has this form. A sweep that subtracts W' r_c from the velocity of a contact before it solves
// the local problem with W' has the same fixed point for every W'. It converges if W' - W is not
// negative. So a solver may replace the block of every contact by a round one,
//
//     [P  C; C^T  Q]  <=  2 [P  0; 0  Q]  <=  2 [P  0; 0  q I],      q the largest sum of |Q| over a row.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/core/twist.hpp"
#include "moreau/law/lane_block.hpp"
#include "moreau/law/local_block.hpp"
#include "moreau/simd/lane_algebra.hpp"

namespace moreau {

/// W of one contact with couples, in its own frame [1/kg]: u = W r with u = (velocity, R spin)
/// [m/s] and r = (impulse, couple / R) [N s].
template <class S>
struct RollingBlock {
  using Scalar = typename S::Scalar;
  static constexpr int rows = S::dim + S::angular_dim;  ///< impulse, then couple / R
  using Vector = Eigen::Matrix<Scalar, rows, 1>;
  using Matrix = Eigen::Matrix<Scalar, rows, rows>;
  using Cross = Eigen::Matrix<Scalar, S::dim, S::angular_dim>;  ///< of C

  LocalBlock<S> point;       ///< P [1/kg]
  Cross cross;               ///< C, D x A [1/kg]
  typename S::Inertia spin;  ///< Q, A x A, positive definite [1/kg]

  /// W r [m/s], D + A numbers, of r [N s].
  Vector operator*(const Vector& r) const {
    const typename S::Vector push = linear<S>(r);
    const typename S::Angular couple = angular<S>(r);
    Vector u;
    linear<S>(u) = point * push + cross * couple;
    angular<S>(u) = cross.transpose() * push + spin * couple;
    return u;
  }
  /// Makes the block that of W times a factor > 0 [-].
  RollingBlock& operator*=(Scalar factor) {
    point *= factor;
    cross *= factor;
    spin *= factor;
    return *this;
  }
  Scalar trace() const { return point.trace() + spin.trace(); }  ///< trace of W [1/kg]
  /// W, D + A x D + A [1/kg].
  Matrix matrix() const {
    constexpr int d = S::dim, a = S::angular_dim;
    Matrix w;
    w.template topLeftCorner<d, d>() = point.matrix();
    w.template topRightCorner<d, a>() = cross;
    w.template bottomLeftCorner<a, d>() = cross.transpose();
    w.template bottomRightCorner<a, a>() = spin;
    return w;
  }
};

namespace detail {

/// c and q of the round block that stands for W in sweeps.
/// @param point in: P; out: that of the round block
/// @returns (c, q) [1/kg]
template <class S>
std::array<typename S::Scalar, 2> round_couple(const RollingBlock<S>& w, LocalBlock<S>& point) {
  using Scalar = typename S::Scalar;
  using Cross = typename RollingBlock<S>::Cross;
  const Cross form = S::lever(typename S::Vector(S::Vector::Unit(0)));
  Scalar cross = form.cwiseProduct(w.cross).sum() / form.squaredNorm();
  Scalar spin = w.spin.trace() / S::angular_dim;
  // In double precision: squares of the entries of large bodies are zero in single precision.
  const double aside = (w.cross - cross * form).template cast<double>().norm() +
                       (w.spin - spin * S::Inertia::Identity()).template cast<double>().norm();
  if (!(aside <= double(std::sqrt(std::numeric_limits<Scalar>::epsilon()) * w.trace()))) {
    point *= 2;
    cross = 0;
    spin = 2 * w.spin.cwiseAbs().rowwise().sum().maxCoeff();
  }
  // Positive definite by a margin: a body that turns about its centre and cannot move otherwise has a
  // force and a couple that do the same.
  const Scalar least = Scalar(1.01) * cross * cross / spin;
  point.slip = point.slip.cwiseMax(least);
  return {cross, spin};
}

}  // namespace detail

/// The block of a contact of round bodies on the line of their centres, with the reciprocals that local solutions
/// need; the head of this file has its form. Of one contact, or of one contact per SIMD lane.
/// @tparam NumberT detail::Wide, or detail::OneNumber for a single contact
template <class S, class NumberT = detail::Wide<typename S::Scalar, detail::widest_bytes>>
struct RoundBlock {
  static constexpr std::size_t rows = S::dofs;     ///< D + A, rows of a contact
  using Point = LaneBlock<S, NumberT>;             ///< the block of the point alone
  using Number = NumberT;                          ///< OneNumber or Wide
  using Values = typename Number::Values;          ///< an entry: a number, or one number per lane
  using Index = typename Number::Index;            ///< of the entries of a vector of the point
  using Algebra = detail::LaneAlgebra<S, Values>;  ///< products
  using Vector = std::array<Values, rows>;
  using Couple = std::array<Values, std::size_t{S::angular_dim}>;  ///< A rows
  using Memory = std::array<Values, 2>;  ///< of a local solution, see LaneLaw

  Point point;          ///< P
  Values cross;         ///< c [1/kg]
  Values spin;          ///< q > 0 [1/kg]
  Values inverse_spin;  ///< 1 / q [kg]
  typename Point::Tangent
      resting_slip;  ///< slip of P - C Q^-1 C^T: where the contact does not roll [1/kg]
  typename Point::Tangent inverse_resting_slip;  ///< 1 / resting_slip [kg]

  /// W = 1, in lanes without a contact.
  static RoundBlock unit() {
    RoundBlock block{};
    block.point = Point::unit();
    block.spin = block.inverse_spin = Number::broadcast(1);
    block.resting_slip = block.inverse_resting_slip = block.point.slip;
    return block;
  }
  /// Sets the block of a lane, lane < Number::lanes, to the block that stands for w in sweeps: w itself to rounding
  /// if it is round.
  void set(std::size_t lane, const RollingBlock<S>& w) {
    using Scalar = typename S::Scalar;
    LocalBlock<S> of_point = w.point;
    const auto [c, q] = detail::round_couple<S>(w, of_point);
    point.set(lane, of_point);
    Number::set(cross, lane, c);
    Number::set(spin, lane, q);
    Number::set(inverse_spin, lane, 1 / q);
    for (int t = 0; t < S::dim - 1; ++t) {
      const Scalar resting = of_point.slip[t] - c * (c / q);
      Number::set(resting_slip[Index(t)], lane, resting);
      Number::set(inverse_resting_slip[Index(t)], lane, 1 / resting);
    }
  }
  /// Sets the memory of a lane to 0.
  static void forget(Memory& memory, std::size_t lane) {
    for (Values& one : memory) Number::set(one, lane, 0);
  }
  /// The block of a lane, lane < Number::lanes.
  RollingBlock<S> operator[](std::size_t lane) const {
    RollingBlock<S> block;
    block.point = point[lane];
    block.cross = Number::get(cross, lane) * S::lever(typename S::Vector(S::Vector::Unit(0)));
    block.spin = Number::get(spin, lane) * S::Inertia::Identity();
    return block;
  }
  /// The impulse, D numbers, of (impulse, couple / R), or the velocity of (velocity, R spin).
  static std::array<Values, std::size_t{S::dim}> linear(const Vector& r) {
    std::array<Values, std::size_t{S::dim}> push;
    for (std::size_t d = 0; d < S::dim; ++d) push[d] = r[d];
    return push;
  }
  /// Couple / R, A numbers, of (impulse, couple / R), or R spin of (velocity, R spin).
  static Couple angular(const Vector& r) {
    Couple couple;
    for (std::size_t k = 0; k < S::angular_dim; ++k) couple[k] = r[S::dim + k];
    return couple;
  }
  /// W r [m/s], of r [N s].
  Vector operator*(const Vector& r) const {
    const auto push = linear(r);
    typename Point::Vector rows_of_point;
    for (std::size_t d = 0; d < S::dim; ++d) rows_of_point[Index(d)] = push[d];
    const auto moved = point * rows_of_point;
    const auto aside = Algebra::spin_of_normal(angular(r));
    const auto moment = Algebra::moment_of_normal(push);
    Vector u;
    for (std::size_t d = 0; d < S::dim; ++d) u[d] = moved[Index(d)];
    for (std::size_t t = 0; t < aside.size(); ++t) u[1 + t] += cross * aside[t];
    for (std::size_t k = 0; k < S::angular_dim; ++k)
      u[S::dim + k] = cross * moment[k] + spin * r[S::dim + k];
    return u;
  }
};

}  // namespace moreau
