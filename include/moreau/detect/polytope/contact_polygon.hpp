// SPDX-License-Identifier: MIT
// contact_polygon: the region in which two facing features overlap, seen along the normal of the
// contact, and the gap between the two surfaces at each corner of the region. The contact points of
// polytopes get their gaps here.
//
// In space the features are faces, and the overlap of their projections is a convex polygon. In the
// plane the features are edges, and the overlap of their projections is a segment (contact_line.hpp). A corner of the
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
#include <cstring>
#include <limits>
#include <span>

#include "moreau/core/list.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/polytope/contact_line.hpp"
#include "moreau/detect/polytope/facing_features.hpp"
#include "moreau/simd/wide.hpp"

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
  void project(const Vector& offset, List<T>& scratch) {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    const std::size_t wide_n = padded(n), wide_m = padded(m);
    scratch.resize(3 * (wide_n + wide_m) + n * wide_m + m * wide_n);
    corners_a_ = {scratch.data(), wide_n};
    corners_b_ = {corners_a_.end(), wide_m};
    beside_a_ = {corners_b_.end(), wide_m};
    beside_b_ = {beside_a_.side + n * wide_m, wide_n};
    for (std::size_t i = 0; i < n; ++i) project(a_.vertices()[loop_a_[i]], corners_a_, i);
    // Seen along the normal, b's face is clockwise. So its vertices are read in reverse order.
    for (std::size_t j = 0; j < m; ++j)
      project(b_.vertices()[loop_b_[m - 1 - j]] + offset, corners_b_, j);
    corners_a_.fill(n);
    corners_b_.fill(m);
    sides(corners_a_, n, corners_b_, m, beside_a_, sides_a_);
    sides(corners_b_, m, corners_a_, n, beside_b_, sides_b_);
    plane_a_ = plane(a_, face_a_, Vector::Zero());
    plane_b_ = plane(b_, face_b_, offset);
    highest_a_ = *std::max_element(&corners_a_.h(0), &corners_a_.h(0) + n);
    lowest_b_ = *std::min_element(&corners_b_.h(0), &corners_b_.h(0) + m);
  }

  /// Calls use(ManifoldPoint) for each corner of the polygon.
  template <class Use>
  void for_each_corner(Use&& use) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (is_outside(sides_b_, beside_b_, i, m)) continue;
      const T x = corners_a_.x(i), y = corners_a_.y(i);
      use(point(x, y, corners_a_.h(i), std::max(height(plane_b_, x, y), lowest_b_),
                FeatureKey(FeatureKey::Kind::vertex_face, loop_a_[i], face_b_)));
    }
    for (std::size_t j = 0; j < m; ++j) {
      if (is_outside(sides_a_, beside_a_, j, n) || is_corner_of_a(j)) continue;
      const T x = corners_b_.x(j), y = corners_b_.y(j);
      use(point(x, y, std::min(height(plane_a_, x, y), highest_a_), corners_b_.h(j),
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

  std::span<const std::uint32_t> loop_a() const { return loop_a_; }  ///< vertices of a's face
  std::span<const std::uint32_t> loop_b() const { return loop_b_; }  ///< vertices of b's face
  /// Heights of the lowest vertex of a's face and of the highest of b's face, along the normal [m].
  std::array<T, 2> unevenness() const {
    return {*std::min_element(&corners_a_.h(0), &corners_a_.h(0) + loop_a_.size()),
            *std::max_element(&corners_b_.h(0), &corners_b_.h(0) + loop_b_.size())};
  }
  /// How far one face can move across the normal before the faces no longer overlap [m], at least. Zero if they do
  /// not overlap. Seen along the normal, the differences of points of the faces are a polygon whose edges
  /// are parallel to the edges of the faces, and this is the distance of the origin from its rim.
  T clearance() const {
    const T least = std::min(clearance2(corners_a_, loop_a_.size(), beside_a_, loop_b_.size()),
                             clearance2(corners_b_, loop_b_.size(), beside_b_, loop_a_.size()));
    return least > T(0) ? std::sqrt(least) : T(0);
  }
  /// Calls use(edge of a, edge of b), the indices of the edges, for all edges of the two faces that are nearly
  /// parallel (the sine of their angle is at most about 0.01) and so near to each other that their lines can
  /// cross between their ends.
  template <class Use>
  void for_each_parallel(Use&& use) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const T own = corners_a_.length2(i, n);
      for (std::size_t j = 0; j < m; ++j) {
        const T from = beside_a_(i, j), to = beside_a_(i, j + 1 < m ? j + 1 : 0);
        const T turn = to - from, other = corners_b_.length2(j, m);
        if (turn * turn > T(1.1e-4) * own * other) continue;
        const T nearest = std::min(std::abs(from), std::abs(to));
        if (nearest * nearest > T(1e-3) * own * (own + other)) continue;
        use(a_.shape().face_edges(face_a_)[i], b_.shape().face_edges(face_b_)[edge_of_b(j)]);
      }
    }
  }

 private:
  using Loop = std::span<const std::uint32_t>;
  using Lanes = Wide<T>;

  static std::size_t padded(std::size_t count) {
    return std::size_t(Lanes::padded(std::ptrdiff_t(count)));
  }
  /// The projected vertices of a face: x of all, then y, then h, each filled up to whole registers [m].
  struct Corners {
    T* data = nullptr;
    std::size_t wide = 0;
    T* end() const { return data + 3 * wide; }
    T& x(std::size_t i) const { return data[i]; }
    T& y(std::size_t i) const { return data[wide + i]; }
    T& h(std::size_t i) const { return data[2 * wide + i]; }
    /// The rest of the registers: copies of the first vertex.
    void fill(std::size_t count) const {
      for (std::size_t i = count; i < wide; ++i) x(i) = x(0), y(i) = y(0), h(i) = h(0);
    }
    /// From vertex i to the next one, across the normal.
    std::array<T, 2> edge(std::size_t i, std::size_t count) const {
      const std::size_t next = i + 1 < count ? i + 1 : 0;
      return {x(next) - x(i), y(next) - y(i)};
    }
    T length2(std::size_t i, std::size_t count) const {
      const auto [along_x, along_y] = edge(i, count);
      return along_x * along_x + along_y * along_y;
    }
  };
  /// The result of sides().
  struct Beside {
    T* side = nullptr;
    std::size_t wide = 0;  // from one edge to the next
    T operator()(std::size_t edge, std::size_t point) const { return side[edge * wide + point]; }
  };
  /// The signs of the result of sides(), for faces of at most 64 vertices.
  struct Signs {
    std::uint64_t outside = 0;  // bit j: point j lies to the right of an edge
    bool has_zero = false;      // whether a point counts as on an edge
    // Bit j of entry i: points j and j + 1 lie on different sides of edge i, neither on its line.
    std::array<std::uint64_t, 64> splits;
  };
  bool is_small() const { return std::max(loop_a_.size(), loop_b_.size()) <= 64; }

  /// Writes the coordinates x, y and h of a point given relative to the centre of a, in world axes.
  void project(const Vector& x, const Corners& corners, std::size_t i) const {
    corners.x(i) = frame_.col(1).dot(x);
    corners.y(i) = frame_.col(2).dot(x);
    corners.h(i) = frame_.col(0).dot(x);
  }

  /// Computes on which side of each edge each point lies. side(i, j) is twice the area of the
  /// triangle of edge i and point j [m^2], > 0 if point j lies to the left of edge i and 0 if point
  /// j is so close to the line of edge i that it counts as on the edge.
  void sides(const Corners& edges, std::size_t n, const Corners& points, std::size_t m,
             const Beside& beside, Signs& signs) const {
    const bool small = is_small();
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - std::min<std::size_t>(m, 64));
    for (std::size_t i = 0; i < n; ++i) {
      std::uint64_t left = 0, right = 0;
      const auto [x, y] = edges.edge(i, n);
      const T on_it = near_ * (std::abs(x) + std::abs(y)), from_x = edges.x(i), from_y = edges.y(i);
      for (std::size_t j = 0; j < m; j += Lanes::lanes) {
        const auto area =
            x * (Lanes::load(&points.y(j)) - from_y) - y * (Lanes::load(&points.x(j)) - from_x);
        const auto is_left = area > on_it, is_right = area < -on_it;
        const auto side = is_left | is_right ? area : typename Lanes::Values{};
        std::memcpy(beside.side + i * beside.wide + j, &side, sizeof side);
        left |= std::uint64_t{Lanes::bits(is_left)} << (j & 63);
        right |= std::uint64_t{Lanes::bits(is_right)} << (j & 63);
      }
      if (!small) continue;
      left &= all, right &= all;
      const auto next = [&](std::uint64_t bits) { return bits >> 1 | (bits & 1) << (m - 1); };
      signs.splits[i] = (left & next(right)) | (right & next(left));
      signs.outside |= right;
      signs.has_zero = signs.has_zero || (left | right) != all;
    }
  }
  /// The square of the least distance, over the edges, of the farthest point to the left of the edge [m^2].
  static T clearance2(const Corners& edges, std::size_t n, const Beside& beside, std::size_t m) {
    T least = std::numeric_limits<T>::infinity();
    for (std::size_t i = 0; i < n; ++i) {
      auto most = Lanes::load(beside.side + i * beside.wide);
      for (std::size_t j = Lanes::lanes; j < m; j += Lanes::lanes) {
        const auto here = Lanes::load(beside.side + i * beside.wide + j);
        most = here > most ? here : most;
      }
      const T inside = std::max(Lanes::maximum(most)[0], T(0));
      least = std::min(least, inside * inside / edges.length2(i, n));
    }
    return least;
  }
  /// Whether point j lies to the right of one of the edges.
  bool is_outside(const Signs& signs, const Beside& beside, std::size_t j,
                  std::size_t edges) const {
    return is_small() ? (signs.outside >> j & 1) != 0 : !is_inside(beside, j, edges);
  }
  static bool is_inside(const Beside& beside, std::size_t j, std::size_t edges) {
    for (std::size_t i = 0; i < edges; ++i)
      if (beside(i, j) < T(0)) return false;
    return true;
  }
  /// Whether corner j of b coincides with a corner of a inside b's face, for which `use` was called
  /// already.
  bool is_corner_of_a(std::size_t j) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    if (is_small() && !sides_a_.has_zero) return false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = i > 0 ? i - 1 : n - 1;
      if (beside_a_(before, j) == T(0) && beside_a_(i, j) == T(0) && is_inside(beside_b_, i, m))
        return true;
    }
    return false;
  }
  /// The position in b's face of its edge j in reverse order.
  std::size_t edge_of_b(std::size_t j) const {
    const std::size_t m = loop_b_.size();
    return j + 1 < m ? m - 2 - j : m - 1;
  }

  /// Calls use(ManifoldPoint) for the crossing of edge i of a and edge j of b, if they cross
  /// between their ends.
  template <class Use>
  void cross(std::size_t i, std::size_t j, Use& use) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    const std::size_t i1 = i + 1 < n ? i + 1 : 0, j1 = j + 1 < m ? j + 1 : 0;
    const T from_a = beside_b_(j, i), to_a = beside_b_(j, i1);
    const T from_b = beside_a_(i, j), to_b = beside_a_(i, j1);
    if (from_a * to_a >= T(0) || from_b * to_b >= T(0)) return;
    const T t = from_a / (from_a - to_a), u = from_b / (from_b - to_b);
    const auto along = [](T p, T q, T s) { return p + s * (q - p); };
    const Corners &a = corners_a_, &b = corners_b_;
    use(point(along(a.x(i), a.x(i1), t), along(a.y(i), a.y(i1), t), along(a.h(i), a.h(i1), t),
              along(b.h(j), b.h(j1), u),
              FeatureKey(FeatureKey::Kind::edge_edge, a_.shape().face_edges(face_a_)[i],
                         b_.shape().face_edges(face_b_)[edge_of_b(j)])));
  }

  /// Coefficients of the plane of a face: h = plane[0] + plane[1] x + plane[2] y [m].
  std::array<T, 3> plane(const Shape& shape, std::size_t face, const Vector& center) const {
    const Vector normal = shape.normals()[face];
    const T inverse = T(1) / normal.dot(frame_.col(0));
    return {(shape.offset(face) + normal.dot(center)) * inverse,
            -normal.dot(frame_.col(1)) * inverse, -normal.dot(frame_.col(2)) * inverse};
  }
  static T height(const std::array<T, 3>& plane, T x, T y) {
    return plane[0] + plane[1] * x + plane[2] * y;
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
  Corners corners_a_, corners_b_;
  Beside beside_a_;  // result of sides() for a's edges and b's corners
  Beside beside_b_;  // result of sides() for b's edges and a's corners
  Signs sides_a_, sides_b_;
  std::array<T, 3> plane_a_{}, plane_b_{};
  // Heights of the vertices of the two faces that bound their planes. A corner counts as inside a face up to `near`
  // beyond an edge, where the plane of a steep face continued would be far deeper than the surface.
  T highest_a_ = 0, lowest_b_ = 0;
};

/// The overlap of the facing features of a pair. Call for_each_corner of the result.
/// @param normal   normal of the contact, unit, from a to b, world axes
/// @param scratch  memory that the result refers to
template <std::floating_point T>
ContactPolygon<T> contact_polygon(const PolytopePair<Polyhedron<T>>& pair,
                                  const FacingFeatures& facing,
                                  const typename Space<3, T>::Vector& normal, List<T>& scratch) {
  ContactPolygon<T> polygon(pair.a, facing.a, pair.b, facing.b, normal,
                            pair.size * DetectionTolerance<T>::coincident);
  polygon.project(pair.offset, scratch);
  return polygon;
}
template <std::floating_point T>
ContactLine<T> contact_polygon(const PolytopePair<Polygon<T>>& pair, const FacingFeatures& facing,
                               const typename Space<2, T>::Vector& normal, List<T>&) {
  return {pair.a,
          facing.a,
          pair.b,
          facing.b,
          pair.offset,
          normal,
          pair.size * DetectionTolerance<T>::coincident};
}

}  // namespace moreau::detail
