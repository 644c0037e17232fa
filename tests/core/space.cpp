// SPDX-License-Identifier: MIT
// The algebraic identities on which the mechanics relies, for both spaces and both scalar types.
#include "moreau/core/space.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

#include "types.hpp"

namespace {

using moreau::Space;

#define MOREAU_SPACES \
  MOREAU_TYPES((Space<2, double>, Space<3, double>), (Space<2, float>, Space<3, float>))

/// The product of two matrices. Eigen's takes a compiler a fifth of a second for each type.
template <class A, class B>
auto times(const A& a, const B& b) {
  using T = typename A::Scalar;
  Eigen::Matrix<T, A::RowsAtCompileTime, B::ColsAtCompileTime> product;
  for (int i = 0; i < A::RowsAtCompileTime; ++i)
    for (int j = 0; j < B::ColsAtCompileTime; ++j) {
      T sum = 0;
      for (int k = 0; k < A::ColsAtCompileTime; ++k) sum += a(i, k) * b(k, j);
      product(i, j) = sum;
    }
  return product;
}
template <class A>
auto transposed(const A& a) {
  Eigen::Matrix<typename A::Scalar, A::ColsAtCompileTime, A::RowsAtCompileTime> other;
  for (int i = 0; i < A::RowsAtCompileTime; ++i)
    for (int j = 0; j < A::ColsAtCompileTime; ++j) other(j, i) = a(i, j);
  return other;
}

template <class S>
struct Draw {
  using T = typename S::Scalar;
  std::mt19937_64 engine{20080711};

