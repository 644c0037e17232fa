// SPDX-License-Identifier: MIT
#include "moreau/core/small_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace {

template <class T, int Rows, int Columns>
Eigen::Matrix<T, Rows, Columns> random_matrix(std::mt19937_64& random) {
  std::uniform_real_distribution<T> uniform(-1, 1);
  Eigen::Matrix<T, Rows, Columns> m;
  for (int j = 0; j < Columns; ++j)
    for (int i = 0; i < Rows; ++i) m(i, j) = uniform(random);
  return m;
}

/// A matrix of any size and scalar. Eigen takes a compiler a fifth of a second for each type of a product.
struct Table {
  int rows, columns;
  std::vector<double> entries;

  template <class Matrix>
  explicit Table(const Matrix& m)
      : rows(int(m.rows())), columns(int(m.cols())), entries(std::size_t(rows * columns)) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) (*this)(i, j) = double(m(i, j));
  }
  double operator()(int i, int j) const { return entries[std::size_t(i * columns + j)]; }
  double& operator()(int i, int j) { return entries[std::size_t(i * columns + j)]; }

  Table transposed() const {
    Table other = *this;
    std::swap(other.rows, other.columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) other(j, i) = (*this)(i, j);
    return other;
  }
};

/// The largest absolute entry of sum - (start + factor a b).
double error_of(const Table& sum, const Table& start, double factor, const Table& a,
                const Table& b) {
  double largest = 0;
  for (int i = 0; i < a.rows; ++i)
    for (int j = 0; j < b.columns; ++j) {
      double product = 0;
      for (int k = 0; k < a.columns; ++k) product += a(i, k) * b(k, j);
      // Not std::max, which drops NaN.
      const double error = std::abs(sum(i, j) - (start(i, j) + factor * product));
      if (!(error <= largest)) largest = error;
    }
  return largest;
}

/// The sums of products of matrices with these sizes.
template <class T, int N, int K, int M>
void check_products(std::mt19937_64& random) {
  const auto a = random_matrix<T, N, K>(random);
  const auto b = random_matrix<T, K, M>(random);
  const auto turned = random_matrix<T, M, K>(random);
  const auto down = random_matrix<T, K, N>(random);
  const auto start = random_matrix<T, N, M>(random);
  const Table of_a(a), of_b(b), of_start(start);
  const double tolerance = 20 * double(std::numeric_limits<T>::epsilon());
  for (const T factor : {T(1), T(-1), T(0.3)}) {
    auto to = start;
    moreau::add_product(to, a, b, factor);
    CHECK(error_of(Table(to), of_start, factor, of_a, of_b) < tolerance);
    to = start;
    moreau::add_product_transposed(to, a, turned, factor);
    CHECK(error_of(Table(to), of_start, factor, of_a, Table(turned).transposed()) < tolerance);
    to = start;
    moreau::add_transposed_product(to, down, b, factor);
    CHECK(error_of(Table(to), of_start, factor, Table(down).transposed(), of_b) < tolerance);
  }
  const Table zero(decltype(start)::Zero());
  CHECK(error_of(Table(moreau::matrix_product(a, b)), zero, 1, of_a, of_b) < tolerance);
  CHECK(error_of(Table(moreau::product_with_transposed(a, turned)), zero, 1, of_a,
                 Table(turned).transposed()) < tolerance);
}

/// A square matrix times a vector, and measures of square matrices.
template <class T, int N>
void check_square(std::mt19937_64& random) {
  using Vector = Eigen::Matrix<T, N, 1>;
  const auto m = random_matrix<T, N, N>(random), other = random_matrix<T, N, N>(random);
  const Vector x = random_matrix<T, N, 1>(random);
  const Table of_m(m), of_x(x), zero(Vector::Zero());
  const double tolerance = 20 * double(std::numeric_limits<T>::epsilon());
  CHECK(error_of(Table(moreau::product(m, x)), zero, 1, of_m, of_x) < tolerance);
  CHECK(error_of(Table(moreau::transposed_product(m, x)), zero, 1, of_m.transposed(), of_x) <
        tolerance);
  const Table rest(moreau::identity_minus(T(0.3), m));
  double squares = 0, largest = 0;
  for (int i = 0; i < N; ++i) {
    double row = 0;
    for (int j = 0; j < N; ++j) {
      CHECK(std::abs(rest(i, j) - ((i == j) - 0.3 * of_m(i, j))) < tolerance);
      squares += std::pow(of_m(i, j) - double(other(i, j)), 2);
      row += std::abs(of_m(i, j));
    }
    largest = std::max(largest, row);
  }
  CHECK(std::abs(double(moreau::squared_distance(m, other)) - squares) < 10 * tolerance);
  CHECK(std::abs(double(moreau::largest_row_sum(m)) - largest) < tolerance);
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

template <class T, int N>
void check_solution(std::mt19937_64& random) {
  using Matrix = Eigen::Matrix<T, N, N>;
  using Vector = Eigen::Matrix<T, N, 1>;
  Matrix m = random_matrix<T, N, N>(random);
  if (N > 1) m(0, 0) = 0;  // not without a change of rows
  for (int k = 0; k < N; ++k) m(k, (k + 1) % N) += T(6);
  const Vector x = random_matrix<T, N, 1>(random);
  Vector b = Vector::Zero();
  moreau::add_product(b, m, x);
  const Vector found = moreau::solve_linear(m, b);
  CHECK(error_of(Table(found), Table(x), 0, Table(m), Table(x)) <
        100 * std::numeric_limits<T>::epsilon());
  Matrix singular = m;
  for (int j = 0; j < N; ++j) singular(N - 1, j) = N > 1 ? singular(0, j) : T(0);
  const Vector none = moreau::solve_linear(singular, Vector(Vector::Ones()));
  bool finite = true;
  for (const T entry : none) finite = finite && std::isfinite(entry);
  CHECK_FALSE(finite);
}

}  // namespace

TEST_CASE_TEMPLATE("sums of products of small matrices", T, double, float) {
  std::mt19937_64 random(1);
  check_products<T, 6, 6, 6>(random);
  check_products<T, 3, 6, 1>(random);
  check_products<T, 6, 3, 6>(random);
  check_products<T, 2, 3, 3>(random);
  check_products<T, 3, 2, 1>(random);
  check_products<T, 1, 1, 1>(random);
}

TEST_CASE_TEMPLATE("square matrices times vectors, differences and norms", T, double, float) {
  std::mt19937_64 random(4);
  check_square<T, 1>(random);
  check_square<T, 2>(random);
  check_square<T, 3>(random);
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

TEST_CASE_TEMPLATE("the solution of a linear system, also where rows have to change places", T,
                   double, float) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    check_solution<T, 1>(random);
    check_solution<T, 3>(random);
    check_solution<T, 6>(random);
  }
}
