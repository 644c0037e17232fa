// SPDX-License-Identifier: MIT
// The side of a line or plane on which a point lies, with the exact sign.
//
// The determinant is evaluated in double precision, together with a bound of its rounding error. If
// the bound is larger than the absolute value of the determinant, the determinant is evaluated
// again without rounding errors, as a sum of doubles that do not overlap (an expansion). A hull
// computed with exact signs is closed and convex for every input. The functions need IEEE
// arithmetic (no -ffast-math) and coordinates of order one (no overflow, no underflow). Source: J.
// R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
// Discrete Comput. Geom. 18 (1997), theorems 6, 10, 18, and the bounds of section 4.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstddef>

#include "moreau/core/list.hpp"

namespace moreau {

namespace detail {

/// A real number, stored as a sum of doubles in ascending order of magnitude that do not overlap.
class Expansion {
 public:
  Expansion() = default;

  /// a - b without rounding error.
  static Expansion difference(double a, double b) {
    Expansion e;
    e.add(a);
    e.add(-b);
    return e;
  }

  /// Adds a number. Rarely called: most signs follow from double precision alone.
  [[gnu::cold, gnu::noinline]] void add(double x) {
    std::size_t kept = 0;
    for (const double term : terms_) {
      const double sum = x + term;
      const double of_term = sum - x;
      const double error = (x - (sum - of_term)) + (term - of_term);
      if (error != 0) terms_[kept++] = error;
      x = sum;
    }
    terms_.resize(kept);
    if (x != 0) terms_.push_back(x);
  }
  Expansion& operator+=(const Expansion& other) {
    for (const double term : other.terms_) add(term);
    return *this;
  }
  Expansion& operator-=(const Expansion& other) {
    for (const double term : other.terms_) add(-term);
    return *this;
  }
  friend Expansion operator*(const Expansion& a, const Expansion& b) {
    Expansion product;
    for (const double x : a.terms_) {
      for (const double y : b.terms_) {
        const double high = x * y;
        product.add(std::fma(x, y, -high));
        product.add(high);
      }
    }
    return product;
  }
  /// The largest term, which has the sign of the sum.
  double leading() const { return terms_.empty() ? 0.0 : terms_.back(); }

 private:
  List<double> terms_;
};

/// a d - b c without rounding error.
[[gnu::cold]] inline Expansion minor(const Expansion& a, const Expansion& b, const Expansion& c,
                                     const Expansion& d) {
  Expansion m = a * d;
  m -= b * c;
  return m;
}

[[gnu::cold]] inline double exact_orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                              const Eigen::Vector2d& c) {
  return minor(Expansion::difference(b.x(), a.x()), Expansion::difference(b.y(), a.y()),
               Expansion::difference(c.x(), a.x()), Expansion::difference(c.y(), a.y()))
      .leading();
}

[[gnu::cold]] inline double exact_orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                              const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  Expansion u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = Expansion::difference(b[k], a[k]);
    v[k] = Expansion::difference(c[k], a[k]);
    w[k] = Expansion::difference(d[k], a[k]);
  }
  Expansion det = minor(u[1], u[2], v[1], v[2]) * w[0];
  det += minor(u[2], u[0], v[2], v[0]) * w[1];
  det += minor(u[0], u[1], v[0], v[1]) * w[2];
  return det.leading();
}

}  // namespace detail

/// Twice the signed area of the triangle abc, in the square of the coordinates' unit. Its sign is
/// exact: > 0 if c lies to the left of the line from a to b. The top of this file states the
/// allowed range of the coordinates and the source.
inline double orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                          const Eigen::Vector2d& c) {
  constexpr double epsilon = 0x1p-53, bound = (3 + 16 * epsilon) * epsilon;
  const Eigen::Vector2d u = b - a, v = c - a;
  const double left = u.x() * v.y(), right = u.y() * v.x();
  const double det = left - right;
  if (std::abs(det) > bound * (std::abs(left) + std::abs(right))) return det;
  return detail::exact_orientation(a, b, c);
}

/// Six times the signed volume of the tetrahedron abcd, in the cube of the coordinates' unit. Its
/// sign is exact: > 0 if a, b, c are counter-clockwise seen from d.
inline double orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
  constexpr double epsilon = 0x1p-53, bound = (7 + 56 * epsilon) * epsilon;
  const Eigen::Vector3d u = b - a, v = c - a, w = d - a;
  const double xy = u.x() * v.y(), yx = u.y() * v.x();
  const double yz = u.y() * v.z(), zy = u.z() * v.y();
  const double zx = u.z() * v.x(), xz = u.x() * v.z();
  const double det = (yz - zy) * w.x() + (zx - xz) * w.y() + (xy - yx) * w.z();
  const double size = (std::abs(yz) + std::abs(zy)) * std::abs(w.x()) +
                      (std::abs(zx) + std::abs(xz)) * std::abs(w.y()) +
                      (std::abs(xy) + std::abs(yx)) * std::abs(w.z());
  if (std::abs(det) > bound * size) return det;
  return detail::exact_orientation(a, b, c, d);
}

}  // namespace moreau
