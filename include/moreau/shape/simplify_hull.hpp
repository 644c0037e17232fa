// SPDX-License-Identifier: MIT
// Fewer vertices for a convex grain: a scan has thousands, contact detection wants tens.
//
// Vertices are removed one by one. Each time the vertex goes whose removal loses the least volume.
// The result is the hull of the vertices that are left, so it lies inside the given shape.
//
// How the loss is measured and how the hole is filled stands in detail/hull_reduction.hpp. In the
// plane a removal loses the triangle of the vertex and its two neighbours.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/shape/detail/hull_reduction.hpp"
#include "moreau/shape/detail/orientation.hpp"
#include "moreau/shape/detail/ring_reduction.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau {

/// A convex shape with fewer vertices.
template <class ShapeT>
struct SimplifiedHull {
  /// Its centroid_of_input() is in the frame of the given shape's input, whatever n.
  ShapeT shape;
  /// Volume that was lost, divided by the volume of the given shape [-], >= 0.
  typename ShapeT::Space::Scalar volume_error = 0;
};

namespace detail {

/// @param left vertices in the body frame of the given shape [m]
template <class ShapeT>
SimplifiedHull<ShapeT> simplified(const ShapeT& given,
                                  const std::vector<typename ShapeT::Vector>& left) {
  ShapeT shape{std::span<const typename ShapeT::Vector>(left)};
  InputFrame::move_by(shape, given.centroid_of_input());
  const auto error = 1 - shape.volume() / given.volume();
  return {std::move(shape), std::max(error, typename ShapeT::Scalar(0))};
}

template <class ShapeT>
std::vector<Eigen::Matrix<double, ShapeT::Space::dim, 1>> unit_vertices(const ShapeT& shape) {
  std::vector<Eigen::Matrix<double, ShapeT::Space::dim, 1>> points;
  for (Eigen::Index i = 0; i < shape.vertices().rows(); ++i)
    points.push_back(shape.vertices().row(i).transpose().template cast<double>() /
                     double(shape.circumradius()));
  return points;
}

}  // namespace detail

/// Removes vertices of a polyhedron until n are left, each time the one that loses the least volume.
/// The result lies inside the shape, and what is lost is measured, not estimated: volume_error. For
/// N vertices it takes a time proportional to N log N. (A vertex with more than 32 neighbours is
/// weighed when a sixteenth of them has changed, and before it is removed: until then another vertex
/// may be removed first.)
/// @param n at least 4; a shape with no more vertices is returned as it is
/// @returns the shape and the volume lost
/// @throws std::invalid_argument if n < 4
template <std::floating_point T>
SimplifiedHull<Polyhedron<T>> simplify_hull(const Polyhedron<T>& shape, std::size_t n) {
  require(n >= 4, "simplify_hull", "n", n, "must be at least 4");
  if (shape.vertex_count() <= n) return {shape, 0};
  detail::HullReduction reduction(detail::unit_vertices(shape));
  while (reduction.size() > n) reduction.remove_one();
  std::vector<Eigen::Matrix<T, 3, 1>> left;
  for (const auto& x : reduction.points())
    left.push_back((x * double(shape.circumradius())).template cast<T>());
  return detail::simplified(shape, left);
}

/// The same for a polygon, which keeps at least 3 vertices.
/// @throws std::invalid_argument if n < 3
template <std::floating_point T>
SimplifiedHull<Polygon<T>> simplify_hull(const Polygon<T>& shape, std::size_t n) {
  require(n >= 3, "simplify_hull", "n", n, "must be at least 3");
  if (shape.vertex_count() <= n) return {shape, 0};
  auto ring = detail::unit_vertices(shape);
  using Point = Eigen::Vector2d;
  detail::reduce_ring(
      ring, n, std::numeric_limits<double>::infinity(),
      [](const Point& a, const Point& b, const Point& c) { return orientation(a, b, c); });
  std::vector<Eigen::Matrix<T, 2, 1>> left;
  for (const auto& x : ring) left.push_back((x * double(shape.circumradius())).template cast<T>());
  return detail::simplified(shape, left);
}

}  // namespace moreau
