// SPDX-License-Identifier: MIT
// Exact volume, first moment and second moment of a polytope, as a sum over simplices.
//
// A polytope is divided into simplices (triangles in the plane, tetrahedra in space). Each simplex
// has one corner at the origin and the other corners v_1..v_D on the surface of the polytope. The
// moments of the polytope are the sums of the signed moments of the simplices. With s = sum v_k,
// the moments of one simplex are
//
//     V = det[v_1..v_D] / D!      int x = V s / (D+1)
//     int x x^T = V / ((D+1)(D+2)) (sum v_k v_k^T + s s^T)
//
// Source: F. Tonon, "Explicit exact formulas for the 3-D tetrahedron inertia tensor in terms of its
// vertex coordinates", J. Math. Stat. 1 (2005). The form above holds in any dimension.
#pragma once

#include <cmath>

#include "moreau/core/small_matrix.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// Moments about the origin of a body with density one [-], in the axes of its coordinates. The
/// formulas and their source are given at the top of this file.
template <class S>
struct Moments {
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;

  Scalar volume = 0;               ///< [m^D]
  Vector first = Vector::Zero();   ///< int x [m^(D+1)]
  Matrix second = Matrix::Zero();  ///< int x x^T, D x D [m^(D+2)]

  /// Adds the simplex whose corners are the origin and the columns of v, D x D [m]. Its moments are
  /// negative if the columns are left-handed (the determinant is negative).
  void add_simplex(const Matrix& v) {
    const Scalar part = v.determinant() / factorial(S::dim);
    const Matrix products = product_with_transposed(v, v);
    Vector s = v.col(S::dim - 1);
    for (int k = S::dim - 2; k >= 0; --k)
      for (int i = 0; i < S::dim; ++i) s[i] = v(i, k) + s[i];
    volume += part;
    for (int i = 0; i < S::dim; ++i) {
      first[i] += part / Scalar(S::dim + 1) * s[i];
      for (int j = 0; j < S::dim; ++j)
        second(i, j) += part / Scalar((S::dim + 1) * (S::dim + 2)) * (products(i, j) + s[i] * s[j]);
    }
  }

  /// Adds the moments of another body.
  Moments& operator+=(const Moments& other) {
    volume += other.volume;
    first += other.first;
    second += other.second;
    return *this;
  }

  /// The moments of the same body about its own centre, first / volume. The volume must not be 0.
  Moments centered() const {
    // first * first^T would leave the range of single precision at 1e-5 m and at 1e5 m.
    const Vector center = first / volume;
    return {volume, Vector::Zero(), second - center * first.transpose()};
  }

  /// Whether the scalar type can represent the moments. They overflow or underflow if the shape is
  /// far too large or far too small.
  bool are_regular() const {
    const typename S::Inertia about_origin = inertia();
    bool regular = std::isfinite(volume) && volume > 0 && all_finite(about_origin);
    for (int k = 0; k < S::angular_dim; ++k) regular = regular && about_origin(k, k) > 0;
    return regular;
  }

  /// The factorial n!.
  static constexpr Scalar factorial(int n) { return n < 2 ? 1 : Scalar(n) * factorial(n - 1); }

  /// The moments of the same body with all lengths multiplied by `factor` [-].
  Moments scaled(Scalar factor) const {
    const Scalar of_volume = std::pow(factor, Scalar(S::dim));
    return {of_volume * volume, of_volume * factor * first, of_volume * factor * factor * second};
  }

  /// The inertia about the origin at density one, int lever(x)^T lever(x), A x A [m^(D+2)].
  typename S::Inertia inertia() const {
    typename S::Inertia sum = S::Inertia::Zero();
    for (int i = 0; i < S::dim; ++i) {
      const typename S::Lever left = S::lever(unit(i));
      for (int j = 0; j < S::dim; ++j) {
        const typename S::Lever right = S::lever(unit(j));
        for (int k = 0; k < S::angular_dim; ++k)
          for (int l = 0; l < S::angular_dim; ++l) {
            Scalar entry = 0;
            for (int d = 0; d < S::dim; ++d) entry += left(d, k) * right(d, l);
            sum(k, l) += second(i, j) * entry;
          }
      }
    }
    return sum;
  }

 private:
  static Vector unit(int axis) {
    Vector e = Vector::Zero();
    e[axis] = 1;
    return e;
  }
};

}  // namespace moreau
