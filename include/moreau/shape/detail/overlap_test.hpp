// SPDX-License-Identifier: MIT
// Whether two convex parts of a grain overlap. For the construction of grains: it may be slow.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "moreau/core/pose.hpp"

namespace moreau::detail {

/// The points of smallest norm of simplices with few corners, in double precision.
template <int Dim>
class NearestToOrigin {
 public:
  using Point = Eigen::Matrix<double, Dim, 1>;

  /// Adds a corner, finds the point of the simplex nearest to the origin, and removes the corners
  /// that do not carry it.
  const Point& add(const Point& corner) {
    corners_.push_back(corner);
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t subset = 1; subset < std::size_t{1} << corners_.size(); ++subset) {
      const auto point = projection(subset);
      if (!point.inside || !(point.x.squaredNorm() < nearest)) continue;
      nearest = point.x.squaredNorm();
      point_ = point.x;
      best = subset;
    }
    std::vector<Point> left;
    for (std::size_t k = 0; k < corners_.size(); ++k)
      if ((best >> k & 1) != 0) left.push_back(corners_[k]);
    corners_ = left;
    return point_;
  }
  std::size_t size() const { return corners_.size(); }

 private:
  struct Projection {
    Point x;
    bool inside;
  };
  /// The projection of the origin onto the affine hull of some corners, and whether it lies between
  /// them. Corners whose hull is degenerate have none.
  Projection projection(std::size_t subset) const {
    Point first = Point::Zero(), x = Point::Zero();
    constexpr auto most = static_cast<std::size_t>(Dim);
    std::array<Point, most> axes;  // orthonormal, of the edges from the first corner
    std::array<std::array<double, most>, most> edges{};  // edge k along axis j: upper triangular
    std::array<double, most> along{};                    // from the first corner to the projection
    std::size_t count = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      if ((subset >> k & 1) == 0) continue;
      if ((subset & ((std::size_t{1} << k) - 1)) == 0) {
        first = x = corners_[k];
        continue;
      }
      if (count == most) return {x, false};
      Point axis = corners_[k] - first;
      const double length = axis.norm();
      for (std::size_t j = 0; j < count; ++j) {
        edges[j][count] = axes[j].dot(axis);
        axis -= edges[j][count] * axes[j];
      }
      edges[count][count] = axis.norm();
      if (!(edges[count][count] > 1e-12 * length)) return {x, false};
      axes[count] = axis / edges[count][count];
      along[count] = -axes[count].dot(first);
      x += along[count] * axes[count];
      ++count;
    }
    double sum = 0;
    for (std::size_t k = count; k-- > 0;) {
      double weight = along[k];
      for (std::size_t j = k + 1; j < count; ++j) weight -= edges[k][j] * along[j];
      along[k] = weight / edges[k][k];
      if (!(along[k] >= 0)) return {x, false};
      sum += along[k];
    }
    return {x, sum <= 1};
  }

  std::vector<Point> corners_;
  Point point_ = Point::Zero();
};

/// Whether two convex parts overlap by more than about 1e-6 of their size. Each part is shrunk by this
/// share towards its origin, so that parts with a common face are apart. GJK then finds a plane
/// between them, or a simplex of their Minkowski difference that contains the origin.
/// Source: E. G. Gilbert, D. W. Johnson, S. S. Keerthi, IEEE J. Robotics Automat. 4 (1988) 193.
/// @param a,b objects with the members `shape` and `pose`
template <class S, class Part>
bool parts_overlap(const Part& a, const Part& b) {
  using T = typename S::Scalar;
  using Point = typename NearestToOrigin<S::dim>::Point;
  constexpr double epsilon = std::numeric_limits<T>::epsilon();
  constexpr double shrinks = epsilon > 1e-9 ? 1e-4 : 1e-6;
  const auto farthest = [&](const Part& part, const typename S::Vector& direction) -> Point {
    const typename S::Vector body = part.pose.rotation.inverse() * direction;
    return ((1 - shrinks) *
            (part.pose.rotation * part.shape.support(body)).template cast<double>());
  };
  const Point offset = (b.pose.position - a.pose.position).template cast<double>();
  const auto difference = [&](const Point& n) -> Point {
    const typename S::Vector direction = n.template cast<T>();
    return offset + farthest(b, -direction) - farthest(a, direction);
  };
  NearestToOrigin<S::dim> simplex;
  Point nearest = simplex.add(difference(offset.norm() > 0 ? offset : Point(Point::UnitX())));
  double size = nearest.norm();
  for (int k = 0; k < 1000; ++k) {
    if (!(nearest.norm() > 8 * epsilon * size)) return true;
    const Point next = difference(nearest.normalized());
    size = std::max(size, next.norm());
    if (nearest.dot(next) > 0) return false;
    if (simplex.size() > S::dim) return true;
    nearest = simplex.add(next);
  }
  return true;
}

}  // namespace moreau::detail
