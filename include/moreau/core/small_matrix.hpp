// SPDX-License-Identifier: MIT
// Functions of small matrices that the compiler instantiates once. Eigen has each of them, but with
// new types for every combination of operands, which make up most of the time to compile a
// simulation. The results are the same to the last bit.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "moreau/core/compiler.hpp"

namespace moreau {

namespace detail {

template <class T>
bool are_finite(const T* entries, Eigen::Index count) {
  bool finite = true;
  for (Eigen::Index i = 0; i < count; ++i) finite = finite && std::isfinite(entries[i]);
  return finite;
}

}  // namespace detail

/// Whether all entries of a matrix or vector are finite.
template <class Matrix>
bool all_finite(const Eigen::PlainObjectBase<Matrix>& m) {
  return detail::are_finite(m.data(), m.size());
}

/// A matrix times a vector, which is evaluated first.
/// @param m N x N
/// @param x N, or an expression with N entries
template <class T, int N>
Eigen::Matrix<T, N, 1> product(const Eigen::Matrix<T, N, N>& m,
                               const std::type_identity_t<Eigen::Matrix<T, N, 1>>& x) {
  return m * x;
}
/// The same of the transposed matrix.
template <class T, int N>
Eigen::Matrix<T, N, 1> transposed_product(const Eigen::Matrix<T, N, N>& m,
                                          const std::type_identity_t<Eigen::Matrix<T, N, 1>>& x) {
  return m.transpose() * x;
}

/// The inverse of a matrix with positive trace, such as an inertia. The determinant is that of a matrix near 1, so
/// that it neither underflows nor overflows for small and large bodies.
template <class Matrix>
[[gnu::noinline]] Matrix inverse_of(const Matrix& m) {
  using T = typename Matrix::Scalar;
  constexpr int most = std::numeric_limits<T>::max_exponent - 2;
  const T scale = std::ldexp(T(1), -std::clamp(std::ilogb(m.trace()), -most, most));  // exact
  const Matrix scaled = m * scale, inverse = scaled.inverse();
  return inverse * scale;
}

/// x + t d, for instance the point at t of a line.
template <class T, int N>
Eigen::Matrix<T, N, 1> along(const Eigen::Matrix<T, N, 1>& x, std::type_identity_t<T> t,
                             const std::type_identity_t<Eigen::Matrix<T, N, 1>>& d) {
  Eigen::Matrix<T, N, 1> sum;
  for (int k = 0; k < N; ++k) sum[k] = x[k] + t * d[k];
  return sum;
}

}  // namespace moreau
