// SPDX-License-Identifier: MIT
#include "moreau/core/small_matrix.hpp"

#include <doctest/doctest.h>
#include <limits>
#include <random>

namespace {

template <class T, int Rows, int Columns>
Eigen::Matrix<T, Rows, Columns> random_matrix(std::mt19937_64& random) {
  std::uniform_real_distribution<T> uniform(-1, 1);
  Eigen::Matrix<T, Rows, Columns> m;
  for (int j = 0; j < Columns; ++j)
    for (int i = 0; i < Rows; ++i) m(i, j) = uniform(random);
  return m;
}

/// The sums of products of matrices with these sizes against Eigen's.
template <class T, int N, int K, int M>
void check_products(std::mt19937_64& random) {
  const auto a = random_matrix<T, N, K>(random);
  const auto b = random_matrix<T, K, M>(random);
  const auto turned = random_matrix<T, M, K>(random);
  const auto down = random_matrix<T, K, N>(random);
  const auto start = random_matrix<T, N, M>(random);
  const T tolerance = 20 * std::numeric_limits<T>::epsilon();
  for (const T factor : {T(1), T(-1), T(0.3)}) {
    Eigen::Matrix<T, N, M> to = start;
    moreau::add_product(to, a, b, factor);
    CHECK((to - (start + factor * a * b)).cwiseAbs().maxCoeff() < tolerance);
    to = start;
    moreau::add_product_transposed(to, a, turned, factor);
    CHECK((to - (start + factor * a * turned.transpose())).cwiseAbs().maxCoeff() < tolerance);
    to = start;
    moreau::add_transposed_product(to, down, b, factor);
    CHECK((to - (start + factor * down.transpose() * b)).cwiseAbs().maxCoeff() < tolerance);
  }
}

/// The inverse of a definite matrix; matrices that are not definite are refused.
template <class T, int N>
void check_inverse(std::mt19937_64& random) {
  using Matrix = Eigen::Matrix<T, N, N>;
  const auto half = random_matrix<T, N, N>(random);
  Matrix m = half * half.transpose() + Matrix::Identity();
  Matrix inverse = m;
  inverse.template triangularView<Eigen::StrictlyUpper>().setConstant(7);  // is not read
  REQUIRE(moreau::invert_definite(inverse));
  CHECK((inverse * m - Matrix::Identity()).cwiseAbs().maxCoeff() <
        500 * std::numeric_limits<T>::epsilon());
  CHECK(inverse == Matrix(inverse.transpose()));
  for (const T last : {T(0), T(-1), std::numeric_limits<T>::quiet_NaN()}) {
    Matrix other = Matrix::Identity();
    other(N - 1, N - 1) = last;
    CHECK_FALSE(moreau::invert_definite(other));
  }
}

}  // namespace

TEST_CASE_TEMPLATE("sums of products of small matrices are those of Eigen", T, double, float) {
  std::mt19937_64 random(1);
  check_products<T, 6, 6, 6>(random);
  check_products<T, 3, 6, 1>(random);
  check_products<T, 6, 3, 6>(random);
  check_products<T, 2, 3, 3>(random);
  check_products<T, 3, 2, 1>(random);
  check_products<T, 1, 1, 1>(random);
}

TEST_CASE_TEMPLATE("the inverse of a definite matrix, and which matrices are not definite", T,
                   double, float) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    check_inverse<T, 1>(random);
    check_inverse<T, 3>(random);
    check_inverse<T, 6>(random);
  }
}
