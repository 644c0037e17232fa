// SPDX-License-Identifier: MIT
// The one algebra for two and three dimensions.
//
// Angular quantities are vectors of length A = D(D-1)/2: one number in the plane, three in space.
// The matrix lever(r), D x A, carries every cross product:
//
//     velocity of a point at r from the centre   v + lever(r) w
//     torque of a force f at r                   lever(r)^T f
//     Delassus block                             F^T (1/m + lever(r) I^-1 lever(r)^T) F
//
// The mechanics, written with lever(r), is the same text in both dimensions. Only this header and
// the geometry of single shapes know the dimension.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <concepts>

#include "moreau/core/components.hpp"
#include "moreau/core/small_matrix.hpp"

namespace moreau {

/// Types and operations of a D-dimensional Euclidean space over T; specialised for D = 2 and 3.
template <int Dim, std::floating_point T = double>
struct Space;

namespace detail {

template <class S>
inline constexpr bool is_space = false;
template <int Dim, class T>
inline constexpr bool is_space<Space<Dim, T>> = true;

/// The types of a space. A = D(D-1)/2 numbers make an angular quantity.
template <int Dim, class T, class RotationT>
struct SpaceTypes {
  using Scalar = T;
  static constexpr int dim = Dim;                          ///< D
  static constexpr int angular_dim = Dim * (Dim - 1) / 2;  ///< A
  static constexpr int dofs = dim + angular_dim;           ///< D + A

  using Vector = Eigen::Matrix<T, dim, 1>;
  using Matrix = Eigen::Matrix<T, dim, dim>;
  using Angular = Eigen::Matrix<T, angular_dim, 1>;
  using Inertia = Eigen::Matrix<T, angular_dim, angular_dim>;
  using Lever = Eigen::Matrix<T, dim, angular_dim>;
  using Twist = Eigen::Matrix<T, dofs, 1>;  ///< (v, w), generalized velocity or force of a body
  using Rotation = RotationT;
  using VectorArgument = Components<dim, T>;           ///< of public functions
  using AngularArgument = Components<angular_dim, T>;  ///< of public functions
};

}  // namespace detail

/// A Space<2, T> or Space<3, T>: the argument of templates for both dimensions.
template <class S>
concept EuclideanSpace = detail::is_space<S>;

/// The plane. Rotations are angles, positive from x to y; angular quantities are 1-vectors.
template <std::floating_point T>
struct Space<2, T> : detail::SpaceTypes<2, T, Eigen::Rotation2D<T>> {
  using Types = detail::SpaceTypes<2, T, Eigen::Rotation2D<T>>;
  using typename Types::Angular, typename Types::Inertia, typename Types::Lever;
  using typename Types::Vector, typename Types::Matrix, typename Types::Rotation;
  using typename Types::VectorArgument, typename Types::AngularArgument;

  /// The rotation by the angle w [rad].
  static Rotation exp(const AngularArgument& w) { return Rotation(w[0]); }
  /// q without the rounding errors of many small rotations: an angle has none of this kind.
  static Rotation normalized(const Rotation& q) { return q; }
  static Rotation identity() { return Rotation(T(0)); }  ///< no rotation
  /// Whether the angle is finite.
  static bool is_finite(const Rotation& q) { return std::isfinite(q.angle()); }
  /// Whether q is a rotation: every finite angle is one.
  static bool is_rotation(const Rotation& q) { return is_finite(q); }
  /// A x A, takes angular quantities from body to world axes: the identity in the plane.
  static Inertia adjoint(const Rotation&) { return Inertia::Ones(); }
  /// A x A, the contact frame of angular quantities, which have one axis in the plane.
  static Inertia angular_frame(const Matrix&) { return Inertia::Ones(); }
  /// D x A [m] with lever(r) w = the velocity [m/s] at r [m] of a rotation w [rad/s] about the
  /// origin.
  static Lever lever(const VectorArgument& r) { return Lever(-r.y(), r.x()); }
  /// lever(r) w without forming the matrix [m/s].
  static Vector spin(const AngularArgument& w, const VectorArgument& r) {
    return {-w[0] * r.y(), w[0] * r.x()};
  }
  /// lever(r)^T f without forming the matrix: the torque about the origin of f at r [N m].
  static Angular moment(const VectorArgument& r, const VectorArgument& f) {
    return Angular(r.x() * f.y() - r.y() * f.x());
  }
  /// w x I w [N m] of an inertia I [kg m^2], w [rad/s]: zero in the plane.
  static Angular gyroscopic(const Inertia&, const AngularArgument&) { return Angular::Zero(); }
  /// A x A, derivative of I(q) w at fixed w along a rotation [kg m^2/s]: zero in the plane.
  static Inertia gyroscopic_jacobian(const Inertia&, const AngularArgument&) {
    return Inertia::Zero();
  }
  /// D x D, orthonormal, right-handed; columns: normal n, tangent t. n must be unit.
  static Matrix contact_frame(const VectorArgument& n) {
    Matrix frame;
    frame << n.x(), -n.y(), n.y(), n.x();
    return frame;
  }
};

/// Space. Rotations are unit quaternions; angular quantities are vectors in world axes unless
/// a name ends in _body.
template <std::floating_point T>
struct Space<3, T> : detail::SpaceTypes<3, T, Eigen::Quaternion<T>> {
  using Types = detail::SpaceTypes<3, T, Eigen::Quaternion<T>>;
  using typename Types::Angular, typename Types::Inertia, typename Types::Lever;
  using typename Types::Vector, typename Types::Matrix, typename Types::Rotation;
  using typename Types::VectorArgument, typename Types::AngularArgument;

