// SPDX-License-Identifier: MIT
// The convex hull of points in space as triangles, with exact signs: correct for every input.
//
// A point strictly outside of some triangles replaces them by the cone from the point to their rim.
// A point in the plane of a triangle counts as not outside of it. All triangles of one plane are
// therefore replaced together or not at all. The replaced part is what is visible from the point,
// moved a little inwards. It is a disk, so its rim is one simple cycle, and no edge of the rim is
// collinear with the point.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "moreau/shape/orientation.hpp"

namespace moreau::detail {

/// Counter-clockwise from outside; neighbour[e] lies across the edge vertex[e] -> vertex[e + 1].
struct HullTriangle {
  std::array<std::uint32_t, 3> vertex;
  std::array<std::uint32_t, 3> neighbour;
};

/// Adds points one by one to a tetrahedron. The surface is stored as triangles with their
/// neighbours.
class TriangleHull {
 public:
  using Point = Eigen::Vector3d;

  /// @param points distinct, in the order in which they are added
  /// @param seed   four of them, not coplanar
  TriangleHull(std::span<const Point> points, std::array<std::uint32_t, 4> seed)
      : points_(points), starts_at_(points.size()), ends_at_(points.size()) {
    auto& [a, b, c, d] = seed;
    if (orientation(points[a], points[b], points[c], points[d]) > 0) std::swap(a, b);
    triangles_ = {{{a, b, c}, {1, 2, 3}},
                  {{b, a, d}, {0, 3, 2}},
                  {{c, b, d}, {0, 1, 3}},
                  {{a, c, d}, {0, 2, 1}}};
    for (std::uint32_t i = 0; i < points.size(); ++i) add(i);
  }

  /// Counter-clockwise from outside; convex, closed, and possibly flat across edges.
  const std::vector<HullTriangle>& triangles() const { return triangles_; }

 private:
  struct Rim {
    std::uint32_t from, to, outside;  ///< an edge of a visible triangle; the hidden one behind it
  };

  void add(std::uint32_t p) {
    find_visible(points_[p]);
    if (visible_.empty()) return;
    find_rim();
    // The new triangles replace the visible ones. There are fewer new triangles only if vertices
    // vanish; the last triangles then move into the free places.
    std::vector<std::uint32_t> slots = visible_;
    while (slots.size() < rim_.size()) {
      slots.push_back(static_cast<std::uint32_t>(triangles_.size()));
      triangles_.emplace_back();
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
    slots.erase(slots.begin(), slots.begin() + static_cast<std::ptrdiff_t>(rim_.size()));
    std::sort(slots.begin(), slots.end(), std::greater<>());
    for (const std::uint32_t hole : slots) move_last_to(hole);
  }

  void find_visible(const Point& x) {
    visible_.clear();
    is_visible_.assign(triangles_.size(), false);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const auto& v = triangles_[t].vertex;
      if (orientation(points_[v[0]], points_[v[1]], points_[v[2]], x) <= 0) continue;
      visible_.push_back(t);
      is_visible_[t] = true;
    }
  }

  void find_rim() {
    rim_.clear();
    for (const std::uint32_t t : visible_) {
      const HullTriangle& triangle = triangles_[t];
      for (std::size_t e = 0; e < 3; ++e) {
        if (is_visible_[triangle.neighbour[e]]) continue;
        rim_.push_back({triangle.vertex[e], triangle.vertex[(e + 1) % 3], triangle.neighbour[e]});
      }
    }
  }

  void move_last_to(std::uint32_t hole) {
    const auto last = static_cast<std::uint32_t>(triangles_.size() - 1);
    if (hole != last) {
      triangles_[hole] = triangles_[last];
      for (const std::uint32_t n : triangles_[hole].neighbour) {
        for (std::uint32_t& back : triangles_[n].neighbour) {
          if (back == last) back = hole;
        }
      }
    }
    triangles_.pop_back();
  }

  std::span<const Point> points_;
  std::vector<HullTriangle> triangles_;
  std::vector<std::uint32_t> visible_, starts_at_, ends_at_;
  std::vector<bool> is_visible_;
  std::vector<Rim> rim_;
};

}  // namespace moreau::detail
