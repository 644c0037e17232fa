// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "moreau/core/aabb.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/neighbour_cells.hpp"
#include "moreau/core/space.hpp"

namespace moreau::detail {

/// Points in a hashed grid, to which points are added one by one. A search for the points near another one takes a time
/// that does not depend on their number.
template <EuclideanSpace S>
class PointGrid {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// Removes all points.
  /// @param reach largest distance that any_near() is for [m], > 0
  void start(Scalar reach) {
    edge_ = 1.001 * double(reach);  // also where quotients are rounded
    first_.assign(least_buckets, none);
    points_.clear();
    bounds_ = {};
  }
  /// Adds a point [m]; its number is that of the points before.
  void add(const Vector& x) {
    bounds_.merge(x);
    points_.push_back({cell_of(x), none});
    if (points_.size() > first_.size()) {
      first_.assign(2 * first_.size(), none);
      for (std::size_t k = 0; k < points_.size(); ++k) link(k);
    } else {
      link(points_.size() - 1);
    }
  }
  /// Whether a condition holds for one of some points, with all those not farther away than the reach from x.
  /// @param condition function: number of a point -> bool
  bool any_near(const Vector& x, const auto& condition) const {
    if (!bounds_.inflated(Scalar(edge_)).overlaps(Aabb<S>(x, x))) return false;
    const Cell middle = cell_of(x);
    using Steps = Eigen::Matrix<int, S::dim, 1>;
    for (int k = 0; k < neighbour_cells<S::dim>(); ++k) {
      const Steps steps = neighbour_cell<Steps>(k);
      Cell cell = middle;
      for (std::size_t axis = 0; axis < cell.size(); ++axis)
        cell[axis] += steps[Eigen::Index(axis)];
      for (std::uint32_t at = first_[bucket_of(cell)]; at != none; at = points_[at].next)
        if (points_[at].cell == cell && condition(at)) return true;
    }
    return false;
  }

 private:
  using Cell = std::array<std::int64_t, std::size_t(S::dim)>;
  struct Point {
    Cell cell;
    std::uint32_t next;  // of its bucket
  };
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t least_buckets = 64;  // a power of 2, as all later numbers

  Cell cell_of(const Vector& x) const {
    constexpr double farthest = 1e15;
    Cell cell;
    for (std::size_t axis = 0; axis < cell.size(); ++axis)
      cell[axis] = static_cast<std::int64_t>(
          std::clamp(std::floor(double(x[Eigen::Index(axis)]) / edge_), -farthest, farthest));
    return cell;
  }
  std::size_t bucket_of(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t number : cell) {
      hash = (hash + static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15;
      hash ^= hash >> 32;
    }
    return std::size_t(hash) & (first_.size() - 1);
  }
  void link(std::size_t k) {
    std::uint32_t& first = first_[bucket_of(points_[k].cell)];
    points_[k].next = first;
    first = static_cast<std::uint32_t>(k);
  }

  double edge_ = 1;  // of a cell [m]
  List<std::uint32_t> first_;
  List<Point> points_;
  Aabb<S> bounds_;  // of all points
};

}  // namespace moreau::detail
