// SPDX-License-Identifier: MIT
// The Delassus block of one contact, factored so that the local solution of a law is a few
// divisions.
//
// Eliminating the normal impulse from u = W r + b leaves the tangential Schur complement
// W_tt - w_tn w_tn^T / w_nn. With the tangents of the contact frame turned to its eigenvectors,
//
//     W = w_nn [1 k^T; k k k^T] + diag(0, slip),        k = w_tn / w_nn (the coupling),
//
// and the impulse with u_n = 0 and u_t = -alpha r_t (alpha = 0 sticks) is
//
//     r_t = -(b_t - k b_n) / (slip + alpha)   (entry by entry),     r_n = -b_n / w_nn - k . r_t.
#pragma once

#include <cmath>
#include <concepts>

#include "moreau/core/space.hpp"

namespace moreau {

/// W of one contact in its own frame, normal first; tangents aligned as above [1/kg].
template <class S>
struct LocalBlock {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int tangents = S::dim - 1;  ///< D - 1
  using Tangent = Eigen::Matrix<Scalar, tangents, 1>;

  Scalar normal;     ///< w_nn [1/kg]
  Tangent coupling;  ///< k = w_tn / w_nn [-]
  Tangent slip;      ///< eigenvalues of the Schur complement [1/kg]

  /// W r [m/s] of an impulse r [N s], both in the frame, normal first.
  Vector operator*(const Vector& r) const {
    Scalar sum = r[0];
    for (int t = 0; t < tangents; ++t) sum += coupling[t] * r[t + 1];
    Vector u;
    u[0] = normal * sum;
    for (int t = 0; t < tangents; ++t) u[t + 1] = u[0] * coupling[t] + slip[t] * r[t + 1];
    return u;
  }
  /// Trace of W [1/kg].
  Scalar trace() const { return normal * (1 + coupling.squaredNorm()) + slip.sum(); }
  /// W, D x D, normal first [1/kg].
  typename S::Matrix matrix() const {
    typename S::Matrix w;
    for (int k = 0; k < S::dim; ++k) w.col(k) = *this * Vector(Vector::Unit(k));
    return w;
  }
};

namespace detail {

/// Orthonormal eigenvectors of a symmetric matrix of one or two rows, as the columns of a rotation:
/// one Jacobi rotation by the smaller angle.
template <std::floating_point T, int N>
Eigen::Matrix<T, N, N> eigenvectors(const Eigen::Matrix<T, N, N>& a) {
  static_assert(N <= 2, "eigenvectors: of three rows one rotation for each pair is not enough");
  Eigen::Matrix<T, N, N> q = Eigen::Matrix<T, N, N>::Identity();
  for (int k = 1; k < N; ++k) {
    if (a(k, k - 1) == T(0)) continue;
    const T theta = (a(k, k) - a(k - 1, k - 1)) / (T(2) * a(k, k - 1));
    const T t = std::copysign(T(1), theta) / (std::abs(theta) + std::sqrt(theta * theta + T(1)));
    const T c = T(1) / std::sqrt(t * t + T(1));
    q(k - 1, k - 1) = q(k, k) = c;
    q(k - 1, k) = t * c;
    q(k, k - 1) = -t * c;
  }
  return q;
}

}  // namespace detail

/// Finds the rotation of the tangents (columns 1.. of the contact frame) that makes W a LocalBlock.
/// @param w     W in the given frame, D x D, normal first, symmetric positive definite [1/kg]
/// @param turn  out: D - 1 x D - 1, a rotation; new tangents = old tangents * turn
/// @returns W in the turned frame
template <class S>
LocalBlock<S> align_tangents(const typename S::Matrix& w,
                             Eigen::Matrix<typename S::Scalar, S::dim - 1, S::dim - 1>& turn) {
  constexpr int tangents = S::dim - 1;
  using Block = Eigen::Matrix<typename S::Scalar, tangents, tangents>;
  LocalBlock<S> block;
  block.normal = w(0, 0);
  Block schur;
  for (int i = 0; i < tangents; ++i)
    for (int k = 0; k < tangents; ++k)
      schur(i, k) = w(i + 1, k + 1) - w(i + 1, 0) * w(k + 1, 0) / block.normal;
  turn = detail::eigenvectors(schur);
  for (int t = 0; t < tangents; ++t) {
    block.coupling[t] = block.slip[t] = 0;
    for (int i = 0; i < tangents; ++i) {
      block.coupling[t] += turn(i, t) * w(i + 1, 0) / block.normal;
      for (int k = 0; k < tangents; ++k) block.slip[t] += turn(i, t) * schur(i, k) * turn(k, t);
    }
  }
  return block;
}

}  // namespace moreau
