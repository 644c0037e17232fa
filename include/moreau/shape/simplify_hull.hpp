// SPDX-License-Identifier: MIT
// Fewer vertices for a convex grain: a scan has thousands, contact detection wants tens.
//
// Vertices are removed one by one. Each time the vertex goes whose removal loses the least volume.
// The result is the hull of the vertices that are left, so it lies inside the given shape.
//
// What a removal loses. Let P be the hull of the vertices V, v one of them, Q the hull of V without
// v, c a point inside Q, and L the vertices of the faces at v. A face of Q that is visible from v is
// a face of the hull of L and c, because all corners of the part of Q that v sees belong to L. So
//     vol(P) - vol(Q) = vol(hull(L, c, v)) - vol(hull(L, c)),
// the sum of the tetrahedra from v to these faces. In the plane it is the triangle of v and its two
// neighbours.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/shape/detail/triangle_hull.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau {

/// A convex shape with fewer vertices.
template <class ShapeT>
struct SimplifiedHull {
  ShapeT shape;  ///< in the frame of the given shape's input: centroid_of_input() has moved
  /// Volume that was lost, divided by the volume of the given shape [-], >= 0.
  typename ShapeT::Space::Scalar volume_error = 0;
};

namespace detail {

/// The vertices that are left of a polyhedron, and what the removal of each would lose. Coordinates
/// are divided by the size of the shape.
class HullReduction {
 public:
  using Point = Eigen::Vector3d;
  using Triangle = std::array<std::uint32_t, 3>;  ///< counter-clockwise seen from outside

  explicit HullReduction(std::vector<Point> points)
      : points_(std::move(points)), loss_(points_.size(), unknown), left_(points_.size()) {
    for (const Point& x : points_) sum_ += x;
    std::vector<std::uint32_t> all(points_.size());
    std::iota(all.begin(), all.end(), 0U);
    triangulate(all, triangles_);
  }

  std::size_t size() const { return left_; }
  /// The points that are left, in their order.
  std::vector<Point> points() const {
    std::vector<Point> left;
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (loss_[v] != gone) left.push_back(points_[v]);
    return left;
  }

  /// Removes the vertex whose removal loses least.
  void remove_one() {
    for (std::uint32_t v = 0; v < points_.size(); ++v)
      if (loss_[v] == unknown) {
        const auto ring = around(v);
        loss_[v] = patch_below(v, ring, patch_);
      }
    const auto v =
        static_cast<std::uint32_t>(std::min_element(loss_.begin(), loss_.end()) - loss_.begin());
    const auto ring = around(v);
    patch_below(v, ring, patch_);
    loss_[v] = gone;
    --left_;
    sum_ -= points_[v];
    for (const std::uint32_t w : ring) loss_[w] = unknown;
    const std::size_t removed = std::erase_if(
        triangles_, [&](const Triangle& t) { return std::find(t.begin(), t.end(), v) != t.end(); });
    triangles_.insert(triangles_.end(), patch_.begin(), patch_.end());
    if (patch_.size() + 2 == removed) return;
    // Coplanar points: the patch does not fill the hole. All is done anew.
    std::vector<std::uint32_t> all;
    for (std::uint32_t w = 0; w < points_.size(); ++w)
      if (loss_[w] != gone) all.push_back(w);
    triangulate(all, triangles_);
  }

 private:
  static constexpr double unknown = -1, gone = std::numeric_limits<double>::max();

