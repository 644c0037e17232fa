// SPDX-License-Identifier: MIT
// contact_polygon: the region in which two facing features overlap, seen along the normal of the
// contact, and the gap between the two surfaces at each corner of the region. The contact points of
// polytopes get their gaps here.
//
// In space the features are faces, and the overlap of their projections is a convex polygon. In the
// plane the features are edges, and the overlap of their projections is a segment. A corner of the
// overlap is a vertex of one feature inside the other feature or, in space, a crossing of two
// edges. The gap at a corner is the height of b's surface minus the height of a's surface, both
// along the normal; it is negative where the shapes overlap. The contact point lies midway between
// the two surfaces.
//
// Each corner is found independently of the other corners, from the side of each edge line of one
// face on which each vertex of the other face lies. Neither face serves as the reference face, as
// it does in Sutherland-Hodgman clipping. So the feature keys of the points do not depend on the
// choice of a reference face.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/polytope/facing_features.hpp"

namespace moreau::detail {

/// The polygon in which two faces of polyhedra overlap, seen along the normal. Both faces are
/// stored counter-clockwise. Coordinates are relative to the centre of a [m]: x and y along the
/// tangents of the contact frame, h along the normal.
template <std::floating_point T>
class ContactPolygon {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polyhedron<T>>;

  /// @param near  a corner closer to an edge than this lies on the edge [m]
  ContactPolygon(const Shape& a, std::size_t face_a, const Shape& b, std::size_t face_b,
                 const Vector& normal, T near)
      : a_(a),
        b_(b),
        frame_(S::contact_frame(normal)),
        face_a_(face_a),
        face_b_(face_b),
        loop_a_(a.shape().face(face_a)),
        loop_b_(b.shape().face(face_b)),
        near_(near) {}

  /// Projects the two faces. Call it before for_each_corner.
  /// @param offset   centre of b minus centre of a, world axes [m]
  /// @param scratch  memory in which this object stores the projections; it must outlive the object
  void project(const Vector& offset, std::vector<T>& scratch) {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    scratch.resize(3 * (n + m) + 2 * n * m);
    corners_a_ = scratch.data();
    corners_b_ = corners_a_ + 3 * n;
    beside_a_ = corners_b_ + 3 * m;
    beside_b_ = beside_a_ + n * m;
    for (std::size_t i = 0; i < n; ++i) project(a_.vertices()[loop_a_[i]], corners_a_ + 3 * i);
    // Seen along the normal, b's face is clockwise. So its vertices are read in reverse order.
    for (std::size_t j = 0; j < m; ++j)
      project(b_.vertices()[loop_b_[m - 1 - j]] + offset, corners_b_ + 3 * j);
    sides(corners_a_, n, corners_b_, m, beside_a_, sides_a_);
    sides(corners_b_, m, corners_a_, n, beside_b_, sides_b_);
    plane_a_ = plane(a_, face_a_, Vector::Zero());
    plane_b_ = plane(b_, face_b_, offset);
  }

