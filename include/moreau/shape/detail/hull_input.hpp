// SPDX-License-Identifier: MIT
// The input of a convex hull computation: the given points after checking, scaling, sorting and
// removal of duplicates.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "moreau/shape/detail/vertices.hpp"

namespace moreau {

/// Tolerances of convex hulls. Each is a length divided by the machine epsilon of the scalar type
/// and by the size of the input, its largest coordinate [-].
struct HullTolerance {
  double flat = 32;  ///< a vertex closer to the plane of a face (line of an edge) than this lies on
                     ///< it
  double thin = 512;  ///< points thinner than this are coplanar (collinear), which is an error
};

namespace detail {

/// The points converted to double, divided by a power of two (which is exact) so that the largest
/// coordinate is of order one, and sorted in lexicographic order. A point closer to an earlier
/// point than the tolerance is removed.
template <int Dim>
struct HullInput {
  using Point = Eigen::Matrix<double, Dim, 1>;

  std::vector<Point> points;
  std::vector<std::uint32_t> labels;  ///< index of each point in the caller's input
  double unit = 1;                    ///< the length [m] of one unit of the scaled coordinates
  double rounding = 0;                ///< rounding error of the largest coordinate, in scaled units
  double flat = 0, thin = 0;          ///< HullTolerance, in scaled units

  template <class Vector>
  HullInput(std::span<const Vector> given, std::string_view function) {
    require(given.size() > Dim, function, "vertices.size()", given.size(),
            "must be at least " + std::to_string(Dim + 1));
    require_finite(given, function);
    double size = 0;
    for (const Vector& x : given)
      for (int k = 0; k < Dim; ++k) size = std::max(size, std::abs(double(x[k])));
    unit = size > 0 ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
    rounding = std::numeric_limits<typename Vector::Scalar>::epsilon() * size / unit;
    flat = HullTolerance{}.flat * rounding;
    thin = HullTolerance{}.thin * rounding;
    sort(given);
  }

  /// @throws std::invalid_argument always. The message contains the extent that is too small, given
  ///                               in scaled units, and the finding, for example that the points
  ///                               coincide
  [[noreturn]] void throw_thin(std::string_view function, double extent,
                               std::string_view finding) const {
    throw_invalid(function, "thickness of vertices", extent * unit,
                  "m must not vanish: " + std::string(finding));
  }

 private:
  template <class Vector>
  void sort(std::span<const Vector> given) {
    std::vector<Point> scaled;
    for (const Vector& x : given) scaled.push_back(in_units(x.template cast<double>()));
    std::vector<std::uint32_t> order(given.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Point &x = scaled[a], &y = scaled[b];
      for (int k = 0; k < Dim; ++k)
        if (x[k] != y[k]) return x[k] < y[k];
      return a < b;
    });
    for (const std::uint32_t i : order) {
      if (has_neighbour(scaled[i])) continue;
      points.push_back(scaled[i]);
      labels.push_back(i);
    }
  }
  /// Divides by `unit`. Coordinates below 2^-200 become zero. All coordinates are then multiples of
  /// 2^-253. So products of three differences do not underflow, and the signs of determinants are
  /// exact.
  Point in_units(const Point& x) const {
    Point scaled;
    for (int k = 0; k < Dim; ++k) {
      const double coordinate = x[k] / unit;
      scaled[k] = std::abs(coordinate) < std::ldexp(1.0, -200) ? 0.0 : coordinate;
    }
    return scaled;
  }
  bool has_neighbour(const Point& x) const {
    for (auto y = points.rbegin(); y != points.rend() && x[0] - (*y)[0] <= flat; ++y) {
      if ((x - *y).norm() <= flat) return true;
    }
    return false;
  }
};

}  // namespace detail

}  // namespace moreau
