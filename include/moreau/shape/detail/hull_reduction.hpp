// SPDX-License-Identifier: MIT
// Removes vertices of a convex polyhedron one by one; see shape/simplify_hull.hpp.
//
// The surface is stored as triangles. The triangles at a vertex v are its star, the cycle of the other
// corners of these is its link L. Let P be the hull of the vertices V, Q the hull of V without v, and
// c a point inside Q. A face of Q that is visible from v is a face of the hull of L and c, because all
// corners of the part of Q that v sees belong to L. So
//     vol(P) - vol(Q) = vol(hull(L, c, v)) - vol(hull(L, c)),
// the sum of the tetrahedra from v to these faces.
//
// When v is removed, these faces fill the hole, up to parts in planes that contain v: where a face of
// P at v has more than three corners, what is left of it is the polygon between an edge of the
// visible part and the link. It is divided into triangles, halving it, so that no vertex gets many.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "moreau/shape/detail/triangle_hull.hpp"

namespace moreau::detail {

/// The vertices that are left of a polyhedron, and what the removal of each would lose. n vertices
/// take a time proportional to n log n.
class HullReduction {
 public:
  using Point = Eigen::Vector3d;

  /// @param points vertices of a convex polyhedron, in units of its size
  explicit HullReduction(std::vector<Point> points)
      : points_(std::move(points)), vertices_(points_.size()), left_(points_.size()) {
    for (const Point& x : points_) sum_ += x;
    triangulate();
    for (std::uint32_t v = 0; v < points_.size(); ++v) weigh(v);
  }

  std::size_t size() const { return left_; }
  /// The points that are left, in their order.
  std::vector<Point> points() const {
    std::vector<Point> left;
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (!vertices_[v].is_gone) left.push_back(points_[v]);
    return left;
  }

  /// Removes the vertex whose removal loses least.
  void remove_one() {
    const std::uint32_t v = take_least();
    find_star(v);
    fill_hole(v);
    vertices_[v].is_gone = true;
    ++vertices_[v].version;
    --left_;
    sum_ -= points_[v];
    if (link_.empty()) return;
    if (!replace_star()) triangulate();
    const std::vector<std::uint32_t> neighbours = link_;
    for (const std::uint32_t w : neighbours) note_change(w);
  }

 private:
  static constexpr std::uint32_t none = ~0U;
  /// A vertex with no more neighbours is weighed after each change of its neighbours, another one
  /// after a sixteenth of its neighbours have changed, and before it is removed: so the tip of a
  /// pyramid of n sides is not weighed n times.
  static constexpr std::uint32_t few = 32, part = 16;

  struct Vertex {
    std::uint32_t triangle = none;  ///< one of its triangles; none if it is not on the hull
    std::uint32_t version = 0;      ///< of its newest entry in the queue
    std::uint32_t degree = 0;       ///< number of neighbours when it was weighed
    std::uint32_t changes = 0;      ///< neighbours that were removed since
    bool is_gone = false;
  };
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  ///< loss, vertex, version

  std::uint32_t take_least() {
    while (true) {
      const auto [loss, v, version] = queue_.top();
      queue_.pop();
      if (version != vertices_[v].version) continue;
      if (vertices_[v].changes == 0) return v;
      weigh(v);
    }
  }
  void note_change(std::uint32_t v) {
    Vertex& vertex = vertices_[v];
    ++vertex.changes;
    if (vertex.degree <= few || vertex.changes * part >= vertex.degree) weigh(v);
  }
  void weigh(std::uint32_t v) {
    find_star(v);
    Vertex& vertex = vertices_[v];
    vertex.degree = static_cast<std::uint32_t>(link_.size());
    vertex.changes = 0;
    queue_.emplace(fill_hole(v), v, ++vertex.version);
  }

  /// The triangles of the hull of all points that are left; none if these are coplanar.
  void triangulate() {
    std::vector<std::uint32_t> some;
    std::vector<Point> x;
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      vertices_[v].triangle = none;
      if (vertices_[v].is_gone) continue;
      some.push_back(v);
      x.push_back(points_[v]);
    }
    triangles_.clear();
    const auto seed = seed_of_points(x);
    if (!spans_volume(x, seed)) return;
    triangles_ = TriangleHull(x, seed).triangles();
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (std::uint32_t& v : triangles_[t].vertex) {
        v = some[v];
        vertices_[v].triangle = t;
      }
  }
  static bool spans_volume(const std::vector<Point>& x, const std::array<std::uint32_t, 4>& seed) {
    return orientation(x[seed[0]], x[seed[1]], x[seed[2]], x[seed[3]]) != 0;
  }
  /// Four points that are not coplanar, if there are any.
  static std::array<std::uint32_t, 4> seed_of_points(const std::vector<Point>& x) {
    const auto farthest_by = [&](const auto& measure) {
      std::uint32_t best = 0;
      double most = measure(x[0]);
      for (std::uint32_t i = 1; i < x.size(); ++i)
        if (const double here = measure(x[i]); here > most) {
          most = here;
          best = i;
        }
      return best;
    };
    const std::uint32_t b = farthest_by([&](const Point& p) { return (p - x[0]).squaredNorm(); });
    const Point along = (x[b] - x[0]).normalized();
    const auto aside = [&](const Point& p) { return along.cross(p - x[0]).squaredNorm(); };
    const std::uint32_t c = farthest_by(aside);
    const Point normal = along.cross(x[c] - x[0]).normalized();
    const auto above = [&](const Point& p) { return std::abs(normal.dot(p - x[0])); };
    return {0, b, c, farthest_by(above)};
  }

