// SPDX-License-Identifier: MIT
// A convex shape against a mesh wall, in the frame of the wall.
//
// Only the outside of the wall counts: a facet takes part if the centre of the shape lies in front of
// its plane. The contact points are those at which the features of the two surfaces can touch first:
//
//   1. a vertex of the shape above a facet, or below it by a small depth. The normal is that of the
//      facet. All points on one face of the wall (facets in one plane that are connected) make one
//      manifold, as on a half-space: the ridges between them are not seen;
//   2. in space, an edge of the shape and a convex ridge of the wall that cross;
//   3. a vertex of the shape and a convex ridge, if the vertex is nearest to the ridge;
//   4. a tip of the wall (a vertex at which convex ridges end) and the nearest feature of the shape.
//
// A normal of 2, 3 and 4 must lie between the normals of the facets that join there: in the normal
// cone of the ridge or the tip. The shape must lie on one side of the plane through the point, so that
// the normal lies in its normal cone as well. Therefore no ridge between coplanar facets and no
// concave ridge ever gives a contact, and of several facets that join only one gives it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pairs/collide_half_space.hpp"
#include "moreau/detect/pairs/mesh_core.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/shape/mesh_wall.hpp"

namespace moreau {

namespace detail {

/// Whether a shape can touch a mesh wall.
template <class ShapeT>
inline constexpr bool touches_mesh = false;
template <class S>
inline constexpr bool touches_mesh<BallIn<S>> = true;
template <class S>
inline constexpr bool touches_mesh<Segment<S>> = true;
template <class T>
inline constexpr bool touches_mesh<Polygon<T>> = true;
template <class T>
inline constexpr bool touches_mesh<Polyhedron<T>> = true;
template <class Core>
inline constexpr bool touches_mesh<Rounded<Core>> = touches_mesh<Core>;
template <class... Shapes>
inline constexpr bool touches_mesh<OneOf<Shapes...>> = (touches_mesh<Shapes> && ...);

}  // namespace detail

/// A shape that can touch a mesh wall: balls, polygons, polyhedra, capsules, rounded shapes of these,
/// and OneOf of these.
template <class ShapeT>
concept MeshCollidable = detail::touches_mesh<ShapeT>;

/// Memory of collisions with mesh walls, used again from one to the next.
struct MeshScratch {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> facets;  ///< (face, facet)
  std::vector<std::uint32_t> ridges;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tips;  ///< (vertex, facet)
};

namespace detail {

template <class ShapeT>
class MeshCollision {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Wall = MeshWall<S>;

  /// @param radius of the rounding around the core [m]
  /// @param margin largest gap [m]
  MeshCollision(const Placed<ShapeT>& a, T radius, const Wall& wall, T margin, MeshScratch& scratch,
                Manifold<S>& out)
      : core_(a),
        wall_(wall),
        center_(core_.center()),
        radius_(radius),
        margin_(margin + radius),
        rounding_((core_.size() + radius) * DetectionTolerance<T>::rounding),
        near_((core_.size() + radius) * DetectionTolerance<T>::coincident),
        scratch_(scratch),
        out_(out) {}

  /// Collects what may touch.
  /// @param box around the shape [m]
  void find(const Aabb<S>& box) {
    scratch_.facets.clear();
    scratch_.ridges.clear();
    scratch_.tips.clear();
    wall_.tree().query(box.inflated(margin_ - radius_), [&](std::uint32_t f) { consider(f); });
    std::sort(scratch_.facets.begin(), scratch_.facets.end());
    unique(scratch_.ridges);
    unique(scratch_.tips);
  }

  /// Calls use(face) for each manifold on a face.
  template <class Use>
  bool touch_faces(const Use& use) {
    bool touch = false;
    const auto& facets = scratch_.facets;
    for (std::size_t begin = 0, end = 0; begin < facets.size(); begin = end) {
      while (end < facets.size() && facets[end].first == facets[begin].first) ++end;
      if (!touch_face(begin, end)) continue;
      finish();
      use(facets[begin].first);
      touch = true;
    }
    return touch;
  }
  /// Calls use() for each contact at a ridge or a tip, a manifold of one point.
  template <class Use>
  bool touch_points(const Use& use) {
    bool touch = false;
    const auto add = [&](const Vector& to_shape, T gap, const Vector& x, FeatureKey key) {
      out_.set_single_point(-to_shape, gap, center_ + (x - gap / 2 * to_shape), key);
      finish();
      use();
      touch = true;
    };
    for (const std::uint32_t r : scratch_.ridges) touch_ridge(S{}, r, add);
    for (std::size_t k = 0; k < scratch_.tips.size(); ++k)
      if (k == 0 || scratch_.tips[k].first != scratch_.tips[k - 1].first) touch_tip(k, add);
    return touch;
  }

