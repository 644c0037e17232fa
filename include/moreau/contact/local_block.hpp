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

#include <array>
#include <cmath>
#include <cstddef>

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
  /// Makes the block that of W times a factor > 0 [-].
  LocalBlock& operator*=(Scalar factor) {
    normal *= factor;
    slip *= factor;
    return *this;
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

/// W of a contact after its tangents are turned, for entries that are numbers or one contact per SIMD
/// lane. new tangents = old tangents * turn
template <std::size_t Tangents, class Values>
struct AlignedBlock {
  Values normal;
  std::array<Values, Tangents> coupling, slip;
  std::array<std::array<Values, Tangents>, Tangents> turn;
};

/// @param w           lower triangle of W, row after row
/// @param square_root function of Values
template <std::size_t Tangents, class Values>
AlignedBlock<Tangents, Values> aligned_block(
    const std::array<Values, (Tangents + 1) * (Tangents + 2) / 2>& w, const auto& square_root) {
  static_assert(Tangents <= 2, "of three rows one rotation for each pair is not enough");
  const auto entry = [&](std::size_t i, std::size_t k) -> const Values& {
    return w[i < k ? k * (k + 1) / 2 + i : i * (i + 1) / 2 + k];
  };
  const Values zero{}, one = zero + 1;
  AlignedBlock<Tangents, Values> block;
  // No impulse changes the normal velocity: the contact cannot act (ContactLanes), any value will do.
  block.normal = entry(0, 0) == zero ? (entry(1, 1) == zero ? one : entry(1, 1)) : entry(0, 0);
  const Values inverse = one / block.normal;
  std::array<Values, Tangents> k;  // before the turn
  for (std::size_t t = 0; t < Tangents; ++t) k[t] = entry(t + 1, 0) * inverse;
  std::array<std::array<Values, Tangents>, Tangents> schur;
  for (std::size_t i = 0; i < Tangents; ++i)
    for (std::size_t j = 0; j < Tangents; ++j) {
      schur[i][j] = entry(i + 1, j + 1) - entry(i + 1, 0) * k[j];
      block.turn[i][j] = i == j ? one : zero;
    }
  if constexpr (Tangents == 2) {
    // One Jacobi rotation by the smaller angle.
    const Values mixed = schur[1][0] + schur[1][0];
    const Values theta = (schur[1][1] - schur[0][0]) / (mixed == zero ? one : mixed);
    const Values size = theta < zero ? -theta : theta;
    const Values least = one / (size + square_root(theta * theta + one));
    const Values signed_least = theta < zero ? -least : least;
    const Values tangent = mixed == zero ? zero : signed_least;
    const Values cosine = one / square_root(tangent * tangent + one);
    block.turn[0][0] = block.turn[1][1] = cosine;
    block.turn[0][1] = tangent * cosine;
    block.turn[1][0] = -(tangent * cosine);
  }
  for (std::size_t t = 0; t < Tangents; ++t) {
    block.coupling[t] = block.slip[t] = zero;
    for (std::size_t i = 0; i < Tangents; ++i) {
      block.coupling[t] += block.turn[i][t] * k[i];
      for (std::size_t j = 0; j < Tangents; ++j)
        block.slip[t] += block.turn[i][t] * schur[i][j] * block.turn[j][t];
    }
  }
  return block;
}

}  // namespace detail

/// Finds the rotation of the tangents (columns 1.. of the contact frame) that makes W a LocalBlock.
/// @param w     W in the given frame, D x D, normal first, symmetric positive definite [1/kg]
/// @param turn  out: D - 1 x D - 1, a rotation; new tangents = old tangents * turn
/// @returns W in the turned frame
template <class S>
LocalBlock<S> align_tangents(const typename S::Matrix& w,
                             Eigen::Matrix<typename S::Scalar, S::dim - 1, S::dim - 1>& turn) {
  using T = typename S::Scalar;
  constexpr std::size_t tangents = S::dim - 1;
  std::array<T, (tangents + 1) * (tangents + 2) / 2> lower;
  for (int i = 0, e = 0; i < S::dim; ++i)
    for (int k = 0; k <= i; ++k) lower[std::size_t(e++)] = w(i, k);
  const auto aligned =
      detail::aligned_block<tangents, T>(lower, [](const T& x) { return std::sqrt(x); });
  LocalBlock<S> block;
  block.normal = aligned.normal;
  for (std::size_t t = 0; t < tangents; ++t) {
    block.coupling[Eigen::Index(t)] = aligned.coupling[t];
    block.slip[Eigen::Index(t)] = aligned.slip[t];
    for (std::size_t i = 0; i < tangents; ++i)
      turn(Eigen::Index(i), Eigen::Index(t)) = aligned.turn[i][t];
  }
  return block;
}

}  // namespace moreau
