// SPDX-License-Identifier: MIT
// Functions of small matrices that the compiler instantiates once. Eigen has each of them, but with
// new types for every combination of operands, which make up most of the time to compile a
// simulation. Sums are taken from the first to the last term; Eigen's order depends on the type and on the
// flags of the compiler.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/compiler.hpp"

namespace moreau {

namespace detail {

template <class T>
bool are_finite(const T* entries, Eigen::Index count) {
  bool finite = true;
  for (Eigen::Index i = 0; i < count; ++i) finite = finite && std::isfinite(entries[i]);
  return finite;
}

/// a . b of N entries that lie the strides apart, summed from the first to the last.
template <int N, int StrideA, int StrideB, class T>
[[gnu::always_inline]] inline T dot_of(const T* a, const T* b) {
  T sum = *a * *b;
  for (int k = 1; k < N; ++k) sum += a[k * StrideA] * b[k * StrideB];
  return sum;
}

/// product(), inlined: where a loop over all contacts calls it.
template <class T, int N>
[[gnu::always_inline]] inline Eigen::Matrix<T, N, 1> inlined_product(
    const Eigen::Matrix<T, N, N>& m, const Eigen::Matrix<T, N, 1>& x) {
  Eigen::Matrix<T, N, 1> y;
  for (int i = 0; i < N; ++i) y[i] = dot_of<N, N, 1>(m.data() + i, x.data());
  return y;
}
/// transposed_product(), inlined.
template <class T, int N>
[[gnu::always_inline]] inline Eigen::Matrix<T, N, 1> inlined_transposed_product(
    const Eigen::Matrix<T, N, N>& m, const Eigen::Matrix<T, N, 1>& x) {
  Eigen::Matrix<T, N, 1> y;
  for (int i = 0; i < N; ++i) y[i] = dot_of<N, 1, 1>(m.data() + i * N, x.data());
  return y;
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
  return detail::inlined_product(m, x);
}
/// The same of the transposed matrix.
template <class T, int N>
Eigen::Matrix<T, N, 1> transposed_product(const Eigen::Matrix<T, N, N>& m,
                                          const std::type_identity_t<Eigen::Matrix<T, N, 1>>& x) {
  return detail::inlined_transposed_product(m, x);
}
/// a b.
template <class T, int N, int K, int M>
Eigen::Matrix<T, N, M> matrix_product(const Eigen::Matrix<T, N, K>& a,
                                      const Eigen::Matrix<T, K, M>& b) {
  Eigen::Matrix<T, N, M> c;
  for (int j = 0; j < M; ++j)
    for (int i = 0; i < N; ++i)
      c.data()[j * N + i] = detail::dot_of<K, N, 1>(a.data() + i, b.data() + j * K);
  return c;
}
/// a b^T.
template <class T, int N, int K, int M>
Eigen::Matrix<T, N, M> product_with_transposed(const Eigen::Matrix<T, N, K>& a,
                                               const Eigen::Matrix<T, M, K>& b) {
  Eigen::Matrix<T, N, M> c;
  for (int j = 0; j < M; ++j)
    for (int i = 0; i < N; ++i)
      c.data()[j * N + i] = detail::dot_of<K, N, M>(a.data() + i, b.data() + j);
  return c;
}
/// The sum of the squares of the differences of all entries.
template <class T, int N>
T squared_distance(const Eigen::Matrix<T, N, N>& a, const Eigen::Matrix<T, N, N>& b) {
  T sum = 0;
  for (int k = 0; k < N * N; ++k) {
    const T difference = a.data()[k] - b.data()[k];
    sum += difference * difference;
  }
  return sum;
}
/// I - factor m.
template <class T, int N>
Eigen::Matrix<T, N, N> identity_minus(std::type_identity_t<T> factor,
                                      const Eigen::Matrix<T, N, N>& m) {
  Eigen::Matrix<T, N, N> difference;
  for (int k = 0; k < N * N; ++k)
    difference.data()[k] = (k % (N + 1) == 0 ? T(1) : T(0)) - factor * m.data()[k];
  return difference;
}
/// M becomes (I + increment) M. In single precision the sum would be rounded in the same direction in every step: what it
/// loses is added in the next one (W. Kahan, Commun. ACM 8 (1965) 40).
/// @param lost in, out: zero at first
template <class T, int N>
MOREAU_COMPILED_ONCE void grow(Eigen::Matrix<T, N, N>& m, Eigen::Matrix<T, N, N>& lost,
                               const Eigen::Matrix<T, N, N>& increment) {
  for (int j = 0; j < N; ++j) {
    const Eigen::Matrix<T, N, 1> column = m.col(j);
    for (int i = 0; i < N; ++i) {
      const T before = column[i];
      T change = -lost(i, j);
      for (int k = 0; k < N; ++k) change += increment(i, k) * column[k];
      m(i, j) = before + change;
      lost(i, j) = (m(i, j) - before) - change;
    }
  }
}
/// The largest sum of the absolute values of a row: the norm of a matrix for vectors whose norm is the largest entry.
template <class T, int N>
T largest_row_sum(const Eigen::Matrix<T, N, N>& m) {
  T largest = 0;
  for (int i = 0; i < N; ++i) {
    T sum = 0;
    for (int j = 0; j < N; ++j) sum += std::abs(m.data()[j * N + i]);
    largest = std::max(largest, sum);
  }
  return largest;
}

/// A power of two near 1 / |x|: products with it are exact. Divided by their size so, squares of quantities with a mass are
/// numbers in single precision for bodies of 1e-6 m to 1e6 m.
template <class T>
T reciprocal_power(T x) {
  constexpr int most = std::numeric_limits<T>::max_exponent - 2;
  return std::ldexp(T(1), -std::clamp(std::ilogb(x), -most, most));
}

/// The inverse of a matrix with positive trace, such as an inertia. The determinant is that of a matrix near 1, so
/// that it neither underflows nor overflows for small and large bodies.
template <class Matrix>
[[gnu::noinline]] Matrix inverse_of(const Matrix& m) {
  const typename Matrix::Scalar scale = reciprocal_power(m.trace());
  const Matrix scaled = m * scale, inverse = scaled.inverse();
  return inverse * scale;
}

/// @name Sums of products of small matrices, without the types that Eigen makes for each of them.
/// @{

/// to += factor a b.
/// @param to N x M, another matrix than a and b
/// @param a  N x K
/// @param b  K x M
template <class T, int N, int K, int M>
void add_product(Eigen::Matrix<T, N, M>& to, const Eigen::Matrix<T, N, K>& a,
                 const Eigen::Matrix<T, K, M>& b, std::type_identity_t<T> factor = T(1)) {
  T* column = to.data();
  const T* entry = b.data();
  for (int j = 0; j < M; ++j, column += N)
    for (int k = 0; k < K; ++k, ++entry) {
      const T by = factor * *entry;
      const T* of_a = a.data() + k * N;
      for (int i = 0; i < N; ++i) column[i] += of_a[i] * by;
    }
}
/// to += factor a b^T.
/// @param to N x M, another matrix than a and b
/// @param a  N x K
/// @param b  M x K
template <class T, int N, int K, int M>
void add_product_transposed(Eigen::Matrix<T, N, M>& to, const Eigen::Matrix<T, N, K>& a,
                            const Eigen::Matrix<T, M, K>& b,
                            std::type_identity_t<T> factor = T(1)) {
  for (int k = 0; k < K; ++k)
    for (int j = 0; j < M; ++j) {
      const T by = factor * b.data()[k * M + j];
      const T* of_a = a.data() + k * N;
      T* column = to.data() + j * N;
      for (int i = 0; i < N; ++i) column[i] += of_a[i] * by;
    }
}
/// to += factor a^T b.
/// @param to N x M, another matrix than a and b
/// @param a  K x N
/// @param b  K x M
template <class T, int N, int K, int M>
void add_transposed_product(Eigen::Matrix<T, N, M>& to, const Eigen::Matrix<T, K, N>& a,
                            const Eigen::Matrix<T, K, M>& b,
                            std::type_identity_t<T> factor = T(1)) {
  for (int j = 0; j < M; ++j)
    for (int i = 0; i < N; ++i) {
      T sum = 0;
      for (int k = 0; k < K; ++k) sum += a.data()[i * K + k] * b.data()[j * K + k];
      to.data()[j * N + i] += factor * sum;
    }
}
/// @}

/// Replaces a symmetric positive definite matrix by its inverse. Its lower triangle is read. With the factor L of
/// Cholesky, m = L L^T, the inverse is L^-T L^-1.
/// @returns false, with a matrix without meaning, if the matrix is not positive definite
template <class T, int N>
[[nodiscard]] bool invert_definite(Eigen::Matrix<T, N, N>& m) {
  constexpr auto n = static_cast<std::size_t>(N);
  T l[n][n], inverse[n][n] = {};
  for (int k = 0; k < N; ++k)
    for (int i = k; i < N; ++i) {
      T rest = m.data()[k * N + i];
      for (int j = 0; j < k; ++j) rest -= l[i][j] * l[k][j];
      if (i == k && !(rest > 0)) return false;
      l[i][k] = i == k ? std::sqrt(rest) : rest / l[k][k];
    }
  for (int k = 0; k < N; ++k) {
    inverse[k][k] = 1 / l[k][k];
    for (int i = k + 1; i < N; ++i) {
      T rest = 0;
      for (int j = k; j < i; ++j) rest += l[i][j] * inverse[j][k];
      inverse[i][k] = -rest / l[i][i];
    }
  }
  for (int j = 0; j < N; ++j)
    for (int i = j; i < N; ++i) {
      T sum = 0;
      for (int k = i; k < N; ++k) sum += inverse[k][i] * inverse[k][j];
      m.data()[j * N + i] = m.data()[i * N + j] = sum;
    }
  return true;
}

/// x of m x = b, by elimination with the largest pivot of each column. Not finite if m is singular.
template <class T, int N>
Eigen::Matrix<T, N, 1> solve_linear(Eigen::Matrix<T, N, N> m, Eigen::Matrix<T, N, 1> b) {
  T* const entry = m.data();  // of row i and column j at j N + i
  T* const x = b.data();
  for (int k = 0; k < N; ++k) {
    int pivot = k;
    for (int i = k + 1; i < N; ++i)
      if (std::abs(entry[k * N + i]) > std::abs(entry[k * N + pivot])) pivot = i;
    if (pivot != k) {
      for (int j = k; j < N; ++j) std::swap(entry[j * N + k], entry[j * N + pivot]);
      std::swap(x[k], x[pivot]);
    }
    for (int i = k + 1; i < N; ++i) {
      const T factor = entry[k * N + i] / entry[k * N + k];
      for (int j = k + 1; j < N; ++j) entry[j * N + i] -= factor * entry[j * N + k];
      x[i] -= factor * x[k];
    }
  }
  for (int k = N - 1; k >= 0; --k) {
    for (int j = k + 1; j < N; ++j) x[k] -= entry[j * N + k] * x[j];
    x[k] /= entry[k * N + k];
  }
  return b;
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
