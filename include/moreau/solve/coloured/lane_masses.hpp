// SPDX-License-Identifier: MIT
// Velocities, impulses and inverse masses of one body per SIMD lane, in world axes.
//
// A contact with the frame F and the levers l_a, l_b changes the velocities by
//
//     p = F r,     v_b += p / m_b,   w_b += I_b^-1 (l_b x p),    v_a, w_a: with -p,
//
// so that a point needs its frame and levers, 15 numbers in space, and not the 36 of its rows in J.
// What remains of the rows, 1/m and I^-1, belongs to the pair.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "moreau/body/mobility.hpp"
#include "moreau/contact/lane_block.hpp"

namespace moreau::detail {

/// Products of vectors and symmetric matrices.
template <class S>
struct LaneAlgebra {
  using Values = typename LaneBlock<S>::Values;
  static constexpr std::size_t dim = S::dim, angular = S::angular_dim;
  using Vector = std::array<Values, dim>;
  /// The lower triangle, row after row.
  template <std::size_t N>
  using Symmetric = std::array<Values, N*(N + 1) / 2>;

  /// Velocity of a point of a body [m/s].
  /// @param v     v and w of the body [m/s, rad/s]
  /// @param lever from the centre of the body to the point [m]
  static Vector point_velocity(const auto& v, const Vector& lever) {
    Vector u = spin(v, lever);
    for (std::size_t k = 0; k < dim; ++k) u[k] += v[k];
    return u;
  }
  /// lever x p
  static std::array<Values, 3> moment(const std::array<Values, 3>& lever,
                                      const std::array<Values, 3>& p) {
    return {lever[1] * p[2] - lever[2] * p[1], lever[2] * p[0] - lever[0] * p[2],
            lever[0] * p[1] - lever[1] * p[0]};
  }
  static std::array<Values, 1> moment(const std::array<Values, 2>& lever,
                                      const std::array<Values, 2>& p) {
    return {lever[0] * p[1] - lever[1] * p[0]};
  }
  template <std::size_t N>
  static std::array<Values, N> product(const Symmetric<N>& m, const std::array<Values, N>& x) {
    std::array<Values, N> y;
    for (std::size_t i = 0; i < N; ++i) {
      y[i] = m[entry(i, 0)] * x[0];
      for (std::size_t k = 1; k < N; ++k) y[i] += m[entry(i, k)] * x[k];
    }
    return y;
  }
  /// Sets the matrix of a lane to root^2.
  /// @param root N x N, symmetric
  template <std::size_t N>
  static void set_square(Symmetric<N>& m, std::size_t lane, const auto& root) {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        m[entry(i, k)][lane] = root.row(Eigen::Index(i)).dot(root.row(Eigen::Index(k)));
  }

 private:
  /// w x lever
  static std::array<Values, 3> spin(const auto& v, const std::array<Values, 3>& lever) {
    return {v[4] * lever[2] - v[5] * lever[1], v[5] * lever[0] - v[3] * lever[2],
            v[3] * lever[1] - v[4] * lever[0]};
  }
  static std::array<Values, 2> spin(const auto& v, const std::array<Values, 2>& lever) {
    return {-(v[2] * lever[1]), v[2] * lever[0]};
  }
  static constexpr std::size_t entry(std::size_t i, std::size_t k) {
    return i < k ? entry(k, i) : i * (i + 1) / 2 + k;
  }
};

/// Whether the mass of a body is the same along all axes. That of a wall is not: it moves along one.
template <class S>
bool is_isotropic(const MobilityRoot<S>& root) {
  using T = typename S::Scalar;
  const T first = root.linear(0, 0);
  T largest = 0;
  for (int i = 0; i < S::dim; ++i)
    for (int k = 0; k < S::dim; ++k)
      largest = std::max(largest, std::abs(root.linear(i, k) - (i == k ? first : T(0))));
  return largest <= 8 * std::numeric_limits<T>::epsilon() * first;
}

/// Inverse masses of bodies whose mass is the same along all axes. For other bodies `linear` has no
/// meaning.
template <class S>
struct LaneMass {
  using Algebra = LaneAlgebra<S>;
  typename Algebra::Values linear{};                                 ///< 1/m [1/kg]
  typename Algebra::template Symmetric<Algebra::angular> angular{};  ///< I^-1 [1/(kg m^2)]

  void set(std::size_t lane, const MobilityRoot<S>& root) {
    linear[lane] = root.linear(0, 0) * root.linear(0, 0);
    Algebra::template set_square<Algebra::angular>(angular, lane, root.angular);
  }
};

/// Inverse masses of bodies along all axes, a and b of each pair of a group [1/kg].
template <class S>
struct LaneMassMatrices {
  using Algebra = LaneAlgebra<S>;
  typename Algebra::template Symmetric<Algebra::dim> a{}, b{};

  void set(std::size_t lane, const MobilityRoot<S>& of_a, const MobilityRoot<S>& of_b) {
    Algebra::template set_square<Algebra::dim>(a, lane, of_a.linear);
    Algebra::template set_square<Algebra::dim>(b, lane, of_b.linear);
  }
};

}  // namespace moreau::detail
