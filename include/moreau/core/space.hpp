// SPDX-License-Identifier: MIT
// The algebra that is common to two and three dimensions.
//
// Angular quantities are vectors of length A = D(D-1)/2: one number in the plane, three in space.
// The D x A matrix lever(r) represents all cross products:
//
//     velocity of a point at r from the centre   v + lever(r) w
//     torque of a force f at r                   lever(r)^T f
//     Delassus block                             F^T (1/m + lever(r) I^-1 lever(r)^T) F
//
// Mechanics that is written with lever(r) is the same code in both dimensions. What depends on the dimension is here, in
// the geometry of shapes, meshes and pairs (shape/, mesh/, detect/), and in the few headers that .ci/check_headers names.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

#include "moreau/core/compiler.hpp"
#include "moreau/core/components.hpp"
#include "moreau/core/small_matrix.hpp"

namespace moreau {

/// Types and operations of a D-dimensional Euclidean space with scalars of type T; specialised for
/// D = 2 and 3.
template <int Dim, std::floating_point T = double>
struct Space;

namespace detail {

template <class S>
inline constexpr bool is_space = false;
template <int Dim, class T>
inline constexpr bool is_space<Space<Dim, T>> = true;

/// The types of a space. An angular quantity has A = D(D-1)/2 components.
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
  using Twist = Eigen::Matrix<T, dofs, 1>;  ///< generalized velocity (v, w) or force (force,
                                            ///< torque) of a body
  using Rotation = RotationT;
  using VectorArgument = Components<dim, T>;  ///< argument type of public functions for Vector
  using AngularArgument = Components<angular_dim, T>;  ///< argument type of public functions for
                                                       ///< Angular
};

}  // namespace detail

/// Space<2, T> or Space<3, T>: the parameter of templates for both dimensions.
template <class S>
concept EuclideanSpace = detail::is_space<S>;

/// The plane. Rotations are angles, positive from x to y. Angular quantities are vectors with one
/// component.
template <std::floating_point T>
struct Space<2, T> : detail::SpaceTypes<2, T, Eigen::Rotation2D<T>> {
  using Types = detail::SpaceTypes<2, T, Eigen::Rotation2D<T>>;
  using typename Types::Angular, typename Types::Inertia, typename Types::Lever;
  using typename Types::Vector, typename Types::Matrix, typename Types::Rotation;
  using typename Types::VectorArgument, typename Types::AngularArgument;

  /// The rotation by the angle w [rad].
  static Rotation exp(const AngularArgument& w) { return Rotation(w[0]); }
  /// The same rotation with an angle in [-pi, pi], so that small rotations are not lost beside many turns.
  static Rotation normalized(const Rotation& q) {
    constexpr T pi = std::numbers::pi_v<T>;
    return std::abs(q.angle()) <= pi ? q : Rotation(std::remainder(q.angle(), 2 * pi));
  }
  static Rotation identity() { return Rotation(T(0)); }  ///< no rotation
  /// w with exp(w) = q and |w| <= pi [rad].
  static Angular log(const Rotation& q) { return Angular(normalized(q).angle()); }
  /// Whether the angle is finite.
  static bool is_finite(const Rotation& q) { return std::isfinite(q.angle()); }
  /// Whether q is a valid rotation. Every finite angle is one.
  static bool is_rotation(const Rotation& q) { return is_finite(q); }
  /// The A x A matrix that maps angular quantities from body to world axes. In the plane it is the
  /// identity.
  static Inertia adjoint(const Rotation&) { return Inertia::Ones(); }
  /// The A x A contact frame of angular quantities. In the plane they have one axis, so it is the
  /// identity.
  static Inertia angular_frame(const Matrix&) { return Inertia::Ones(); }
  /// The D x A matrix [m] for which lever(r) w is the velocity [m/s] of a point at r [m] in a
  /// rotation with the angular velocity w [rad/s] about the origin.
  static Lever lever(const VectorArgument& r) { return Lever(-r.y(), r.x()); }
  /// lever(r) w [m/s], computed without forming the matrix.
  static Vector spin(const AngularArgument& w, const VectorArgument& r) {
    return {-w[0] * r.y(), w[0] * r.x()};
  }
  /// lever(r)^T f, computed without forming the matrix: the torque about the origin [N m] of a
  /// force f [N] at r [m].
  static Angular moment(const VectorArgument& r, const VectorArgument& f) {
    return Angular(r.x() * f.y() - r.y() * f.x());
  }
  /// The gyroscopic torque w x I w [N m] for an inertia I [kg m^2] and an angular velocity w
  /// [rad/s]. In the plane it is zero.
  static Angular gyroscopic(const Inertia&, const AngularArgument&) { return Angular::Zero(); }
  /// The A x A matrix for which turning(l) dr is the change of an angular quantity l in a small rotation dr [rad].
  /// In the plane it is zero.
  static Inertia turning(const AngularArgument&) { return Inertia::Zero(); }
  /// D x D, orthonormal, right-handed. The columns are the normal n and the tangent t.
  /// @param n  must be unit
  static Matrix contact_frame(const VectorArgument& n) {
    Matrix frame;
    frame << n.x(), -n.y(), n.y(), n.x();
    return frame;
  }
};

