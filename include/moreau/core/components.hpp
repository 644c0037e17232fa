// SPDX-License-Identifier: MIT
// The type of every vector that a public function or constructor takes.
//
// Eigen reads two integers as numbers of rows and columns: Vector3d v = {0, 0} compiles, allocates
// nothing and leaves v uninitialised. Components<3, double> can be made from three numbers or from
// a column vector of three doubles, and from nothing else, so that the call
//
//   world.set_velocity(body, {1, 0});   // a simulation in space
//
// ends with one message: use of deleted function Components(WrongNumber ...)
// [with WrongNumber = {int, int}; int N = 3; T = double].
//
// A Components is an Eigen vector: the body of a function uses it as one, and kernels take plain
// Eigen vectors.
#pragma once

#include <Eigen/Core>

#include <concepts>

namespace moreau {

namespace detail {

/// What a component may be given by. It is converted to the scalar of the vector.
template <class X>
concept ComponentValue = (std::integral<X> && !std::same_as<X, bool>) || std::floating_point<X>;

/// A column vector, or an expression of one, with N components of exactly the type T.
template <class X, int N, class T>
concept ColumnVector =
    std::same_as<Eigen::Matrix<typename X::Scalar, X::RowsAtCompileTime, X::ColsAtCompileTime>,
                 Eigen::Matrix<T, N, 1>>;

}  // namespace detail

/// Argument type: a vector with N components of type T.
template <int N, class T>
class Components : public Eigen::Matrix<T, N, 1> {
  using Base = Eigen::Matrix<T, N, 1>;

 public:
  /// From N numbers: {0, 0, -9.81}. One number needs no braces.
  template <detail::ComponentValue... Given>
  requires(sizeof...(Given) == N)  // NOLINTNEXTLINE(google-explicit-constructor): an argument type
      Components(Given... given) {
    Eigen::Index axis = 0;
    ((Base::coeffRef(axis++) = static_cast<T>(given)), ...);
  }
  /// From an Eigen vector, or an expression of one: -Vector::UnitX().
  template <class Vector>
  requires detail::ColumnVector<Vector, N, T>  // NOLINTNEXTLINE(google-explicit-constructor)
  Components(const Eigen::DenseBase<Vector>& vector) : Base(vector.derived()) {}

  // A wrong number of components. (One number for several is no conversion at all.)
  template <detail::ComponentValue... WrongNumber>
  requires(sizeof...(WrongNumber) != N && sizeof...(WrongNumber) != 1) Components(WrongNumber...)
  = delete;
  // An Eigen vector of another length, of another scalar, or whose length is not known to the
  // compiler (write head<3>() instead of head(3)).
  template <class WrongVector>
  requires(!detail::ColumnVector<WrongVector, N, T>)
      Components(const Eigen::DenseBase<WrongVector>&)
  = delete;
};

/// Argument type: a position, velocity, force or direction of the space S.
template <class S>
using VectorArgument = typename S::VectorArgument;
/// Argument type: an angular quantity of the space S. In the plane a number is enough.
template <class S>
using AngularArgument = typename S::AngularArgument;

}  // namespace moreau