  /// Calls use(ManifoldPoint) for each corner of the polygon.
  template <class Use>
  void for_each_corner(Use&& use) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (is_outside(sides_b_, beside_b_, n, i, m)) continue;
      const T* p = corners_a_ + 3 * i;
      use(point(p[0], p[1], p[2], height(plane_b_, p),
                FeatureKey(FeatureKey::Kind::vertex_face, loop_a_[i], face_b_)));
    }
    for (std::size_t j = 0; j < m; ++j) {
      if (is_outside(sides_a_, beside_a_, m, j, n) || is_corner_of_a(j)) continue;
      const T* q = corners_b_ + 3 * j;
      use(point(q[0], q[1], height(plane_a_, q), q[2],
                FeatureKey(FeatureKey::Kind::face_vertex, face_a_, loop_b_[m - 1 - j])));
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_small()) {
        for (std::size_t j = 0; j < m; ++j) cross(i, j, use);
        continue;
      }
      for (std::uint64_t left = sides_a_.splits[i]; left != 0; left &= left - 1) {
        const auto j = static_cast<std::size_t>(std::countr_zero(left));
        if (sides_b_.splits[j] >> i & 1) cross(i, j, use);
      }
    }
  }

 private:
  using Loop = std::span<const std::uint32_t>;
  /// The signs of the result of sides(), for faces of at most 64 vertices.
  struct Signs {
    std::uint64_t outside = 0;  // bit j: point j lies to the right of an edge
    bool has_zero = false;      // whether a point counts as on an edge
    // Bit j of entry i: points j and j + 1 lie on different sides of edge i, neither on its line.
    std::array<std::uint64_t, 64> splits;
  };
  bool is_small() const { return std::max(loop_a_.size(), loop_b_.size()) <= 64; }

  /// Writes the coordinates x, y and h of a point given relative to the centre of a, in world axes.
  void project(const Vector& x, T* corner) const {
    corner[0] = frame_.col(1).dot(x);
    corner[1] = frame_.col(2).dot(x);
    corner[2] = frame_.col(0).dot(x);
  }

  /// Computes on which side of each edge each point lies. side[i * m + j] is twice the area of the
  /// triangle of edge i and point j [m^2], > 0 if point j lies to the left of edge i and 0 if point
  /// j is so close to the line of edge i that it counts as on the edge.
  void sides(const T* edges, std::size_t n, const T* points, std::size_t m, T* side,
             Signs& signs) const {
    const bool small = is_small();
    for (std::size_t i = 0; i < n; ++i) {
      std::uint64_t left = 0, right = 0;
      const T* from = edges + 3 * i;
      const T* to = edges + 3 * (i + 1 < n ? i + 1 : 0);
      const T x = to[0] - from[0], y = to[1] - from[1];
      const T on_it = near_ * (std::abs(x) + std::abs(y));
      for (std::size_t j = 0; j < m; ++j) {
        const T area = x * (points[3 * j + 1] - from[1]) - y * (points[3 * j] - from[0]);
        const T beside = std::abs(area) <= on_it ? T(0) : area;
        side[i * m + j] = beside;
        left |= std::uint64_t{beside > T(0)} << (j & 63);
        right |= std::uint64_t{beside < T(0)} << (j & 63);
      }
      if (!small) continue;
      const auto next = [&](std::uint64_t bits) { return bits >> 1 | (bits & 1) << (m - 1); };
      signs.splits[i] = (left & next(right)) | (right & next(left));
      signs.outside |= right;
      signs.has_zero = signs.has_zero || (left | right) != ~std::uint64_t{0} >> (64 - m);
    }
  }
  /// Whether point j lies to the right of one of the edges.
  bool is_outside(const Signs& signs, const T* side, std::size_t points, std::size_t j,
                  std::size_t edges) const {
    return is_small() ? (signs.outside >> j & 1) != 0 : !is_inside(side, points, j, edges);
  }
  static bool is_inside(const T* side, std::size_t points, std::size_t j, std::size_t edges) {
    for (std::size_t i = 0; i < edges; ++i)
      if (side[i * points + j] < T(0)) return false;
    return true;
  }
  /// Whether corner j of b coincides with a corner of a inside b's face, for which `use` was called
  /// already.
  bool is_corner_of_a(std::size_t j) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    if (is_small() && !sides_a_.has_zero) return false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = i > 0 ? i - 1 : n - 1;
      if (beside_a_[before * m + j] == T(0) && beside_a_[i * m + j] == T(0) &&
          is_inside(beside_b_, n, i, m))
        return true;
    }
    return false;
  }

  /// Calls use(ManifoldPoint) for the crossing of edge i of a and edge j of b, if they cross
  /// between their ends.
  template <class Use>
  void cross(std::size_t i, std::size_t j, Use& use) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    const std::size_t i1 = i + 1 < n ? i + 1 : 0, j1 = j + 1 < m ? j + 1 : 0;
    const T from_a = beside_b_[j * n + i], to_a = beside_b_[j * n + i1];
    const T from_b = beside_a_[i * m + j], to_b = beside_a_[i * m + j1];
    if (from_a * to_a >= T(0) || from_b * to_b >= T(0)) return;
    const T t = from_a / (from_a - to_a), u = from_b / (from_b - to_b);
    const auto along = [](const T* p, const T* q, T s, int k) { return p[k] + s * (q[k] - p[k]); };
    const T* p = corners_a_ + 3 * i;
    const T* p1 = corners_a_ + 3 * i1;
    const auto edges_b = b_.shape().face_edges(face_b_);
    use(point(along(p, p1, t, 0), along(p, p1, t, 1), along(p, p1, t, 2),
              along(corners_b_ + 3 * j, corners_b_ + 3 * j1, u, 2),
              FeatureKey(FeatureKey::Kind::edge_edge, a_.shape().face_edges(face_a_)[i],
                         edges_b[j + 1 < m ? m - 2 - j : m - 1])));
  }

  /// Coefficients of the plane of a face: h = plane[0] + plane[1] x + plane[2] y [m].
  std::array<T, 3> plane(const Shape& shape, std::size_t face, const Vector& center) const {
    const Vector normal = shape.normals()[face];
    const T inverse = T(1) / normal.dot(frame_.col(0));
    return {(shape.offset(face) + normal.dot(center)) * inverse,
            -normal.dot(frame_.col(1)) * inverse, -normal.dot(frame_.col(2)) * inverse};
  }
  static T height(const std::array<T, 3>& plane, const T* p) {
    return plane[0] + plane[1] * p[0] + plane[2] * p[1];
  }
  ManifoldPoint<S> point(T x, T y, T height_a, T height_b, FeatureKey key) const {
    const Vector middle(T(0.5) * (height_a + height_b), x, y);
    return {a_.center() + frame_ * middle, height_b - height_a, key};
  }

  const Shape& a_;
  const Shape& b_;
  const typename S::Matrix frame_;
  const std::size_t face_a_, face_b_;
  const Loop loop_a_, loop_b_;
  const T near_;
  T *corners_a_ = nullptr, *corners_b_ = nullptr;  // x, y, h of each corner [m]
  T* beside_a_ = nullptr;  // result of sides() for a's edges and b's corners
  T* beside_b_ = nullptr;  // result of sides() for b's edges and a's corners
  Signs sides_a_, sides_b_;
  std::array<T, 3> plane_a_{}, plane_b_{};
};

