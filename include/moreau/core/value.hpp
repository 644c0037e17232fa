// SPDX-License-Identifier: MIT
// The type of vectors and matrices that functions return by value.
//
// The result of an Eigen operator refers to its operands. With a function that returns an Eigen
// matrix, `auto f = impulse() / h` therefore refers to a temporary that no longer exists on the next
// line, and `auto d = pose(a).position - pose(b).position` changes when a body moves. The operators of
// a Value compute at once: f and d are plain vectors.
//
// Other functions of Eigen (head(), transpose(), cwiseAbs(), ...) still return expressions. Do not
// store these with auto: give the type of the result, or call eval().
//
// The functions of a simulation return a constant Value: `velocity(a).x() = 3`, which would change a temporary and not
// the body, does not compile. `auto v = velocity(a)` is a variable that can be changed.
#pragma once

#include <Eigen/Core>

#include <concepts>

#include "moreau/core/compiler.hpp"

namespace moreau {

/// A matrix or vector whose sums, differences, products and multiples are plain values.
/// @tparam Matrix an Eigen::Matrix, from which it derives
template <class Matrix>
class Value : public Matrix {
 public:
  using Matrix::Matrix;
  Value() = default;  ///< entries of a fixed size are not initialized, as Eigen's
  /// @param matrix a matrix or an expression, which is evaluated
  template <class Other>  // NOLINTNEXTLINE(google-explicit-constructor): as Eigen's own
  Value(const Eigen::DenseBase<Other>& matrix) : Matrix(matrix.derived()) {}
  using Matrix::operator=;
};

namespace detail {

/// A number that an operator of Eigen takes beside a matrix, also one of another precision.
template <class Number>
concept Factor = std::integral<Number> || std::floating_point<Number>;

template <class Matrix>
const Matrix& plain(const Value<Matrix>& value) {
  return value;
}

/// The product of two matrices or expressions of fixed size.
template <class Left, class Right>
requires(Left::ColsAtCompileTime == Right::RowsAtCompileTime) auto times(const Left& left,
                                                                         const Right& right) {
  using Product =
      Eigen::Matrix<typename Left::Scalar, Left::RowsAtCompileTime, Right::ColsAtCompileTime>;
  return Value<Product>(Product(left * right));
}

}  // namespace detail

/// @name Operators of a Value: they return a Value.
/// @{

/// The opposite.
template <class M>
Value<M> operator-(const Value<M>& a) {
  return Value<M>(-detail::plain(a));
}
/// The sum.
template <class M>
Value<M> operator+(const Value<M>& a, const Value<M>& b) {
  return Value<M>(detail::plain(a) + detail::plain(b));
}
/// The sum.
template <class M, class Other>
Value<M> operator+(const Value<M>& a, const Eigen::MatrixBase<Other>& b) {
  return Value<M>(detail::plain(a) + b.derived());
}
/// The sum.
template <class M, class Other>
Value<M> operator+(const Eigen::MatrixBase<Other>& a, const Value<M>& b) {
  return Value<M>(a.derived() + detail::plain(b));
}
/// The difference.
template <class M>
Value<M> operator-(const Value<M>& a, const Value<M>& b) {
  return Value<M>(detail::plain(a) - detail::plain(b));
}
/// The difference.
template <class M, class Other>
Value<M> operator-(const Value<M>& a, const Eigen::MatrixBase<Other>& b) {
  return Value<M>(detail::plain(a) - b.derived());
}
/// The difference.
template <class M, class Other>
Value<M> operator-(const Eigen::MatrixBase<Other>& a, const Value<M>& b) {
  return Value<M>(a.derived() - detail::plain(b));
}
/// The multiple.
template <class M, detail::Factor Number>
Value<M> operator*(const Value<M>& a, Number factor) {
  return Value<M>(detail::plain(a) * static_cast<typename M::Scalar>(factor));
}
/// The multiple.
template <class M, detail::Factor Number>
Value<M> operator*(Number factor, const Value<M>& a) {
  return Value<M>(static_cast<typename M::Scalar>(factor) * detail::plain(a));
}
/// The quotient.
template <class M, detail::Factor Number>
Value<M> operator/(const Value<M>& a, Number divisor) {
  return Value<M>(detail::plain(a) / static_cast<typename M::Scalar>(divisor));
}
/// The product.
template <class M, class N>
auto operator*(const Value<M>& a, const Value<N>& b) {
  return detail::times(detail::plain(a), detail::plain(b));
}
/// The product.
template <class M, class Other>
auto operator*(const Value<M>& a, const Eigen::MatrixBase<Other>& b) {
  return detail::times(detail::plain(a), b.derived());
}
/// The product.
template <class M, class Other>
auto operator*(const Eigen::MatrixBase<Other>& a, const Value<M>& b) {
  return detail::times(a.derived(), detail::plain(b));
}
/// @}

}  // namespace moreau