  /// Sets star_ and link_: triangle star_[i] has the corners v, link_[i], link_[i + 1].
  void find_star(std::uint32_t v) {
    star_.clear();
    link_.clear();
    const std::uint32_t first = vertices_[v].triangle;
    for (std::uint32_t t = first; t != none;) {
      const HullTriangle& triangle = triangles_[t];
      const std::size_t at = place_of(triangle, v);
      star_.push_back(t);
      link_.push_back(triangle.vertex[(at + 1) % 3]);
      t = triangle.neighbour[(at + 2) % 3];
      if (t == first) break;
    }
  }
  static std::size_t place_of(const HullTriangle& triangle, std::uint32_t v) {
    return triangle.vertex[0] == v ? 0 : triangle.vertex[1] == v ? 1 : 2;
  }

  /// Sets patch_: the triangles, as places in link_, that fill the hole if v is removed.
  /// @returns the volume that is lost; 0 for a vertex that is not on the hull; infinite if the link is
  ///          coplanar with the middle of the others, so that no solid is left
  double fill_hole(std::uint32_t v) {
    patch_.clear();
    if (link_.empty()) return 0;
    std::vector<Point>& local = local_;
    local.clear();
    for (const std::uint32_t w : link_) local.push_back(points_[w]);
    local.push_back((sum_ - points_[v]) / double(left_ - 1));
    const auto seed = seed_of_points(local);
    if (!spans_volume(local, seed)) return std::numeric_limits<double>::infinity();
    const std::size_t middle = link_.size();
    double lost = 0;
    const TriangleHull hull(local, seed);
    for (const HullTriangle& t : hull.triangles()) {
      const auto& [a, b, c] = t.vertex;
      const double volume = orientation(local[a], local[b], local[c], points_[v]);
      if (volume <= 0) continue;
      lost += volume;
      if (a != middle && b != middle && c != middle) patch_.push_back(t.vertex);
    }
    return lost / 6;
  }

  /// The directed edges of patch_: ends, triangle, place in the triangle; sorted.
  using Edge = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
  void find_edges() {
    edges_.clear();
    for (std::uint32_t m = 0; m < patch_.size(); ++m)
      for (std::uint32_t e = 0; e < 3; ++e)
        edges_.emplace_back(patch_[m][e], patch_[m][(e + 1) % 3], m, e);
    std::sort(edges_.begin(), edges_.end());
  }
  /// The edge between two places of the link, or null.
  const Edge* edge_between(std::uint32_t from, std::uint32_t to) const {
    const auto at = std::lower_bound(edges_.begin(), edges_.end(), Edge(from, to, 0, 0));
    const bool is_there = at != edges_.end() && std::get<0>(*at) == from && std::get<1>(*at) == to;
    return is_there ? &*at : nullptr;
  }
  std::uint32_t behind(std::uint32_t place) const {
    return place + 1 == link_.size() ? 0 : place + 1;
  }

  /// Adds triangles between the edge from one place of the link to another and the link.
  void fill_wall(std::uint32_t from, std::uint32_t to) {
    const auto size = static_cast<std::uint32_t>(link_.size());
    const std::uint32_t steps = (to + size - from) % size;
    if (steps < 2) return;
    const std::uint32_t middle = (from + steps / 2) % size;
    patch_.push_back({from, middle, to});
    fill_wall(from, middle);
    fill_wall(middle, to);
  }

  /// Puts the patch in the place of the star.
  /// @returns whether it fills the hole. It does not if the rounding of the input has made vertices
  ///          that are not corners of the hull; the triangles are then unchanged
  bool replace_star() {
    find_edges();
    for (const auto& [from, to, m, e] : edges_)
      if (edge_between(to, from) == nullptr) fill_wall(from, to);
    if (patch_.size() + 2 != link_.size()) return false;
    find_edges();
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const auto& [from, to, m, e] = edges_[k];
      if (k > 0 && std::get<0>(edges_[k - 1]) == from && std::get<1>(edges_[k - 1]) == to)
        return false;
      if (edge_between(to, from) == nullptr && to != behind(from)) return false;
    }
    // Places of the star: the triangle outside of its edge from link_[i] to link_[i + 1].
    outside_.clear();
    for (std::size_t i = 0; i < star_.size(); ++i) {
      const HullTriangle& t = triangles_[star_[i]];
      outside_.push_back(t.neighbour[(place_of(t, link_[i]))]);
    }
    for (const auto& [from, to, m, e] : edges_) {
      HullTriangle& triangle = triangles_[star_[m]];
      triangle.vertex[e] = link_[from];
      if (const Edge* back = edge_between(to, from)) {
        triangle.neighbour[e] = star_[std::get<2>(*back)];
        continue;
      }
      triangle.neighbour[e] = outside_[from];
      HullTriangle& outer = triangles_[outside_[from]];
      outer.neighbour[place_of(outer, link_[to])] = star_[m];
    }
    for (const auto& [from, to, m, e] : edges_) vertices_[link_[from]].triangle = star_[m];
    return true;
  }

  std::vector<Point> points_;
  std::vector<Vertex> vertices_;
  std::vector<HullTriangle> triangles_;  // those at removed vertices are left over
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
  std::size_t left_;
  Point sum_ = Point::Zero();  // of the points that are left
  std::vector<std::uint32_t> star_, link_, outside_;
  std::vector<std::array<std::uint32_t, 3>> patch_;
  std::vector<Edge> edges_;
  std::vector<Point> local_;
};

}  // namespace moreau::detail
