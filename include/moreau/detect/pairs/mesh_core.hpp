// SPDX-License-Identifier: MIT
// A collision with a mesh wall needs these functions of a convex shape: its vertices and edges, how far it
// reaches in a direction, and the distance of a point. A ball is a point with a radius, a capsule a segment
// with a radius. Positions are relative to the centre of the shape, in the frame of the wall.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pairs/collide_ball_polytope.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/segment.hpp"

namespace moreau::detail {

/// The distance of a point x from a shape, < 0 inside, and the features at which it is measured: the
/// key has the feature of the shape as a, and 0 as b.
template <class S>
struct CoreDistance {
  typename S::Scalar distance;  ///< [m]
  typename S::Vector outward;   ///< unit normal of the shape towards the point
  FeatureKey feature;
};

/// Of a polygon or polyhedron.
template <class ShapeT>
class MeshCore {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr bool has_inside = true;

  explicit MeshCore(const Placed<ShapeT>& shape) : shape_(shape) {}
  Vector center() const { return shape_.center(); }
  T size() const { return shape_.radius(); }  ///< of a ball around the shape [m]
  /// Penetrations deeper than this are not treated [m].
  T deepest() const { return shape_.shape().inradius(); }
  T reach(const Vector& direction) const { return shape_.vertices().reach(direction); }
  Vector vertex(std::size_t v) const { return shape_.vertices()[v]; }
  /// Calls use(v) for each vertex with direction . vertex >= lowest.
  template <class Use>
  void for_each_above(const Vector& direction, T lowest, const Use& use) const {
    shape_.vertices().for_each_above(direction, lowest, use);
  }
  /// Calls use(e, w) for each edge e at vertex v; w is its other end. In the plane, where edges are the faces, it calls
  /// nothing.
  template <class Use>
  void for_each_edge_at(std::uint32_t v, const Use& use) const {
    if constexpr (requires { shape_.shape().edges(); }) {
      for (const std::uint32_t e : shape_.shape().vertex_edges(v)) {
        const auto& ends = shape_.shape().edges()[e].vertex;
        use(e, ends[0] == v ? ends[1] : ends[0]);
      }
    }
  }
  /// Calls use(f, normal, offset) for each face; the shape lies where normal . x <= offset [m].
  template <class Use>
  void for_each_face(const Use& use) const {
    for (Eigen::Index f = 0; f < shape_.shape().face_offsets().size(); ++f)
      use(std::uint32_t(f), Vector(shape_.normals()[std::size_t(f)]),
          shape_.offset(std::size_t(f)));
  }
  /// Whether a segment meets the shape, whose faces are moved outwards by `near` [m].
  bool meets(const Vector& from, const Vector& to, T near) const {
    T first = 0, last = 1;  // of the part of the segment that is behind all faces
    for (Eigen::Index f = 0; f < shape_.shape().face_offsets().size(); ++f) {
      const Vector normal = shape_.normals()[std::size_t(f)];
      const T offset = shape_.offset(std::size_t(f)) + near;
      const T begin = normal.dot(from) - offset, end = normal.dot(to) - offset;
      if (begin > 0 && end > 0) return false;
      if (begin > 0) first = std::max(first, begin / (begin - end));
      if (end > 0) last = std::min(last, begin / (begin - end));
    }
    return first <= last;
  }
  /// If the distance exceeds the margin, any distance that exceeds it.
  CoreDistance<S> distance(const Vector& x, T margin) const {
    const auto highest = highest_face(shape_, x);
    if (highest.value > margin) return {highest.value, Vector::Zero(), FeatureKey()};
    const auto found = point_distance(shape_, x, size());
    return {found.distance, found.outward, found.feature.swapped()};
  }

 private:
  const Placed<ShapeT>& shape_;
};

/// Of a point, the core of a ball.
template <class S>
class MeshCore<BallIn<S>> {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr bool has_inside = true;  // has no edges: is not asked

  explicit MeshCore(const Placed<BallIn<S>>& shape) : shape_(shape) {}
  Vector center() const { return shape_.center(); }
  T size() const { return 0; }
  T deepest() const { return 0; }
  T reach(const Vector&) const { return 0; }
  Vector vertex(std::size_t) const { return Vector::Zero(); }
  template <class Use>
  void for_each_above(const Vector&, T lowest, const Use& use) const {
    if (lowest <= 0) use(0U);
  }
  template <class Use>
  void for_each_edge_at(std::uint32_t, const Use&) const {}
  template <class Use>
  void for_each_face(const Use&) const {}
  bool meets(const Vector&, const Vector&, T) const { return true; }  // has no edges: is not asked
  CoreDistance<S> distance(const Vector& x, T) const {
    const T distance = x.norm();
    return {distance, distance > 0 ? Vector(x / distance) : Vector(Vector::UnitX()),
            FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0)};
  }

 private:
  const Placed<BallIn<S>>& shape_;
};

/// Of a segment, the core of a capsule.
template <class S>
class MeshCore<Segment<S>> {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr bool has_inside = false;

  explicit MeshCore(const Placed<Segment<S>>& shape) : shape_(shape) {}
  Vector center() const { return shape_.center(); }
  T size() const { return shape_.radius(); }
  T deepest() const { return shape_.radius() / 4; }
  T reach(const Vector& direction) const { return std::abs(direction.dot(shape_.half())); }
  Vector vertex(std::size_t v) const { return shape_.vertex(v); }
  template <class Use>
  void for_each_above(const Vector& direction, T lowest, const Use& use) const {
    for (std::uint32_t v = 0; v < 2; ++v)
      if (direction.dot(vertex(v)) >= lowest) use(v);
  }
  template <class Use>
  void for_each_edge_at(std::uint32_t v, const Use& use) const {
    use(0U, 1 - v);
  }
  template <class Use>
  void for_each_face(const Use&) const {}
  bool meets(const Vector&, const Vector&, T) const { return true; }  // has no inside
  CoreDistance<S> distance(const Vector& x, T) const {
    const Vector half = shape_.half();
    const T along = std::clamp(x.dot(half) / half.squaredNorm(), T(-1), T(1));
    const Vector apart = x - along * half;
    const T length = apart.norm();
    const bool is_end = std::abs(along) == 1;
    return {length, length > 0 ? Vector(apart / length) : any_normal(half),
            FeatureKey(is_end ? FeatureKey::Kind::vertex_vertex : FeatureKey::Kind::edge_vertex,
                       is_end && along > 0 ? 1 : 0, 0)};
  }

 private:
  static Vector any_normal(const Vector& half) {
    return S::contact_frame(half.normalized()).col(1);
  }
  const Placed<Segment<S>>& shape_;
};

}  // namespace moreau::detail