/// Three-dimensional space. Rotations are unit quaternions. Angular quantities are vectors in world
/// axes, unless their name ends in _body.
template <std::floating_point T>
struct Space<3, T> : detail::SpaceTypes<3, T, Eigen::Quaternion<T>> {
  using Types = detail::SpaceTypes<3, T, Eigen::Quaternion<T>>;
  using typename Types::Angular, typename Types::Inertia, typename Types::Lever;
  using typename Types::Vector, typename Types::Matrix, typename Types::Rotation;
  using typename Types::VectorArgument, typename Types::AngularArgument;

  /// The rotation about w by the angle |w| [rad].
  static Rotation exp(const AngularArgument& w) {
    const T half = w.norm() / T(2);
    // For small x, sin(x)/x is computed by its series, because the quotient would lose digits. The
    // first neglected terms are -x^6/5040 and, of the cosine, x^8/40320.
    T sinc, cosine;
    if (half < T(1e-2)) {
      const T x = half * half;
      sinc = T(1) - x / T(6) * (T(1) - x / T(20));
      cosine = T(1) - x / T(2) * (T(1) - x / T(12) * (T(1) - x / T(30)));
    } else {
      sinc = std::sin(half) / half;
      cosine = std::cos(half);
    }
    const T scale = sinc / T(2);
    return Rotation(cosine, scale * w[0], scale * w[1], scale * w[2]);
  }
  /// Removes the rounding errors that many small rotations cause: q scaled to unit length. Over many steps the length of q
  /// is 1 on average: q divided by |q| would stay above 1, because an excess of one rounding vanishes in the square root, and
  /// spin_after() would then change the angular momentum by two roundings in each step.
  static Rotation normalized(const Rotation& q) {
    const auto& c = q.coeffs();
    const T a = c[0] * c[0] + c[1] * c[1], b = c[2] * c[2] + c[3] * c[3];
    const T excess = (std::max(a, b) - T(1)) + std::min(a, b);  // |q|^2 - 1
    // The first neglected term of 1/|q| is 3/8 of the square.
    if (!(excess * excess < std::numeric_limits<T>::epsilon() / T(4))) return q.normalized();
    const T half = excess / T(2);
    return Rotation(q.w() - half * q.w(), q.x() - half * q.x(), q.y() - half * q.y(),
                    q.z() - half * q.z());
  }
  static Rotation identity() { return Rotation::Identity(); }  ///< no rotation
  /// w with exp(w) = q and |w| <= pi [rad].
  static Angular log(const Rotation& q) {
    const T sine = q.vec().norm(), cosine = q.w();  // of half the angle
    if (!(sine > 0)) return 2 * q.vec();
    const T half = cosine < 0 ? std::atan2(-sine, -cosine) : std::atan2(sine, cosine);
    return Angular(2 * half / sine * q.vec());
  }
  /// Whether all components are finite.
  static bool is_finite(const Rotation& q) { return all_finite(q.coeffs()); }
  /// Whether q is a valid rotation: a quaternion of unit length, within 1e-5.
  static bool is_rotation(const Rotation& q) { return std::abs(q.squaredNorm() - T(1)) < T(1e-5); }
  /// The A x A matrix that maps angular quantities from body to world axes.
  static Inertia adjoint(const Rotation& q) { return q.toRotationMatrix(); }
  /// The A x A contact frame of angular quantities, with the columns n, t, s.
  static Inertia angular_frame(const Matrix& frame) { return frame; }
  /// The D x A matrix [m] for which lever(r) w = w x r.
  static Lever lever(const VectorArgument& r) {
    Lever l;
    l << T(0), r.z(), -r.y(), -r.z(), T(0), r.x(), r.y(), -r.x(), T(0);
    return l;
  }
  /// lever(r) w = w x r [m/s], computed without forming the matrix.
  static Vector spin(const AngularArgument& w, const VectorArgument& r) { return w.cross(r); }
  /// lever(r)^T f = r x f, computed without forming the matrix: the torque about the origin [N m]
  /// of a force f [N] at r [m].
  static Angular moment(const VectorArgument& r, const VectorArgument& f) { return r.cross(f); }
  /// The gyroscopic torque w x I w [N m] for an inertia I [kg m^2] and an angular velocity w
  /// [rad/s], both in the same axes.
  static Angular gyroscopic(const Inertia& I, const AngularArgument& w) { return w.cross(I * w); }
  /// The A x A matrix for which turning(l) dr = dr x l is the change of an angular quantity l in a small rotation
  /// dr [rad].
  static Inertia turning(const AngularArgument& l) { return lever(l); }
  /// D x D, orthonormal, right-handed. The columns are the normal n and the tangents t and s.
  /// Source: T. Duff et al., "Building an orthonormal basis, revisited", JCGT 6 (2017).
  /// @param n  must be unit
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

/// The space in which a twist has the type of this vector. The vector has D + A components.
template <class Twist>
using SpaceOfTwist =
    typename detail::SpaceOfDofs<Twist::RowsAtCompileTime, typename Twist::Scalar>::type;

}  // namespace moreau