/// The segment in which two edges in the plane overlap, seen along the normal. Edge a belongs to a
/// polygon or is a segment shape; edge b belongs to a polygon. Coordinates are relative to the
/// centre of a [m]: x along the tangent, h along the normal.
template <std::floating_point T>
class ContactSegment {
 public:
  using S = Space<2, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polygon<T>>;

  /// @param a       a polygon, or a segment shape, whose only edge has index 0
  /// @param offset  centre of b minus centre of a, world axes [m]
  /// @param near    two ends closer together than this count as one point [m]
  template <class ShapeA>
  ContactSegment(const ShapeA& a, std::uint32_t edge_a, const Shape& b, std::uint32_t edge_b,
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
    T height(T x) const {
      const T along = ends[1].x - ends[0].x;
      const T t = along == T(0) ? T(0) : (x - ends[0].x) / along;
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

/// The overlap of the facing features of a pair. Call for_each_corner of the result.
/// @param normal   normal of the contact, unit, from a to b, world axes
/// @param scratch  memory that the result refers to
template <std::floating_point T>
ContactPolygon<T> contact_polygon(const PolytopePair<Polyhedron<T>>& pair,
                                  const FacingFeatures& facing,
                                  const typename Space<3, T>::Vector& normal,
                                  std::vector<T>& scratch) {
  ContactPolygon<T> polygon(pair.a, facing.a, pair.b, facing.b, normal,
                            pair.size * DetectionTolerance<T>::coincident);
  polygon.project(pair.offset, scratch);
  return polygon;
}
template <std::floating_point T>
ContactSegment<T> contact_polygon(const PolytopePair<Polygon<T>>& pair,
                                  const FacingFeatures& facing,
                                  const typename Space<2, T>::Vector& normal, std::vector<T>&) {
  return {pair.a,
          facing.a,
          pair.b,
          facing.b,
          pair.offset,
          normal,
          pair.size * DetectionTolerance<T>::coincident};
}

}  // namespace moreau::detail
