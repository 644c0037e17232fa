// SPDX-License-Identifier: MIT
// Convex hulls of points in the plane and in space. A valid hull is computed for any finite input,
// in three steps:
//
//   1. Points closer together than the tolerance (HullTolerance) are merged.
//   2. The hull of the remaining points is computed with exact signs of determinants
//      (orientation.hpp). It is therefore always closed and convex.
//   3. In the plane, a vertex whose distance from the line through its two neighbours is within the
//      tolerance is removed, so that its two edges become one. In space, neighbouring triangles
//      whose corners lie in one plane within the tolerance are merged into one face
//      (face_merging.hpp).
//
// All steps process the points in lexicographic order, so that the result does not depend on the
// order of the input.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

#include "moreau/core/sort_items.hpp"
#include "moreau/shape/detail/face_merging.hpp"
#include "moreau/shape/detail/hull_input.hpp"
#include "moreau/shape/detail/orientation.hpp"
#include "moreau/shape/detail/ring_reduction.hpp"
#include "moreau/shape/detail/triangle_hull.hpp"

namespace moreau {

namespace detail {

/// Index of the first point for which `measure` is largest.
template <class Point, class Measure>
std::uint32_t farthest(const std::vector<Point>& points, const Measure& measure) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < points.size(); ++i) {
    if (measure(points[i]) > measure(points[best])) best = i;
  }
  return best;
}

/// Four points that span a thick tetrahedron: the first point; the point farthest from it; the
/// point farthest from the line through these two; the point farthest from the plane through these
/// three.
/// @throws std::invalid_argument if one of these distances is too small
inline std::array<std::uint32_t, 4> seed_of(const HullInput<3>& input, std::string_view function) {
  const auto& x = input.points;
  const auto along = [&](const auto& p) { return (p - x[0]).norm(); };
  const std::uint32_t b = farthest(x, along);
  if (along(x[b]) <= input.thin) input.throw_thin(function, along(x[b]), "they coincide");
  const Eigen::Vector3d axis = (x[b] - x[0]).normalized();
  const auto aside = [&](const auto& p) { return axis.cross(p - x[0]).norm(); };
  const std::uint32_t c = farthest(x, aside);
  if (aside(x[c]) <= input.thin) input.throw_thin(function, aside(x[c]), "they are collinear");
  const Eigen::Vector3d normal = axis.cross(x[c] - x[0]).normalized();
  const auto above = [&](const auto& p) { return std::abs(normal.dot(p - x[0])); };
  const std::uint32_t d = farthest(x, above);
  if (above(x[d]) <= input.thin) input.throw_thin(function, above(x[d]), "they are coplanar");
  return {0, b, c, d};
}

/// @throws std::invalid_argument if all points lie near one line
inline void require_width(const HullInput<2>& input, std::string_view function) {
  const auto& x = input.points;
  const auto along = [&](const auto& p) { return (p - x[0]).norm(); };
  const std::uint32_t b = farthest(x, along);
  if (along(x[b]) <= input.thin) input.throw_thin(function, along(x[b]), "they coincide");
  const auto aside = [&](const auto& p) {
    return std::abs(orientation(x[0], x[b], p)) / (x[b] - x[0]).norm();
  };
  const double width = aside(x[farthest(x, aside)]);
  if (width <= input.thin) input.throw_thin(function, width, "they are collinear");
}

/// Repeats while this distance is within the tolerance: removes the vertex with the smallest
/// distance from the line through its two neighbours.
inline void drop_collinear(std::vector<std::uint32_t>& ring, const HullInput<2>& input) {
  const auto& x = input.points;
  reduce_ring(ring, 2, input.flat, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return std::abs(orientation(x[a], x[b], x[c])) / (x[c] - x[a]).norm();
  });
}

/// Rotates a cyclic list so that it begins with its smallest element.
inline void begin_with_smallest(std::vector<std::uint32_t>& cycle) {
  std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
}

}  // namespace detail

/// The convex hull of points in the plane: the indices of its vertices, counter-clockwise,
/// beginning with the smallest index. Points inside the hull or on an edge are left out.
/// @param vertices N points, in any order [m]
/// @param function name of the calling function, for error messages
/// @throws std::invalid_argument for fewer than 3 points, a point that is not finite, or points
///                               that coincide or are collinear within HullTolerance
/// @param error    largest error of a coordinate of the points, >= 0 [m]; 0: that of the scalar
/// Source: A. M. Andrew, Inf. Process. Lett. 9 (1979).
template <std::floating_point T>
std::vector<std::uint32_t> convex_hull(std::span<const Eigen::Matrix<T, 2, 1>> vertices,
                                       std::string_view function = "convex_hull",
                                       double error = 0) {
  const detail::HullInput<2> input(vertices, function, error);
  detail::require_width(input, function);
  const auto& x = input.points;
  std::vector<std::uint32_t> ring;
  const auto chain = [&](auto begin, auto end) {  // appends a chain of the hull, without its last
                                                  // point
    const std::size_t first = ring.size();
    for (auto i = begin; i != end; ++i) {
      while (ring.size() > first + 1 &&
             orientation(x[ring[ring.size() - 2]], x[ring.back()], x[*i]) <= 0) {
        ring.pop_back();
      }
      ring.push_back(*i);
    }
    ring.pop_back();
  };
  std::vector<std::uint32_t> order(x.size());
  std::iota(order.begin(), order.end(), 0U);
  chain(order.begin(), order.end());
  chain(order.rbegin(), order.rend());

  detail::drop_collinear(ring, input);
  for (std::uint32_t& i : ring) i = input.labels[i];
  detail::begin_with_smallest(ring);
  return ring;
}

/// The convex hull of points in space: its faces. Each face is a cyclic list of vertex indices,
/// counter-clockwise seen from outside, beginning with the smallest index. Triangles that are
/// coplanar within HullTolerance form one face. Points inside the hull, on a face or on an edge are
/// left out.
/// @param vertices N points, in any order [m]
/// @param function name of the calling function, for error messages
/// @throws std::invalid_argument for fewer than 4 points, a point that is not finite, or points
///                               that coincide or are collinear or coplanar within HullTolerance
/// @param error    largest error of a coordinate of the points, >= 0 [m]; 0: that of the scalar. The corners of a face
///                 may then lie that far from its plane
template <std::floating_point T>
std::vector<std::vector<std::uint32_t>> convex_hull(
    std::span<const Eigen::Matrix<T, 3, 1>> vertices, std::string_view function = "convex_hull",
    double error = 0) {
  const detail::HullInput<3> input(vertices, function, error);
  const detail::TriangleHull hull(input.points, detail::seed_of(input, function));
  auto faces = detail::merged_faces(hull.triangles(), input.points, input.flat, input.rounding,
                                    error > 0 ? 4 : 64);
  for (auto& face : faces) {
    for (std::uint32_t& v : face) v = input.labels[v];
    detail::begin_with_smallest(face);
  }
  sort_items(faces);
  return faces;
}

}  // namespace moreau
