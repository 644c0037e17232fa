// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace moreau::detail {

/// Products of vectors and symmetric matrices.
/// @tparam Values of an entry: a number, or a SIMD register with one body per lane
template <class S, class Values>
struct LaneAlgebra {
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
  /// The tangential velocity (w x n) of a point at the normal n = (1, 0[, 0]); the normal one is 0.
  static std::array<Values, 2> spin_of_normal(const std::array<Values, 3>& w) {
    return {w[2], -w[1]};
  }
  static std::array<Values, 1> spin_of_normal(const std::array<Values, 1>& w) { return w; }
  /// n x p for n = (1, 0[, 0])
  static std::array<Values, 3> moment_of_normal(const std::array<Values, 3>& p) {
    return {Values{}, -p[2], p[1]};
  }
  static std::array<Values, 1> moment_of_normal(const std::array<Values, 2>& p) { return {p[1]}; }
  /// An angular quantity in world axes.
  /// @param frame first index: world axis, second: axis of the frame of x; the plane has one axis
  static std::array<Values, 3> to_world(const std::array<std::array<Values, 3>, 3>& frame,
                                        const std::array<Values, 3>& x) {
    std::array<Values, 3> turned;
    for (std::size_t k = 0; k < 3; ++k)
      turned[k] = frame[k][0] * x[0] + frame[k][1] * x[1] + frame[k][2] * x[2];
    return turned;
  }
  static std::array<Values, 1> to_world(const std::array<std::array<Values, 2>, 2>&,
                                        const std::array<Values, 1>& x) {
    return x;
  }
  /// The inverse of to_world().
  static std::array<Values, 3> to_frame(const std::array<std::array<Values, 3>, 3>& frame,
                                        const std::array<Values, 3>& x) {
    std::array<Values, 3> turned;
    for (std::size_t d = 0; d < 3; ++d)
      turned[d] = frame[0][d] * x[0] + frame[1][d] * x[1] + frame[2][d] * x[2];
    return turned;
  }
  static std::array<Values, 1> to_frame(const std::array<std::array<Values, 2>, 2>&,
                                        const std::array<Values, 1>& x) {
    return x;
  }
  template <std::size_t N>
  static std::array<Values, N> product(const Symmetric<N>& m, const std::array<Values, N>& x) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<Values, N>{row<I>(m, x)...};
    }
    (std::make_index_sequence<N>());
  }
  /// Where the entry (i, k) of a Symmetric lies.
  static constexpr std::size_t entry(std::size_t i, std::size_t k) {
    return i < k ? entry(k, i) : i * (i + 1) / 2 + k;
  }

 private:
  /// Entry I of a product. Compilers do not unroll a loop over entry() and would compute it each time.
  template <std::size_t I, std::size_t N>
  static Values row(const Symmetric<N>& m, const std::array<Values, N>& x) {
    return [&]<std::size_t... K>(std::index_sequence<K...>) {
      Values sum = m[std::integral_constant<std::size_t, entry(I, 0)>()] * x[0];
      ((sum += m[std::integral_constant<std::size_t, entry(I, K + 1)>()] * x[K + 1]), ...);
      return sum;
    }
    (std::make_index_sequence<N - 1>());
  }
  /// w x lever
  static std::array<Values, 3> spin(const auto& v, const std::array<Values, 3>& lever) {
    return {v[4] * lever[2] - v[5] * lever[1], v[5] * lever[0] - v[3] * lever[2],
            v[3] * lever[1] - v[4] * lever[0]};
  }
  static std::array<Values, 2> spin(const auto& v, const std::array<Values, 2>& lever) {
    return {-(v[2] * lever[1]), v[2] * lever[0]};
  }
};

}  // namespace moreau::detail