  /// The triangles of the hull of some points; none if they are coplanar.
  void triangulate(const std::vector<std::uint32_t>& some, std::vector<Triangle>& triangles) const {
    std::vector<Point> x;
    for (const std::uint32_t v : some) x.push_back(points_[v]);
    triangulate(x, triangles);
    for (Triangle& t : triangles)
      for (std::uint32_t& v : t) v = some[v];
  }
  static void triangulate(const std::vector<Point>& x, std::vector<Triangle>& triangles) {
    triangles.clear();
    const auto seed = seed_of_points(x);
    if (orientation(x[seed[0]], x[seed[1]], x[seed[2]], x[seed[3]]) == 0) return;
    const TriangleHull hull(x, seed);
    for (const HullTriangle& t : hull.triangles()) triangles.push_back(t.vertex);
  }
  /// Four points that are not coplanar, if there are any.
  static std::array<std::uint32_t, 4> seed_of_points(const std::vector<Point>& x) {
    const auto farthest_by = [&](const auto& measure) {
      std::uint32_t best = 0;
      for (std::uint32_t i = 1; i < x.size(); ++i)
        if (measure(x[i]) > measure(x[best])) best = i;
      return best;
    };
    const std::uint32_t b = farthest_by([&](const Point& p) { return (p - x[0]).norm(); });
    const Point along = (x[b] - x[0]).normalized();
    const auto aside = [&](const Point& p) { return along.cross(p - x[0]).norm(); };
    const std::uint32_t c = farthest_by(aside);
    const Point normal = along.cross(x[c] - x[0]).normalized();
    const auto above = [&](const Point& p) { return std::abs(normal.dot(p - x[0])); };
    return {0, b, c, farthest_by(above)};
  }
  /// The other vertices of the triangles at a vertex, ascending.
  std::vector<std::uint32_t> around(std::uint32_t v) const {
    std::vector<std::uint32_t> ring;
    for (const Triangle& t : triangles_)
      if (t[0] == v || t[1] == v || t[2] == v)
        for (const std::uint32_t w : t)
          if (w != v) ring.push_back(w);
    std::sort(ring.begin(), ring.end());
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    return ring;
  }
  /// The volume that the removal of a vertex loses; infinite if the points around it are coplanar with
  /// the middle of the others.
  /// @param patch out: the triangles that replace those at the vertex
  double patch_below(std::uint32_t v, const std::vector<std::uint32_t>& ring,
                     std::vector<Triangle>& patch) const {
    std::vector<Point> local;
    for (const std::uint32_t w : ring) local.push_back(points_[w]);
    local.push_back((sum_ - points_[v]) / double(left_ - 1));
    triangulate(local, patch);
    if (patch.empty()) return std::numeric_limits<double>::infinity();
    double lost = 0;
    std::erase_if(patch, [&](const Triangle& t) {
      const double volume = orientation(local[t[0]], local[t[1]], local[t[2]], points_[v]);
      lost += std::max(volume, 0.0);
      return volume <= 0 || std::find(t.begin(), t.end(), ring.size()) != t.end();
    });
    for (Triangle& t : patch)
      for (std::uint32_t& w : t) w = ring[w];
    return lost / 6;
  }

  std::vector<Point> points_;
  std::vector<Triangle> triangles_, patch_;
  std::vector<double> loss_;  ///< of each point; `unknown` or `gone`
  std::size_t left_;
  Point sum_ = Point::Zero();  ///< of the points that are left
};

/// Twice the area of the triangle of a corner of a ring and its two neighbours.
inline double loss_of(const std::vector<Eigen::Vector2d>& ring, std::size_t i) {
  const std::size_t n = ring.size();
  return orientation(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]);
}

template <class ShapeT>
SimplifiedHull<ShapeT> simplified(const ShapeT& given,
                                  const std::vector<typename ShapeT::Vector>& left) {
  ShapeT shape{std::span<const typename ShapeT::Vector>(left)};
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
/// Takes a time proportional to the number of vertices for each vertex removed.
/// @param n at least 4; a shape with no more vertices is returned as it is
/// @returns the shape, in its own frame, and the volume lost
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
  while (ring.size() > n) {
    std::size_t least = 0;
    for (std::size_t i = 1; i < ring.size(); ++i)
      if (detail::loss_of(ring, i) < detail::loss_of(ring, least)) least = i;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(least));
  }
  std::vector<Eigen::Matrix<T, 2, 1>> left;
  for (const auto& x : ring) left.push_back((x * double(shape.circumradius())).template cast<T>());
  return detail::simplified(shape, left);
}

}  // namespace moreau
