// SPDX-License-Identifier: MIT
// The convex hull of points in space as triangles. Because it uses exact signs, it is correct for
// every input.
//
// Points are added one by one. A point that lies strictly outside of some triangles replaces these
// triangles by triangles from the point to the edges of their rim. A point in the plane of a
// triangle counts as not outside of this triangle. So of the triangles in one plane, all are
// replaced or none. The replaced part of the surface is the part visible from the point after the
// point has been moved a little inwards. It is a disk. So its rim is one simple cycle, and no edge
// of the rim is collinear with the point.
//
// Each point that is not yet added knows one triangle that it is outside of. If this triangle is
// replaced when a point p is added, the point q looks for another one among the new triangles only,
// and is inside of the hull if it finds none. Proof: let q be outside of a replaced triangle t and of
// a kept triangle f, but of no new triangle. Then q lies in the cone that p spans over the hull, and
// the line from p through q meets the hull. On the way from p it reaches the inner side of the plane
// of t before or at the hull, and the outer side of the plane of f at or behind the hull. But q is
// before the plane of t and behind the plane of f, which is impossible.
//
// Large inputs are added in random order, so that n points take a time proportional to n log n in
// the mean (K. L. Clarkson, P. W. Shor, Discrete Comput. Geom. 4, 1989). Support points in some
// directions come first: a vertex of many faces, such as the tip of a pyramid, is among them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <random>
#include <span>
#include <utility>

#include "moreau/core/list.hpp"
#include "moreau/core/neighbour_cells.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/shape/detail/orientation.hpp"

namespace moreau::detail {

/// A triangle of the hull. Its vertices are counter-clockwise seen from outside. neighbour[e] is
/// the triangle on the other side of the edge from vertex[e] to vertex[e + 1].
struct HullTriangle {
  std::array<std::uint32_t, 3> vertex;
  std::array<std::uint32_t, 3> neighbour;
};

/// Computes the hull: starts with a tetrahedron and adds the points one by one. The surface is
/// stored as triangles with their neighbours.
class TriangleHull {
 public:
  using Point = Eigen::Vector3d;

  /// @param points different points
  /// @param seed   indices of four of the points, not coplanar
  TriangleHull(std::span<const Point> points, std::array<std::uint32_t, 4> seed)
      : points_(points),
        starts_at_(points.size()),
        ends_at_(points.size()),
        sees_(points.size(), none),
        next_(points.size(), none) {
    auto& [a, b, c, d] = seed;
    if (orientation(points[a], points[b], points[c], points[d]) > 0) std::swap(a, b);
    triangles_ = {{{a, b, c}, {1, 2, 3}},
                  {{b, a, d}, {0, 3, 2}},
                  {{c, b, d}, {0, 1, 3}},
                  {{a, c, d}, {0, 2, 1}}};
    first_.assign(triangles_.size(), none);
    seen_by_.assign(triangles_.size(), none);
    constexpr std::array<std::uint32_t, 4> all{0, 1, 2, 3};
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if (std::find(seed.begin(), seed.end(), i) == seed.end()) look_for_triangle(i, all);
    for (const std::uint32_t i : order_of(points))
      if (sees_[i] != none) add(i);
  }

  /// The triangles of the hull, counter-clockwise seen from outside. The hull is closed and convex.
  /// Neighbouring triangles may be coplanar.
  const List<HullTriangle>& triangles() const { return triangles_; }

 private:
  static constexpr std::uint32_t none = ~0U;

  struct Rim {
    std::uint32_t from, to, outside;  ///< a directed edge of a visible triangle, and the invisible
                                      ///< triangle on its other side
  };

  /// The order in which the points are added: that of the input if there are few points.
  static List<std::uint32_t> order_of(std::span<const Point> points) {
    constexpr std::size_t few = 64;
    List<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    if (points.size() <= few) return order;
    std::minstd_rand random;  // the same numbers with every library
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[random() % (i + 1)]);
    std::size_t front = 0;
    for (int k = 0; k < neighbour_cells<3>(); ++k) {  // the middle one has no length: any point
      const auto direction = neighbour_cell<Point>(k);
      std::size_t best = front;
      for (std::size_t i = front + 1; i < order.size(); ++i)
        if (direction.dot(points[order[i]]) > direction.dot(points[order[best]])) best = i;
      std::swap(order[front++], order[best]);
    }
    return order;
  }

