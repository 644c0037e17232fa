// SPDX-License-Identifier: MIT
// Components: the type of all vectors that public functions and constructors take as arguments.
//
// Eigen interprets two integers as numbers of rows and columns: Vector3d v = {0, 0} compiles and
// leaves v uninitialised. A Components<3, double> can be constructed only from three numbers or
// from a column vector of three doubles. So the call
//
//   world.set_velocity(body, {1, 0});   // a simulation in space
//
// does not compile. The compiler reports: use of deleted function Components(WrongNumber ...) [with
// WrongNumber = {int, int}; int N = 3; T = double].
//
// A Components is an Eigen vector and can be used as one inside a function; its operators return plain
// values (value.hpp). Kernels take plain Eigen vectors.
#pragma once

#include <Eigen/Core>

#include <concepts>

#include "moreau/core/value.hpp"

namespace moreau {

namespace detail {

/// A number from which a component can be constructed. It is converted to the scalar type of the
/// vector.
template <class X>
concept ComponentValue = (std::integral<X> && !std::same_as<X, bool>) || std::floating_point<X>;

/// A column vector or an Eigen expression with N components of exactly the type T.
template <class X, int N, class T>
concept ColumnVector =
    std::same_as<Eigen::Matrix<typename X::Scalar, X::RowsAtCompileTime, X::ColsAtCompileTime>,
                 Eigen::Matrix<T, N, 1>>;

}  // namespace detail

/// Type of an argument: a vector with N components of type T.
template <int N, class T>
class Components : public Value<Eigen::Matrix<T, N, 1>> {
  using Base = Value<Eigen::Matrix<T, N, 1>>;

 public:
  /// Constructs the vector from N numbers: {0, 0, -9.81}. For N = 1 no braces are needed.
  template <detail::ComponentValue... Given>
  requires(sizeof...(Given) == N)  // NOLINTNEXTLINE(google-explicit-constructor): an argument type
      Components(Given... given) {
    Eigen::Index axis = 0;
    ((Base::coeffRef(axis++) = static_cast<T>(given)), ...);
  }
  /// Constructs the vector from an Eigen vector or expression: -Vector::UnitX().
  template <class Vector>
  requires detail::ColumnVector<Vector, N, T>  // NOLINTNEXTLINE(google-explicit-constructor)
  Components(const Eigen::DenseBase<Vector>& vector) : Base(vector.derived()) {}

  // Deleted: a wrong number of components. (A single number is never converted to several
  // components.)
  template <detail::ComponentValue... WrongNumber>
  requires(sizeof...(WrongNumber) != N && sizeof...(WrongNumber) != 1) Components(WrongNumber...)
  = delete;
  // Deleted: an Eigen vector with a wrong length or scalar type, or with a length that is not known
  // at compile time (write head<3>() instead of head(3)).
  template <class WrongVector>
  requires(!detail::ColumnVector<WrongVector, N, T>)
      Components(const Eigen::DenseBase<WrongVector>&)
  = delete;
};

/// Type of an argument: a position, velocity, force or direction in the space S.
template <class S>
using VectorArgument = typename S::VectorArgument;
/// Type of an argument: an angular quantity in the space S. In the plane a number can be passed.
template <class S>
using AngularArgument = typename S::AngularArgument;

}  // namespace moreau
