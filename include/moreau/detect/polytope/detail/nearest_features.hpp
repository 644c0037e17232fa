// SPDX-License-Identifier: MIT
// The nearest features of two polyhedra that are apart, found by comparing all features that can be
// nearest. It is needed for pairs with edges or faces so parallel that GJK ends on rounding errors.
//
// Let n be a unit vector from a to b along which the shapes are separated by s, and let d be the
// distance of some point of a from some point of b. The distance of the nearest points is at most
// d. So the nearest point of a lies at most d - s below the highest point of a along n, and the
// nearest point of b at most d - s below the highest point of b along -n. Features without a vertex
// in this range are left out. All distances compared are distances between points of the two
// shapes, so that no distance is smaller than the gap.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/detect/polytope/detail/feature_axis.hpp"
#include "moreau/detect/polytope/projection.hpp"
#include "moreau/detect/polytope/segment_axis.hpp"

namespace moreau::detail {

template <std::floating_point T>
class FeatureComparison {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polyhedron<T>>;
  using Edge = typename Polyhedron<T>::Edge;

  /// @param direction  the unit vector n, from a to b, world axes
  /// @param slab       d - s plus an allowance for rounding [m]
  FeatureComparison(const PolytopePair<Polyhedron<T>>& pair, const Vector& direction, T slab)
      : pair_(pair), high_a_(pair.a, direction, slab), high_b_(pair.b, -direction, slab) {}

  /// The axis of the nearest features. Its gap is infinite if there are none to compare.
  Axis<S> compare() {
    axis_.gap = std::numeric_limits<T>::infinity();
    compare_edges();
    compare_faces(pair_.a, high_a_, pair_.b, high_b_, pair_.offset, T(1));
    compare_faces(pair_.b, high_b_, pair_.a, high_a_, Vector(-pair_.offset), T(-1));
    return axis_;
  }

 private:
  /// Which vertices lie at most `slab` [m] below the highest vertex along `up`. It holds no memory: a step must not
  /// allocate.
  class HighVertices {
   public:
    HighVertices(const Shape& shape, const Vector& up, T slab)
        : shape_(shape), up_(up), lowest_(shape.vertices().reach(up) - slab) {}
    std::size_t size() const { return shape_.vertices().size(); }
    bool operator[](std::size_t v) const { return up_.dot(shape_.vertices()[v]) >= lowest_; }

   private:
    const Shape& shape_;
    const Vector up_;
    const T lowest_;
  };
  static bool is_high(const Edge& edge, const HighVertices& high) {
    return high[edge.vertex[0]] || high[edge.vertex[1]];
  }

  void compare_edges() {
    const auto edges_a = pair_.a.shape().edges(), edges_b = pair_.b.shape().edges();
    for (std::uint32_t i = 0; i < edges_a.size(); ++i) {
      if (!is_high(edges_a[i], high_a_)) continue;
      for (std::uint32_t j = 0; j < edges_b.size(); ++j)
        if (is_high(edges_b[j], high_b_)) compare(edges_a[i], i, edges_b[j], j);
    }
  }
  void compare(const Edge& edge_a, std::uint32_t i, const Edge& edge_b, std::uint32_t j) {
    const Vector p = pair_.a.vertices()[edge_a.vertex[0]], q = pair_.a.vertices()[edge_a.vertex[1]];
    const Vector v = pair_.b.vertices()[edge_b.vertex[0]], w = pair_.b.vertices()[edge_b.vertex[1]];
    Vector between = v - p;
    between += w - q;
    const SegmentPair<S> segments((q - p) / 2, (w - v) / 2, pair_.offset + between / 2);
    SegmentAxis<S> nearest = nearest_points(segments);
    if (!(nearest.gap < axis_.gap)) return;
    const bool end_a = std::abs(nearest.s) >= T(1), end_b = std::abs(nearest.t) >= T(1);
    const std::uint32_t a = edge_a.vertex[nearest.s < T(0) ? 0 : 1],
                        b = edge_b.vertex[nearest.t < T(0) ? 0 : 1];
    if (end_a || end_b) {
      const AxisKind kind = !end_a   ? AxisKind::edge_vertex
                            : !end_b ? AxisKind::vertex_edge
                                     : AxisKind::vertices;
      axis_ = axis_of_nearest(pair_, kind, end_a ? a : i, end_b ? b : j);
      return;
    }
    nearest.normal = segments.apart(nearest.s, nearest.t) / nearest.gap;
    refine(segments, nearest);
    axis_ = {nearest.normal, nearest.gap, AxisKind::edges, i, j};
  }
  /// Compares each face of `own` with each vertex of `other` that projects onto the face.
  /// @param sign  1 if `own` is a, -1 if `own` is b
  void compare_faces(const Shape& own, const HighVertices& high_own, const Shape& other,
                     const HighVertices& high_other, const Vector& offset, T sign) {
    for (std::uint32_t f = 0; f < own.normals().size(); ++f) {
      const auto loop = own.shape().face(f);
      if (std::none_of(loop.begin(), loop.end(), [&](auto v) { return high_own[v]; })) continue;
      for (std::uint32_t v = 0; v < high_other.size(); ++v) {
        if (!high_other[v]) continue;
        const Vector x = other.vertices()[v] + offset;
        const T height = height_above(own, f, x);
        if (!(height >= T(0) && height < axis_.gap && projects_onto(own, f, x))) continue;
        const Vector normal = sign * own.normals()[f];
        axis_ = sign > T(0) ? Axis<S>{normal, height, AxisKind::face_a, f, v}
                            : Axis<S>{normal, height, AxisKind::face_b, v, f};
      }
    }
  }

  const PolytopePair<Polyhedron<T>>& pair_;
  const HighVertices high_a_, high_b_;
  Axis<S> axis_;
};

/// The axis of the nearest features of two polyhedra that are apart.
/// @param direction  unit vector from a to b, along which the shapes are separated by s, world axes
/// @param slab       d - s, where d is the distance of a point of a from a point of b, plus an
///                   allowance for rounding [m]
/// @returns an axis with an infinite gap if there are no features to compare
template <std::floating_point T>
Axis<Space<3, T>> nearest_features(const PolytopePair<Polyhedron<T>>& pair,
                                   const typename Space<3, T>::Vector& direction, T slab) {
  return FeatureComparison<T>(pair, direction, slab).compare();
}

}  // namespace moreau::detail
