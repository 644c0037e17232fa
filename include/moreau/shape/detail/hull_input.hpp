// SPDX-License-Identifier: MIT
// The input of a convex hull computation: the given points after checking, scaling, sorting and
// removal of duplicates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "moreau/core/list.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/shape/detail/index_table.hpp"
#include "moreau/shape/detail/vertices.hpp"

namespace moreau {

/// Tolerances of convex hulls. Each is a length divided by the machine epsilon of the scalar type
/// and by the size of the input, its largest coordinate [-].
struct HullTolerance {
  double flat = 32;  ///< a vertex closer to the plane of a face (line of an edge) than this lies on
                     ///< it
  double thin = 512;  ///< points thinner than this are coplanar (collinear), which is an error
  /// The same as `flat` of points whose rounding is given, divided by this rounding. If each coordinate of the corners of a
  /// square is wrong by at most the rounding, the plane through three of them misses the fourth by at most 4 sqrt(3) = 6.9 of it.
  double rounded = 8;
};

namespace detail {

/// Finds whether a list has a point within a distance of another point. The points of a list with
/// more than a few points are hashed by cells that are much wider than the distance, so that mostly
/// one cell has to be looked at.
template <class Point>
class NearPoints {
 public:
  /// @param points   the list, which may grow: call add_last() after each new point
  /// @param distance in the unit of the points, > 0
  NearPoints(const std::vector<Point>& points, double distance)
      : points_(points), distance_(distance) {}

  void add_last() {
    const auto last = static_cast<std::uint32_t>(points_.size() - 1);
    if (points_.size() < few) return;
    if (points_.size() == few)
      for (std::uint32_t i = 0; i < last; ++i) put(i);
    put(last);
  }
  bool has_neighbour(const Point& x) const {
    const auto is_near = [&](const Point& y) { return (x - y).norm() <= distance_; };
    if (points_.size() < few) return std::any_of(points_.begin(), points_.end(), is_near);
    Cell last{};
    for (int corner = 0; corner < 1 << Point::RowsAtCompileTime; ++corner) {
      Point at = x;
      for (int k = 0; k < at.size(); ++k) at[k] += (corner >> k & 1) != 0 ? distance_ : -distance_;
      const Cell cell = cell_of(at);
      // Mostly all corners lie in one cell.
      if (corner > 0 && cell == last) continue;
      last = cell;
      for (std::uint32_t i = first_.find(hash_of(cell)); i != none; i = next_[i])
        if (is_near(points_[i])) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t few = 32;
  static constexpr std::uint32_t none = IndexTable::none;
  using Cell = std::array<std::int64_t, std::size_t(Point::RowsAtCompileTime)>;

  Cell cell_of(const Point& x) const {
    Cell cell;
    // The offset keeps round numbers off the borders of cells.
    for (std::size_t k = 0; k < cell.size(); ++k)
      cell[k] = static_cast<std::int64_t>(std::floor(x[Eigen::Index(k)] / (64 * distance_) + 0.3));
    return cell;
  }
  static std::uint64_t hash_of(const Cell& cell) {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15U;
      hash ^= hash >> 32;
    }
    return hash;
  }
  void put(std::uint32_t i) {
    next_.resize(points_.size(), none);
    std::uint32_t& first = first_[hash_of(cell_of(points_[i]))];
    next_[i] = first;
    first = i;
  }

  const std::vector<Point>& points_;
  double distance_;
  IndexTable first_;          // the last point of each cell
  List<std::uint32_t> next_;  // the point of the same cell before it
};

/// The points converted to double, divided by a power of two (which is exact) so that the largest
/// coordinate is of order one, and sorted in lexicographic order. A point closer to an earlier
/// point than the tolerance is removed.
template <int Dim>
struct HullInput {
  using Point = Eigen::Matrix<double, Dim, 1>;

  std::vector<Point> points;
  List<std::uint32_t> labels;  ///< index of each point in the caller's input
  double unit = 1;             ///< the length [m] of one unit of the scaled coordinates
  double rounding = 0;         ///< rounding error of the largest coordinate, in scaled units
  double flat = 0, thin = 0;   ///< HullTolerance, in scaled units

  /// @param error largest error of a coordinate of the points, >= 0 [m]; 0: that of the scalar
  template <class Vector>
  HullInput(std::span<const Vector> given, std::string_view function, double error = 0) {
    require(given.size() > Dim, function, "vertices.size()", given.size(),
            "must be at least " + std::to_string(Dim + 1));
    require_finite(given, function);
    double size = 0;
    for (const Vector& x : given)
      for (int k = 0; k < Dim; ++k) size = std::max(size, std::abs(double(x[k])));
    unit = size > 0 ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
    rounding = std::numeric_limits<typename Vector::Scalar>::epsilon() * size / unit;
    flat = std::max(HullTolerance{}.flat * rounding, HullTolerance{}.rounded * error / unit);
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
    List<std::uint32_t> order(given.size());
    std::iota(order.begin(), order.end(), 0U);
    sort_items(order, [&](std::uint32_t a, std::uint32_t b) {
      const Point &x = scaled[a], &y = scaled[b];
      for (int k = 0; k < Dim; ++k)
        if (x[k] != y[k]) return x[k] < y[k];
      return a < b;
    });
    NearPoints near(points, flat);
    for (const std::uint32_t i : order) {
      if (near.has_neighbour(scaled[i])) continue;
      points.push_back(scaled[i]);
      labels.push_back(i);
      near.add_last();
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
};

}  // namespace detail

}  // namespace moreau
