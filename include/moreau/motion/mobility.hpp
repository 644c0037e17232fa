// SPDX-License-Identifier: MIT
// The inverse of the mass matrix of one body, and its square root.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/core/space.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/simd/lane_algebra.hpp"

namespace moreau {

/// M^-1/2 of one body in world axes, where M is its mass matrix. It is symmetric, and zero along
/// axes along which the motion is prescribed.
template <class S>
struct MobilityRoot {
  typename S::Matrix linear;    ///< for forces, D x D [kg^-1/2]
  typename S::Inertia angular;  ///< for torques, A x A [kg^-1/2 m^-1]
  /// Whether the body is a grain, whose surface is curved for the laws with an effective radius; also
  /// if `angular` is zero because the motion is prescribed. A body that torques rotate counts as a
  /// grain without it.
  bool grain = false;
};

/// M^-1 of one body in world axes. Of both symmetric matrices the lower triangle, row after row.
template <class S>
class InverseMass {
 public:
  using Scalar = typename S::Scalar;
  using Algebra = detail::LaneAlgebra<S, Scalar>;  ///< where the entries of a triangle lie
  /// Of D x D: D (D + 1) / 2 numbers.
  using Linear = typename Algebra::template Symmetric<std::size_t{S::dim}>;
  /// Of A x A: A (A + 1) / 2 numbers.
  using Angular = typename Algebra::template Symmetric<std::size_t{S::angular_dim}>;

  InverseMass() = default;  ///< zero: the motion is prescribed
  /// The square of a root.
  explicit InverseMass(const MobilityRoot<S>& root)
      : linear_(squared<S::dim, Linear>(root.linear)),
        angular_(squared<S::angular_dim, Angular>(root.angular)) {}

  const Linear& linear() const { return linear_; }     ///< of D x D [1/kg]
  const Angular& angular() const { return angular_; }  ///< of A x A [1/(kg m^2)]
  /// Whether impulses move the body at all.
  bool moves() const {
    for (const Scalar x : linear_)
      if (x != 0) return true;
    for (const Scalar x : angular_)
      if (x != 0) return true;
    return false;
  }
  /// Whether impulses rotate the body.
  bool rotates() const {
    return std::any_of(angular_.begin(), angular_.end(), [](Scalar x) { return x != 0; });
  }
  /// Whether the mass of the body is the same along all axes. That of a wall
  /// with a mass is not: it moves along one.
  bool is_isotropic() const {
    constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();
    Scalar largest = 0;
    for (std::size_t i = 0; i < S::dim; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        largest = std::max(
            largest, std::abs(linear_[Algebra::entry(i, k)] - (i == k ? linear_[0] : Scalar(0))));
    return largest <= rounding * linear_[0];
  }
  /// The change of velocity [m/s] by an impulse [N s].
  typename S::Vector velocity_of(const typename S::Vector& impulse) const {
    return times<typename S::Vector, S::dim>(linear_, impulse);
  }
  /// The change of angular velocity [rad/s] by an angular impulse [N m s].
  typename S::Angular spin_of(const typename S::Angular& impulse) const {
    return times<typename S::Angular, S::angular_dim>(angular_, impulse);
  }
  /// Adds to a twist what an impulse at the centre [N s] and an angular impulse [N m s] change.
  template <class Twist>
  void add_change(Twist& twist, const typename S::Vector& impulse,
                  const typename S::Angular& moment) const {
    moreau::linear<S>(twist) += velocity_of(impulse);
    moreau::angular<S>(twist) += spin_of(moment);
  }

 private:
  template <int N, class Symmetric>
  static Symmetric squared(const auto& root) {
    Symmetric m;
    for (int i = 0; i < N; ++i)
      for (int k = 0; k <= i; ++k) {
        Scalar& entry = m[Algebra::entry(std::size_t(i), std::size_t(k))];
        entry = 0;
        for (int j = 0; j < N; ++j) entry += root(i, j) * root(k, j);
      }
    return m;
  }
  template <class Vector, std::size_t N>
  static Vector times(const auto& m, const Vector& x) {
    std::array<Scalar, N> of_x;
    for (std::size_t k = 0; k < N; ++k) of_x[k] = x[Eigen::Index(k)];
    const auto product = Algebra::template product<N>(m, of_x);
    return Eigen::Map<const Vector>(product.data());
  }

  Linear linear_{};
  Angular angular_{};
};

}  // namespace moreau