  /// Stores the first of some triangles that a point is strictly outside of, if there is one.
  void look_for_triangle(std::uint32_t p, std::span<const std::uint32_t> some) {
    sees_[p] = none;
    for (const std::uint32_t t : some) {
      if (!is_outside(p, t)) continue;
      sees_[p] = t;
      next_[p] = first_[t];
      first_[t] = p;
      return;
    }
  }
  bool is_outside(std::uint32_t p, std::uint32_t t) const {
    const auto& v = triangles_[t].vertex;
    return orientation(points_[v[0]], points_[v[1]], points_[v[2]], points_[p]) > 0;
  }

  void add(std::uint32_t p) {
    find_visible(p);
    find_rim();
    find_orphans(p);
    // The new triangles take the places of the visible ones. If vertices of the hull disappear,
    // there may be fewer new triangles than visible ones. The last triangles then move into the
    // free places.
    slots_ = visible_;
    List<std::uint32_t>& slots = slots_;
    while (slots.size() < rim_.size()) {
      slots.push_back(static_cast<std::uint32_t>(triangles_.size()));
      triangles_.emplace_back();
      first_.push_back(none);
      seen_by_.push_back(none);
    }
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      starts_at_[rim_[k].from] = slots[k];
      ends_at_[rim_[k].to] = slots[k];
    }
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      const auto [from, to, outside] = rim_[k];
      triangles_[slots[k]] = {{from, to, p}, {outside, starts_at_[to], ends_at_[from]}};
      for (std::size_t e = 0; e < 3; ++e) {
        if (triangles_[outside].vertex[e] == to) triangles_[outside].neighbour[e] = slots[k];
      }
    }
    for (const std::uint32_t q : orphans_)
      look_for_triangle(q, std::span<const std::uint32_t>(slots).first(rim_.size()));
    slots.erase(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(rim_.size()));
    sort_items(slots, std::greater<>());
    for (const std::uint32_t hole : slots) move_last_to(hole);
  }

  /// The triangles that p is strictly outside of. They are connected.
  void find_visible(std::uint32_t p) {
    visible_.assign(1, sees_[p]);
    seen_by_[sees_[p]] = p;
    for (std::size_t k = 0; k < visible_.size(); ++k) {
      for (const std::uint32_t t : triangles_[visible_[k]].neighbour) {
        if (seen_by_[t] == p || !is_outside(p, t)) continue;
        seen_by_[t] = p;
        visible_.push_back(t);
      }
    }
    sort_items(visible_);
  }

  void find_rim() {
    rim_.clear();
    const std::uint32_t p = seen_by_[visible_[0]];
    for (const std::uint32_t t : visible_) {
      const HullTriangle& triangle = triangles_[t];
      for (std::size_t e = 0; e < 3; ++e) {
        if (seen_by_[triangle.neighbour[e]] == p) continue;
        rim_.push_back({triangle.vertex[e], triangle.vertex[(e + 1) % 3], triangle.neighbour[e]});
      }
    }
  }

  /// The points other than p that know a visible triangle.
  void find_orphans(std::uint32_t p) {
    orphans_.clear();
    for (const std::uint32_t t : visible_) {
      for (std::uint32_t q = first_[t]; q != none; q = next_[q])
        if (q != p) orphans_.push_back(q);
      first_[t] = none;
    }
  }

  void move_last_to(std::uint32_t hole) {
    const auto last = static_cast<std::uint32_t>(triangles_.size() - 1);
    if (hole != last) {
      triangles_[hole] = triangles_[last];
      first_[hole] = first_[last];
      seen_by_[hole] = seen_by_[last];
      for (std::uint32_t q = first_[hole]; q != none; q = next_[q]) sees_[q] = hole;
      for (const std::uint32_t n : triangles_[hole].neighbour) {
        for (std::uint32_t& back : triangles_[n].neighbour) {
          if (back == last) back = hole;
        }
      }
    }
    triangles_.pop_back();
    first_.pop_back();
    seen_by_.pop_back();
  }

  std::span<const Point> points_;
  List<HullTriangle> triangles_;
  List<std::uint32_t> visible_, slots_, orphans_, starts_at_, ends_at_;
  List<std::uint32_t> sees_;          // for each point a triangle it is outside of, or none
  List<std::uint32_t> first_, next_;  // the points of each triangle, as linked lists
  List<std::uint32_t> seen_by_;       // for each triangle the last point that saw it
  List<Rim> rim_;
};

}  // namespace moreau::detail