  template <class Matrix>
  Matrix uniform(T scale = T(1)) {
    std::uniform_real_distribution<T> distribution(-scale, scale);
    return Matrix::NullaryExpr([&] { return distribution(engine); });
  }
  typename S::Vector vector(T scale = T(1)) { return uniform<typename S::Vector>(scale); }
  typename S::Angular angular(T scale = T(1)) { return uniform<typename S::Angular>(scale); }
  typename S::Rotation rotation() { return S::exp(angular(T(3))); }
  typename S::Vector unit() {
    typename S::Vector v = vector();
    while (v.norm() < T(0.1)) v = vector();
    return v.normalized();
  }
  /// A random symmetric positive definite inertia.
  typename S::Inertia inertia() {
    const auto a = uniform<typename S::Inertia>();
    return times(a, transposed(a)) + S::Inertia::Identity();
  }
};

template <class S>
constexpr typename S::Scalar epsilon = std::numeric_limits<typename S::Scalar>::epsilon();

/// The norm of the difference of two vectors or matrices. One function for all types of expressions
/// keeps the compile time short.
template <class Matrix>
auto distance(const Matrix& a, const Matrix& b) {
  return (a - b).norm();
}

/// The step of a difference quotient, for which its error and its rounding are about equal.
template <class S>
const typename S::Scalar difference_step = std::cbrt(epsilon<S>);

/// The derivative of a function of a scalar at 0, by a central difference. If the values of the function
/// are about 1, the error is about difference_error<S>. Not from difference_step: variables of templates begin in any order.
template <class S>
const typename S::Scalar difference_error = std::pow(epsilon<S>, typename S::Scalar(2) / 3);
template <class S, class F>
auto derivative(const F& f) {
  const auto h = difference_step<S>;
  return ((f(h) - f(-h)) / (2 * h)).eval();
}

template <class S>
auto matrix_of(const typename S::Rotation& q) {
  return typename S::Matrix(q.toRotationMatrix());
}

/// The largest absolute entry of R^T R - 1 and of det R - 1.
template <class Matrix>
auto rotation_defect(const Matrix& r) {
  const auto defect = (times(transposed(r), r) - Matrix::Identity()).cwiseAbs().maxCoeff();
  return std::max(defect, std::abs(r.determinant() - 1));
}

TEST_CASE_TEMPLATE("dimensions of the types", S, MOREAU_SPACES) {
  static_assert(S::angular_dim == S::dim * (S::dim - 1) / 2);
  static_assert(S::dofs == S::dim + S::angular_dim);
  static_assert(S::Vector::RowsAtCompileTime == S::dim);
  static_assert(S::Angular::RowsAtCompileTime == S::angular_dim);
  static_assert(S::Lever::RowsAtCompileTime == S::dim);
  static_assert(S::Lever::ColsAtCompileTime == S::angular_dim);
  static_assert(S::Inertia::RowsAtCompileTime == S::angular_dim);
  static_assert(S::Twist::RowsAtCompileTime == S::dofs);
  static_assert(std::is_same_v<typename S::Vector::Scalar, typename S::Scalar>);
  CHECK(S::is_finite(S::identity()));
}

TEST_CASE_TEMPLATE("lever, spin and moment say the same", S, MOREAU_SPACES) {
  Draw<S> draw;
  const auto tolerance = 8 * epsilon<S>;
  for (int i = 0; i < 100; ++i) {
    const auto r = draw.vector();
    const auto f = draw.vector();
    const auto w = draw.angular();
    CHECK(distance<typename S::Vector>(times(S::lever(r), w), S::spin(w, r)) <= tolerance);
    CHECK(distance<typename S::Angular>(times(transposed(S::lever(r)), f), S::moment(r, f)) <=
          tolerance);
    // The power of a force in a rotation, computed as force times velocity and as torque times
    // spin.
    CHECK(std::abs(f.dot(S::spin(w, r)) - S::moment(r, f).dot(w)) <= tolerance);
    CHECK(std::abs(r.dot(S::spin(w, r))) <= tolerance);
    CHECK(S::moment(r, r).norm() <= tolerance);
  }
}

TEST_CASE_TEMPLATE("positive rotations go from x to y", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  // The last angular component is the rotation about z. In the plane it is the only component.
  typename S::Angular w = S::Angular::Zero();
  w[S::angular_dim - 1] = T(2);
  CHECK(distance<Vector>(S::spin(w, Vector::UnitX()), T(2) * Vector::UnitY()) == T(0));
  CHECK(S::moment(Vector::UnitX(), Vector::UnitY())[S::angular_dim - 1] == T(1));
  w[S::angular_dim - 1] = std::numbers::pi_v<T> / 2;
  CHECK(distance<Vector>(S::exp(w) * Vector::UnitX(), Vector::UnitY()) <= 4 * epsilon<S>);
}

TEST_CASE_TEMPLATE("spin is the derivative of exp", S, MOREAU_SPACES) {
  Draw<S> draw;
  for (int i = 0; i < 50; ++i) {
    const auto r = draw.vector();
    const auto w = draw.angular();
    const typename S::Vector difference = derivative<S>(
        [&](typename S::Scalar angle) { return typename S::Vector(S::exp(angle * w) * r); });
    CHECK(distance(difference, S::spin(w, r)) <= 10 * difference_error<S>);
  }
}

TEST_CASE_TEMPLATE("exp is a rotation at any angle, tiny or huge", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  Draw<S> draw;
  for (int exponent = -30; exponent <= 3; ++exponent) {
    const T angle = std::pow(T(10), T(exponent));
    CAPTURE(angle);
    const typename S::Angular w = draw.angular().normalized() * angle;
    const auto q = S::exp(w);
    REQUIRE(S::is_finite(q));
    CHECK(rotation_defect(matrix_of<S>(q)) <= 8 * epsilon<S>);
    // The inverse of a rotation is the rotation by the opposite angle.
    const typename S::Matrix there_and_back = matrix_of<S>(q * S::exp(-w));
    CHECK(distance<typename S::Matrix>(there_and_back, S::Matrix::Identity()) <= 16 * epsilon<S>);
  }
  CHECK(matrix_of<S>(S::exp(S::Angular::Zero())) == S::Matrix::Identity());
}

TEST_CASE_TEMPLATE("rotations about one axis add", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  Draw<S> draw;
  for (int i = 0; i < 50; ++i) {
    const typename S::Angular axis = draw.angular().normalized();
    const T a = draw.vector(T(3))[0];
    const T b = draw.vector(T(3))[0];
    const auto sum = matrix_of<S>(S::exp((a + b) * axis));
    CHECK(distance(matrix_of<S>(S::exp(a * axis) * S::exp(b * axis)), sum) <= 40 * epsilon<S>);
  }
}

TEST_CASE_TEMPLATE("log is the inverse of exp, up to half a turn", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  using Angular = typename S::Angular;
  typename S::Angular axis = S::Angular::Constant(T(0.6));
  axis[0] = T(-0.8);
  axis.normalize();
  CHECK(S::log(S::identity()) == Angular::Zero());
  for (const T angle : {T(1e-30), T(1e-8), T(1e-3), T(1), T(2), T(3.141)}) {
    CAPTURE(angle);
    const Angular w = angle * axis;
    CHECK((S::log(S::exp(w)) - w).norm() <= 8 * epsilon<S> * angle);
    const Angular beyond = w * ((angle + 2 * std::numbers::pi_v<T>) / angle);  // one turn more
    CHECK((S::log(S::exp(beyond)) - w).norm() <= 32 * epsilon<S>);
  }
}

TEST_CASE_TEMPLATE("exp agrees with Eigen's angle and axis", T, MOREAU_TYPES((double), (float))) {
  using S = Space<3, T>;
  Draw<S> draw;
  // At the angle 2e-2, exp switches from the series to the quotient.
  for (const T angle : {T(0), T(1e-20), T(1e-8), T(1e-3), T(0.0199), T(0.02), T(0.0201), T(1),
                        std::numbers::pi_v<T>, T(4), T(6.28), T(100)}) {
    CAPTURE(angle);
    const typename S::Vector axis = draw.unit();
    const typename S::Rotation expected(Eigen::AngleAxis<T>(angle, axis));
    const auto defect = (S::exp(angle * axis).coeffs() - expected.coeffs()).norm();
    CHECK(defect <= (4 + angle) * epsilon<S>);
    // A small vector part has small relative errors.
    if (angle > 0 && angle < T(1))
      CHECK((S::exp(angle * axis).vec() - expected.vec()).norm() <= 4 * epsilon<S> * angle);
  }
}

TEST_CASE_TEMPLATE("is_finite sees what is not", S, MOREAU_SPACES) {
  const auto nan = std::numeric_limits<typename S::Scalar>::quiet_NaN();
  CHECK_FALSE(S::is_finite(S::exp(S::Angular::Constant(nan))));
}

TEST_CASE_TEMPLATE("normalized ends the drift of many small rotations", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  Draw<S> draw;
  auto q = S::identity();
  for (int i = 0; i < 10'000; ++i) q = S::normalized(S::exp(draw.angular(T(0.1))) * q);
  CHECK(rotation_defect(matrix_of<S>(q)) <= 8 * epsilon<S>);
}

TEST_CASE_TEMPLATE("adjoint turns angular quantities as the rotation turns levers", S,
                   MOREAU_SPACES) {
  Draw<S> draw;
  for (int i = 0; i < 50; ++i) {
    const auto q = draw.rotation();
    const auto r = draw.vector();
    const auto f = draw.vector();
    const auto ad = S::adjoint(q);
    CHECK(rotation_defect(ad) <= 8 * epsilon<S>);
    // The torque of a rotated force at a rotated point is the rotated torque.
    CHECK(distance<typename S::Angular>(S::moment(q * r, q * f), times(ad, S::moment(r, f))) <=
          16 * epsilon<S>);
    // lever(q r) Ad(q) = q lever(r).
    CHECK(distance<typename S::Lever>(times(S::lever(q * r), ad),
                                      times(matrix_of<S>(q), S::lever(r))) <= 16 * epsilon<S>);
    const auto p = draw.rotation();
    CHECK(distance<typename S::Inertia>(S::adjoint(p * q), times(S::adjoint(p), ad)) <=
          32 * epsilon<S>);
  }
}

TEST_CASE_TEMPLATE("gyroscopic term does no work and is w x I w", S, MOREAU_SPACES) {
  Draw<S> draw;
  for (int i = 0; i < 50; ++i) {
    const auto inertia = draw.inertia();
    const auto w = draw.angular();
    CHECK(std::abs(S::gyroscopic(inertia, w).dot(w)) <= 32 * epsilon<S>);
    // Without torque the angular momentum I w is constant: d(I w)/dt = 0 while the body rotates
    // with w. Along a principal axis the gyroscopic term is zero.
    CHECK(S::gyroscopic(S::Inertia::Identity(), w).norm() <= 4 * epsilon<S>);
  }
}

TEST_CASE_TEMPLATE("turning is the derivative of an angular quantity along a rotation", S,
                   MOREAU_SPACES) {
  Draw<S> draw;
  for (int i = 0; i < 50; ++i) {
    const auto l = draw.angular();
    const auto dw = draw.angular();
    const typename S::Angular difference = derivative<S>(
        [&](typename S::Scalar angle) { return times(S::adjoint(S::exp(angle * dw)), l); });
    const typename S::Angular turned = times(S::turning(l), dw);
    CHECK(distance(difference, turned) <= 100 * difference_error<S>);
  }
}

template <class S>
void check_frame(const typename S::Vector& n) {
  CAPTURE(transposed(n));
  const auto frame = S::contact_frame(n);
  CHECK(frame.col(0) == n);
  CHECK(rotation_defect(typename S::Matrix(frame)) <= 16 * epsilon<S>);
}

TEST_CASE_TEMPLATE("contact_frame is orthonormal and right-handed", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  Draw<S> draw;
  for (int i = 0; i < 1000; ++i) check_frame<S>(draw.unit());
  // Axes of both signs, and normals close to axes. A frame constructed from one fixed direction
  // fails close to that direction.
  for (int axis = 0; axis < S::dim; ++axis) {
    for (const T sign : {T(1), T(-1)}) {
      for (const T tilt : {T(0), std::numeric_limits<T>::min(), epsilon<S>, T(1e-5), T(1e-3)}) {
        for (int other = 0; other < S::dim; ++other) {
          Vector n = sign * Vector::Unit(axis);
          if (other != axis) n[other] = tilt;
          check_frame<S>(n.normalized());
          if (other != axis) n[other] = -tilt;
          check_frame<S>(n.normalized());
        }
      }
    }
  }
}

TEST_CASE_TEMPLATE("contact_frame accepts zeros of either sign", T,
                   MOREAU_TYPES((double), (float))) {
  using S = Space<3, T>;
  for (const T zero : {T(0), T(-0.0)}) {
    check_frame<S>({T(1), T(0), zero});
    check_frame<S>({T(-1), zero, zero});
    check_frame<S>({zero, zero, T(-1)});
    check_frame<S>({T(0.6), T(0.8), zero});
  }
}

}  // namespace
