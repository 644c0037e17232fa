// SPDX-License-Identifier: MIT
// The Delassus block of a contact with a couple. The rows of rolling are the relative spin times
// the effective radius R, so that all rows of u are velocities and all rows of r are impulses:
//
//     u = (u_n, u_t, R w_rel),     r = (r_n, r_t, couple / R),
//     W = [P  C; C^T  Q],          P the LocalBlock of the point, C (D x A), Q (A x A).
#pragma once

#include "moreau/contact/local_block.hpp"
#include "moreau/core/twist.hpp"

namespace moreau {

/// W of one contact with couples, in its own frame [1/kg]: u = W r with u = (velocity, R spin)
/// [m/s] and r = (impulse, couple / R) [N s].
template <class S>
struct RollingBlock {
  using Scalar = typename S::Scalar;
  static constexpr int rows = S::dim + S::angular_dim;  ///< impulse, then couple / R
  using Vector = Eigen::Matrix<Scalar, rows, 1>;
  using Coupling = Eigen::Matrix<Scalar, S::dim, S::angular_dim>;

  LocalBlock<S> point;       ///< P [1/kg]
  Coupling coupling;         ///< C, D x A [1/kg]
  typename S::Inertia spin;  ///< Q, A x A, positive definite [1/kg]

  /// W r [m/s], D + A numbers, of r [N s].
  Vector operator*(const Vector& r) const {
    const typename S::Vector push = linear<S>(r);
    const typename S::Angular couple = angular<S>(r);
    Vector u;
    linear<S>(u) = point * push + coupling * couple;
    angular<S>(u) = coupling.transpose() * push + spin * couple;
    return u;
  }
  Scalar trace() const { return point.trace() + spin.trace(); }  ///< trace of W [1/kg]
};

}  // namespace moreau