 private:
  template <class X>
  static void unique(std::vector<X>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  /// Height of the centre above the plane of a facet [m].
  T height(const typename Wall::Side& side) const {
    return side.normal.dot(center_) - wall_.offset(side.face);
  }
  /// Takes a facet if the shape is in front of it and not beyond its plane or one of its ridges.
  void consider(std::uint32_t f) {
    const auto& side = wall_.side(f);
    const T above = height(side);
    if (!(above > 0) || above - core_.reach(-side.normal) > margin_) return;
    for (std::size_t k = 0; k < side.inward.size(); ++k)
      if (side.inward[k].dot(center_) + core_.reach(side.inward[k]) <
          side.inward_offset[k] - margin_)
        return;
    scratch_.facets.emplace_back(side.face, f);
    for (const std::uint32_t r : side.ridge)
      if (r != Wall::none) scratch_.ridges.push_back(r);
    for (const std::uint32_t v : wall_.facet(f))
      if (wall_.is_tip(v)) scratch_.tips.emplace_back(v, f);
  }

  /// The points above one face: above the facets begin .. end - 1 of the list.
  bool touch_face(std::size_t begin, std::size_t end) {
    const std::uint32_t face = scratch_.facets[begin].first;
    const Vector normal = -wall_.side(face).normal;  // into the wall
    const T above = height(wall_.side(face)), gap = above - core_.reach(normal);
    out_.start(normal, gap);
    // A shape that passes below the plane of the face stands beside it.
    const bool is_beside = gap < -margin_;
    const T highest = is_beside ? T(0) : margin_;
    core_.for_each_above(normal, above - highest - rounding_, [&](std::uint32_t v) {
      const Vector x = core_.vertex(v);
      const T gap_v = above - normal.dot(x);
      if (gap_v < -core_.deepest()) return;
      for (std::size_t k = begin; k < end; ++k) {
        if (!is_above(scratch_.facets[k].second, center_ + x, gap_v)) continue;
        out_.points.push_back({center_ + (x + T(0.5) * gap_v * normal), gap_v,
                               FeatureKey(vertex_on_face(S{}), v, face)});
        return;
      }
    });
    if (out_.points.empty()) return false;
    out_.contact_class = class_at_plane(S{}, out_.points.size());
    return true;
  }
  /// Whether a point projects onto a facet. A point below it must not be nearer to the other facet of
  /// a convex ridge, out of which it would be pushed.
  bool is_above(std::uint32_t f, const Vector& x, T gap) const {
    const auto& side = wall_.side(f);
    for (std::size_t k = 0; k < side.inward.size(); ++k)
      if (side.inward[k].dot(x) < side.inward_offset[k] - near_) return false;
    if (gap >= 0) return true;
    for (const std::uint32_t r : side.ridge) {
      if (r == Wall::none) continue;
      const auto& pair = wall_.ridge(r).facet;
      const auto& other = wall_.side(pair[0] == f ? pair[1] : pair[0]);
      if (pair[0] == pair[1] || other.normal.dot(side.normal) < T(-0.99)) continue;  // a rim
      if (!(height(other) > 0)) continue;  // the shape does not touch this facet
      if (other.normal.dot(x) - wall_.offset(other.face) > gap + near_) return false;
    }
    return true;
  }

  /// In the plane a ridge is a tip.
  template <class Add>
  void touch_ridge(Space<2, T>, std::uint32_t, const Add&) {}
  template <class Add>
  void touch_ridge(Space<3, T>, std::uint32_t r, const Add& add) {
    const auto& ridge = wall_.ridge(r);
    const Vector from = wall_.vertex(ridge.vertices[0]) - center_;
    const Vector along = wall_.vertex(ridge.vertices[1]) - center_ - from;
    const T height_of_ridge = ridge.middle.dot(from);
    if (-core_.reach(-ridge.middle) - height_of_ridge > margin_) return;
    const T length = along.norm();
    const Vector unit = along / length;
    const auto is_in_cone = [&](const Vector& d) {
      return d.dot(ridge.beyond[0]) >= -aligned && d.dot(ridge.beyond[1]) >= -aligned;
    };
    core_.for_each_edge([&](std::uint32_t e, const Vector& p, const Vector& q) {
      const T low = std::min(ridge.middle.dot(p), ridge.middle.dot(q)) - height_of_ridge;
      if (low > margin_) return;
      const T one = unit.dot(p - from), two = unit.dot(q - from);
      if (std::max(one, two) < 0 || std::min(one, two) > length) return;
      const Vector edge = q - p, across = edge.cross(along), apart = from - p;
      const T across2 = across.squaredNorm();
      if (!(across2 > T(1e-8) * edge.squaredNorm() * length * length)) return;
      const T on_edge = apart.cross(along).dot(across) / across2;
      const T on_ridge = apart.cross(edge).dot(across) / across2;
      if (!(on_edge >= 0 && on_edge <= 1 && on_ridge >= 0 && on_ridge <= 1)) return;
      Vector d = across / std::sqrt(across2);
      if (!is_in_cone(d)) d = -d;
      if (!is_in_cone(d)) return;
      const T gap = d.dot(p - from);
      if (!is_near(gap) || !is_lowest(p, d)) return;
      add(d, gap, Vector(p + on_edge * edge), FeatureKey(FeatureKey::Kind::edge_edge, e, r));
    });
    core_.for_each_above(-ridge.middle, -height_of_ridge - margin_, [&](std::uint32_t v) {
      const Vector x = core_.vertex(v), apart = x - from;
      const T part = unit.dot(apart);
      if (!(part > 0 && part < length)) return;
      const Vector away = apart - part * unit;
      const T gap = away.norm();
      if (!(gap > near_ && gap <= margin_)) return;
      const Vector d = away / gap;
      // Strictly between the facets: above a facet the vertex touches the facet.
      if (!(d.dot(ridge.beyond[0]) > aligned && d.dot(ridge.beyond[1]) > aligned)) return;
      if (is_lowest(x, d)) add(d, gap, x, FeatureKey(FeatureKey::Kind::vertex_edge, v, r));
    });
  }
  template <class Add>
  void touch_tip(std::size_t first, const Add& add) {
    const std::uint32_t v = scratch_.tips[first].first;
    const Vector x = wall_.vertex(v) - center_;
    if (x.norm() > core_.size() + margin_) return;
    const auto found = core_.distance(x);
    if (!is_near(found.distance)) return;
    const Vector d = -found.outward;
    if (!wall_.is_top(v, d, aligned)) return;
    bool is_outside = false;
    for (std::size_t k = first; k < scratch_.tips.size() && scratch_.tips[k].first == v; ++k)
      is_outside = is_outside || d.dot(wall_.side(scratch_.tips[k].second).normal) >= -aligned;
    if (!is_outside) return;
    add(d, found.distance, Vector(x - found.distance * found.outward),
        FeatureKey(found.feature.kind(), found.feature.a(), v));
  }
  bool is_near(T gap) const { return gap <= margin_ && gap >= -core_.deepest(); }
  /// Whether no point of the shape lies below x along d.
  bool is_lowest(const Vector& x, const Vector& d) const {
    return core_.reach(-d) <= -d.dot(x) + near_;
  }
  /// Moves points of the core to midway between the surfaces.
  void finish() {
    out_.gap -= radius_;
    for (auto& point : out_.points) {
      point.gap -= radius_;
      point.position += radius_ / 2 * out_.normal;
    }
  }

  static constexpr T aligned = T(1e-6);  ///< sine of the largest angle outside of a normal cone [-]
  const MeshCore<ShapeT> core_;
  const Wall& wall_;
  const Vector center_;
  const T radius_, margin_, rounding_, near_;
  MeshScratch& scratch_;
  Manifold<S>& out_;
};

/// Collides the core of a shape, with the radius around it.
template <class ShapeT, class Wall, class T, class UseFace, class UsePoint>
bool collide_core(const Placed<ShapeT>& a, T radius, const Wall& wall, T margin,
                  const Aabb<SpaceOf<ShapeT>>& box, MeshScratch& scratch,
                  Manifold<SpaceOf<ShapeT>>& out, const UseFace& use_face,
                  const UsePoint& use_point) {
  if constexpr (is_rounded<ShapeT>) {
    return collide_core(a.core(), radius + a.rounding_radius(), wall, margin, box, scratch, out,
                        use_face, use_point);
  } else if constexpr (is_one_of<ShapeT>) {
    return a.visit([&](const auto& held) {
      return collide_core(held, radius, wall, margin, box, scratch, out, use_face, use_point);
    });
  } else {
    T thickness = radius;
    if constexpr (is_sphere<ShapeT>) thickness += a.radius();
    MeshCollision<ShapeT> collision(a, thickness, wall, margin, scratch, out);
    collision.find(box);
    const bool faces = collision.touch_faces(use_face), points = collision.touch_points(use_point);
    return faces || points;
  }
}

}  // namespace detail

/// Computes the contact points of a shape with a mesh wall. Feature keys have the number of a face
/// (MeshWall::Side::face), a ridge or a vertex of the wall as b.
/// @param a         placed in the frame of the wall
/// @param margin    largest gap of a contact point [m], >= 0
/// @param out       overwritten for each manifold, in the frame of the wall
/// @param use_face  called with the number of the face when `out` has the points on a face
/// @param use_point called without arguments when `out` has one point at a ridge or a tip
/// @returns whether there was a contact point
template <class ShapeT, class UseFace, class UsePoint>
requires MeshCollidable<ShapeT>
bool collide_each(const Placed<ShapeT>& a, const MeshWall<SpaceOf<ShapeT>>& wall,
                  typename SpaceOf<ShapeT>::Scalar margin, MeshScratch& scratch,
                  Manifold<SpaceOf<ShapeT>>& out, const UseFace& use_face,
                  const UsePoint& use_point) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  MOREAU_ASSERT(margin >= 0);
  return detail::collide_core(a, T(0), wall, margin, a.bounding_box(), scratch, out, use_face,
                              use_point);
}

}  // namespace moreau
