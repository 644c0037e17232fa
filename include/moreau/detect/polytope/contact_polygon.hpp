// SPDX-License-Identifier: MIT
// Where two faces look at each other along a normal: the polygon in which their projections
// overlap, with the gap between the two planes at each of its corners.
//
// A corner is a vertex of one face inside the other, or a crossing of two edges. Each is found on
// its own, from the signs of every vertex against every edge line of the other face; none depends
// on which face is called the reference, so neither do the keys.
#pragma once

#include <cmath>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau::detail {

/// Two faces projected along the normal; counter-clockwise both. Coordinates relative to the centre
/// of a: x and y along the tangents, h along the normal.
template <std::floating_point T>
class ContactPolygon {
 public:
  using S = Space<3, T>;
  using Vector = typename S::Vector;
  using Shape = Placed<Polyhedron<T>>;

  /// @param offset  centre of b minus centre of a
  /// @param near    length below which a corner lies on an edge
  ContactPolygon(const Shape& a, std::size_t face_a, const Shape& b, std::size_t face_b,
                 const Vector& offset, const Vector& normal, T near, std::vector<T>& scratch)
      : a_(a),
        b_(b),
        frame_(S::contact_frame(normal)),
        face_a_(face_a),
        face_b_(face_b),
        loop_a_(a.shape().face(face_a)),
        loop_b_(b.shape().face(face_b)),
        near_(near) {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    scratch.resize(3 * (n + m) + 2 * n * m);
    corners_a_ = scratch.data();
    corners_b_ = corners_a_ + 3 * n;
    beside_a_ = corners_b_ + 3 * m;
    beside_b_ = beside_a_ + n * m;
    for (std::size_t i = 0; i < n; ++i) project(a.vertices()[loop_a_[i]], corners_a_ + 3 * i);
    // Seen along the normal, b's face runs clockwise: read it backwards.
    for (std::size_t j = 0; j < m; ++j)
      project(b.vertices()[loop_b_[m - 1 - j]] + offset, corners_b_ + 3 * j);
    sides(corners_a_, n, corners_b_, m, beside_a_);
    sides(corners_b_, m, corners_a_, n, beside_b_);
    plane_a_ = plane(a, face_a, Vector::Zero());
    plane_b_ = plane(b, face_b, offset);
  }

  /// Calls use(ManifoldPoint) for each corner.
  template <class Use>
  void for_each_corner(Use&& use) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_inside(beside_b_, n, i, m)) continue;
      const T* p = corners_a_ + 3 * i;
      use(point(p[0], p[1], p[2], height(plane_b_, p),
                FeatureKey(FeatureKey::Kind::vertex_face, loop_a_[i], face_b_)));
    }
    for (std::size_t j = 0; j < m; ++j) {
      if (!is_inside(beside_a_, m, j, n) || is_corner_of_a(j)) continue;
      const T* q = corners_b_ + 3 * j;
      use(point(q[0], q[1], height(plane_a_, q), q[2],
                FeatureKey(FeatureKey::Kind::face_vertex, face_a_, loop_b_[m - 1 - j])));
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < m; ++j) cross(i, j, use);
  }

 private:
  using Loop = std::span<const std::uint32_t>;

  void project(const Vector& x, T* corner) const {
    corner[0] = frame_.col(1).dot(x);
    corner[1] = frame_.col(2).dot(x);
    corner[2] = frame_.col(0).dot(x);
  }

  /// side[i * m + j]: twice the area of edge i and point j, > 0 if j lies left; 0 if it lies on it.
  void sides(const T* edges, std::size_t n, const T* points, std::size_t m, T* side) const {
    for (std::size_t i = 0; i < n; ++i) {
      const T* from = edges + 3 * i;
      const T* to = edges + 3 * (i + 1 < n ? i + 1 : 0);
      const T x = to[0] - from[0], y = to[1] - from[1];
      const T on_it = near_ * (std::abs(x) + std::abs(y));
      for (std::size_t j = 0; j < m; ++j) {
        const T area = x * (points[3 * j + 1] - from[1]) - y * (points[3 * j] - from[0]);
        side[i * m + j] = std::abs(area) <= on_it ? T(0) : area;
      }
    }
  }
  static bool is_inside(const T* side, std::size_t points, std::size_t j, std::size_t edges) {
    for (std::size_t i = 0; i < edges; ++i)
      if (side[i * points + j] < T(0)) return false;
    return true;
  }
  /// Whether corner j of b coincides with a corner of a that is in the polygon already.
  bool is_corner_of_a(std::size_t j) const {
    const std::size_t n = loop_a_.size(), m = loop_b_.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = i > 0 ? i - 1 : n - 1;
      if (beside_a_[before * m + j] == T(0) && beside_a_[i * m + j] == T(0) &&
          is_inside(beside_b_, n, i, m))
        return true;
    }
    return false;
  }

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

  /// h = plane[0] + plane[1] x + plane[2] y on a face.
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
  T *corners_a_, *corners_b_;  // x, y, h
  T *beside_a_, *beside_b_;    // of a's edges and b's corners; of b's edges and a's corners
  std::array<T, 3> plane_a_, plane_b_;
};

}  // namespace moreau::detail