  /// The rotation by |w| [rad] about w.
  static Rotation exp(const AngularArgument& w) {
    const T half = w.norm() / T(2);
    // sin(x)/x by its series where the quotient would lose digits; the next term is x^4/120.
    const T sinc = half < T(1e-2) ? T(1) - half * half / T(6) * (T(1) - half * half / T(20))
                                  : std::sin(half) / half;
    const T scale = sinc / T(2);
    return Rotation(std::cos(half), scale * w[0], scale * w[1], scale * w[2]);
  }
  /// q without the rounding errors of many small rotations: of unit length.
  static Rotation normalized(const Rotation& q) { return q.normalized(); }
  static Rotation identity() { return Rotation::Identity(); }  ///< no rotation
  /// Whether all its numbers are finite.
  static bool is_finite(const Rotation& q) { return all_finite(q.coeffs()); }
  /// Whether q is a rotation: a quaternion of unit length.
  static bool is_rotation(const Rotation& q) { return std::abs(q.squaredNorm() - T(1)) < T(1e-5); }
  /// A x A, takes angular quantities from body to world axes.
  static Inertia adjoint(const Rotation& q) { return q.toRotationMatrix(); }
  /// A x A, a contact frame for angular quantities: n, t, s.
  static Inertia angular_frame(const Matrix& frame) { return frame; }
  /// D x A [m] with lever(r) w = w x r.
  static Lever lever(const VectorArgument& r) {
    Lever l;
    l << T(0), r.z(), -r.y(), -r.z(), T(0), r.x(), r.y(), -r.x(), T(0);
    return l;
  }
  /// lever(r) w without forming the matrix [m/s].
  static Vector spin(const AngularArgument& w, const VectorArgument& r) { return w.cross(r); }
  /// lever(r)^T f without forming the matrix: the torque about the origin of f at r [N m].
  static Angular moment(const VectorArgument& r, const VectorArgument& f) { return r.cross(f); }
  /// w x I w [N m] of an inertia I [kg m^2], w [rad/s], both in the same axes.
  static Angular gyroscopic(const Inertia& I, const AngularArgument& w) { return w.cross(I * w); }
  /// A x A, derivative of I(q) w at fixed w along a rotation [kg m^2/s]:
  /// d(I(q) w) = (lever(I w) - I lever(w)) dw, where lever(a) b = b x a.
  static Inertia gyroscopic_jacobian(const Inertia& I, const AngularArgument& w) {
    return lever(I * w) - I * lever(w);
  }
  /// D x D, orthonormal, right-handed; columns: normal n, tangents t and s. n must be unit.
  /// Source: T. Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017).
  static Matrix contact_frame(const VectorArgument& n) {
    const T sign = std::copysign(T(1), n.z());
    const T a = T(-1) / (sign + n.z());
    const T b = n.x() * n.y() * a;
    Matrix frame;
    frame.col(0) = n;
    frame.col(1) << T(1) + sign * n.x() * n.x() * a, sign * b, -sign * n.x();
    frame.col(2) << b, sign + n.y() * n.y() * a, -n.y();
    return frame;
  }
};

namespace detail {

template <int Dofs, class T>
struct SpaceOfDofs;
template <class T>
struct SpaceOfDofs<3, T> {
  using type = Space<2, T>;
};
template <class T>
struct SpaceOfDofs<6, T> {
  using type = Space<3, T>;
};

}  // namespace detail

/// The space whose twists have the type of this vector, D + A entries.
template <class Twist>
using SpaceOfTwist =
    typename detail::SpaceOfDofs<Twist::RowsAtCompileTime, typename Twist::Scalar>::type;

}  // namespace moreau
