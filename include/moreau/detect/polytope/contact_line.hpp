// SPDX-License-Identifier: MIT
// The overlap of two edges in the plane; contact_polygon.hpp has the method and that of two faces in space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "moreau/core/space.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau::detail {

/// The segment in which two edges in the plane overlap, seen along the normal. Edge a belongs to a
/// polygon or is a segment shape; edge b belongs to a polygon. Coordinates are relative to the
/// centre of a [m]: x along the tangent, h along the normal.
template <std::floating_point T>
class ContactLine {
 public:
  using S = Space<2, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polygon<T>>;

  /// @param a       a polygon, or a segment shape, whose only edge has index 0
  /// @param offset  centre of b minus centre of a, world axes [m]
  /// @param near    two ends closer together than this count as one point [m]
  template <class ShapeA>
  ContactLine(const ShapeA& a, std::uint32_t edge_a, const Shape& b, std::uint32_t edge_b,
              const Vector& offset, const Vector& normal, T near)
      : center_(a.center()), frame_(S::contact_frame(normal)), near_(near) {
    a_ = project(a, edge_a, Vector::Zero());
    b_ = project(b, edge_b, offset);
  }

  /// Calls use(ManifoldPoint) for each end of the segment, or once if the two ends coincide.
  template <class Use>
  void for_each_corner(Use&& use) const {
    for (const End& end : a_.ends)
      if (b_.contains(end.x, near_))
        use(point(end.x, end.h, b_.height(end.x),
                  FeatureKey(FeatureKey::Kind::vertex_edge, end.vertex, b_.edge)));
    for (const End& end : b_.ends)
      if (a_.contains(end.x, near_) && !is_end_of_a(end))
        use(point(end.x, a_.height(end.x), end.h,
                  FeatureKey(FeatureKey::Kind::edge_vertex, a_.edge, end.vertex)));
  }

 private:
  struct End {
    T x, h;
    std::uint32_t vertex;
  };
  struct Edge {
    std::array<End, 2> ends;
    std::uint32_t edge;

    bool contains(T x, T near) const {
      const auto [low, high] = std::minmax(ends[0].x, ends[1].x);
      return x >= low - near && x <= high + near;
    }
    /// The height at x, and beyond an end the height of the end: contains() takes x up to `near` beyond it, where a
    /// steep edge continued would be far deeper than the surface.
    T height(T x) const {
      const T along = ends[1].x - ends[0].x;
      const T t = along == T(0) ? T(0) : std::clamp((x - ends[0].x) / along, T(0), T(1));
      return ends[0].h + t * (ends[1].h - ends[0].h);
    }
  };

  End project(const Vector& x, std::uint32_t vertex) const {
    return {frame_.col(1).dot(x), frame_.col(0).dot(x), vertex};
  }
  Edge project(const Shape& shape, std::uint32_t edge, const Vector& offset) const {
    const std::uint32_t next = edge + 1 < shape.vertices().size() ? edge + 1 : 0;
    return {{project(shape.vertices()[edge] + offset, edge),
             project(shape.vertices()[next] + offset, next)},
            edge};
  }
  Edge project(const Placed<Segment<S>>& shape, std::uint32_t edge, const Vector& offset) const {
    return {{project(shape.vertex(0) + offset, 0), project(shape.vertex(1) + offset, 1)}, edge};
  }
  bool is_end_of_a(const End& end) const {
    for (const End& other : a_.ends)
      if (std::abs(other.x - end.x) <= near_ && b_.contains(other.x, near_)) return true;
    return false;
  }
  ManifoldPoint<S> point(T x, T height_a, T height_b, FeatureKey key) const {
    return {center_ + frame_ * Vector(T(0.5) * (height_a + height_b), x), height_b - height_a, key};
  }

  const Vector center_;
  const typename S::Matrix frame_;
  const T near_;
  Edge a_, b_;
};

}  // namespace moreau::detail
