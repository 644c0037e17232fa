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
#include "moreau/shape/compound.hpp"
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
template <class Part>
inline constexpr bool touches_mesh<Compound<Part>> = touches_mesh<Part>;

}  // namespace detail

/// A shape that can touch a mesh wall: balls, polygons, polyhedra, capsules, rounded shapes of these,
/// OneOf and Compound of these.
template <class ShapeT>
concept MeshCollidable = detail::touches_mesh<ShapeT>;

/// Memory of collisions with mesh walls, used again from one to the next.
struct MeshScratch {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> facets;  ///< (face, facet)
  std::vector<std::uint32_t> ridges;                            ///< convex ridges near the shape
  std::vector<std::uint32_t> low;                               ///< vertices of the shape
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tips;    ///< (vertex, facet)
};

namespace detail {

/// The point of a segment nearest to the origin.
/// @param corners as columns [m]
template <std::floating_point T>
Eigen::Matrix<T, 2, 1> nearest_on_facet(const Eigen::Matrix<T, 2, 2>& corners) {
  const Eigen::Matrix<T, 2, 1> from = corners.col(0), along = corners.col(1) - from;
  return from + std::clamp(-from.dot(along) / along.squaredNorm(), T(0), T(1)) * along;
}
/// The point of a triangle nearest to the origin. Source: C. Ericson, Real-time collision detection
/// (2005), section 5.1.5: the region of the triangle follows from six products.
/// @param corners as columns [m]
template <std::floating_point T>
Eigen::Matrix<T, 3, 1> nearest_on_facet(const Eigen::Matrix<T, 3, 3>& corners) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  const Vector a = corners.col(0), b = corners.col(1), c = corners.col(2), ab = b - a, ac = c - a;
  const T a1 = -ab.dot(a), a2 = -ac.dot(a);
  if (a1 <= 0 && a2 <= 0) return a;
  const T b1 = -ab.dot(b), b2 = -ac.dot(b);
  if (b1 >= 0 && b2 <= b1) return b;
  const T in_c = a1 * b2 - b1 * a2;
  if (in_c <= 0 && a1 >= 0 && b1 <= 0) return a + a1 / (a1 - b1) * ab;
  const T c1 = -ab.dot(c), c2 = -ac.dot(c);
  if (c2 >= 0 && c1 <= c2) return c;
  const T in_b = c1 * a2 - a1 * c2;
  if (in_b <= 0 && a2 >= 0 && c2 <= 0) return a + a2 / (a2 - c2) * ac;
  const T in_a = b1 * c2 - c1 * b2;
  if (in_a <= 0 && b2 >= b1 && c1 >= c2) return b + (b2 - b1) / ((b2 - b1) + (c1 - c2)) * (c - b);
  const T all = in_a + in_b + in_c;
  return a + in_b / all * ab + in_c / all * ac;
}

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
    const Aabb<S> around = box.inflated(margin_ - radius_);
    wall_.tree().query(
        [&](const Aabb<S>& node) {
          return node.overlaps(around) &&
                 is_within(node.lower.cwiseMax(center_.cwiseMin(node.upper)) - center_);
        },
        [&](std::uint32_t k) { consider(k); });
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
  /// Calls use(none) for each contact at a ridge or a tip, a manifold of one point.
  template <class Use>
  bool touch_points(const Use& use) {
    bool touch = false;
    const auto add = [&](const Vector& to_shape, T gap, const Vector& x, FeatureKey key) {
      out_.set_single_point(-to_shape, gap, center_ + (x - gap / 2 * to_shape), key);
      finish();
      use(Wall::none);
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
  T height(const typename Wall::Side& side) const { return side.normal.dot(center_) - side.offset; }
  /// Whether a convex set, of which `nearest` is the point nearest to the centre, may be within the
  /// margin: the plane through this point, perpendicular to its direction, separates the set.
  /// @param nearest relative to the centre [m]
  bool is_within(const Vector& nearest) {
    const T distance2 = nearest.squaredNorm(), farthest = core_.size() + margin_;
    if (distance2 > farthest * farthest) return false;
    if (!(distance2 > margin_ * margin_)) return true;
    const T distance = std::sqrt(distance2);
    const Vector d = nearest / distance;
    if (d != last_direction_) {  // above a flat floor it is often the same
      last_direction_ = d;
      last_reach_ = core_.reach(d);
    }
    return distance - last_reach_ <= margin_;
  }
  /// Takes a facet if the shape is in front of it and near it.
  void consider(std::uint32_t k) {
    const auto& side = wall_.side(k);
    if (!(height(side) > 0)) return;
    if (!is_within(nearest_on_facet(typename S::Matrix(side.corners.colwise() - center_)))) return;
    scratch_.facets.emplace_back(side.face, k);
    for (const std::uint32_t r : side.ridge)
      if (r != Wall::none) scratch_.ridges.push_back(r);
    for (const std::uint32_t v : wall_.facet(k))
      if (wall_.is_tip(v)) scratch_.tips.emplace_back(v, k);
  }

  /// The points above one face: above the facets begin .. end - 1 of the list.
  bool touch_face(std::size_t begin, std::size_t end) {
    const std::uint32_t face = scratch_.facets[begin].first;
    const auto& plane = wall_.side(scratch_.facets[begin].second);
    const Vector normal = -plane.normal;  // into the wall
    const T above = height(plane), gap = above - core_.reach(normal);
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
      if (other.normal.dot(x) - other.offset > gap + near_) return false;
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
    const T length2 = along.squaredNorm();
    const T part = std::clamp(-from.dot(along) / length2, T(0), T(1));
    if (!is_within(from + part * along)) return;
    // The points of a contact lie within the margin above the ridge, along the middle of its cone. An
    // edge through such a point has an end there or below.
    const T lowest = -ridge.middle.dot(from) - margin_;
    scratch_.low.clear();
    core_.for_each_above(-ridge.middle, lowest,
                         [&](std::uint32_t v) { scratch_.low.push_back(v); });
    const auto is_low = [&](std::uint32_t v) {
      return -ridge.middle.dot(core_.vertex(v)) >= lowest;
    };
    for (const std::uint32_t v : scratch_.low) {
      core_.for_each_edge_at(v, [&](std::uint32_t e, std::uint32_t other) {
        if (other > v || !is_low(other)) cross_ridge(r, e, v, other, from, along, add);
      });
      touch_ridge(r, v, from, along, length2, add);
    }
  }
  bool is_in_cone(std::uint32_t r, const Vector& d, T tolerance) const {
    const auto& beyond = wall_.ridge(r).beyond;
    return d.dot(beyond[0]) >= tolerance && d.dot(beyond[1]) >= tolerance;
  }
  /// The contact of an edge, from vertex v to vertex w, with a ridge.
  template <class Add>
  void cross_ridge(std::uint32_t r, std::uint32_t e, std::uint32_t v, std::uint32_t w,
                   const Vector& from, const Vector& along, const Add& add) {
    const Vector p = core_.vertex(v), edge = core_.vertex(w) - p;
    const Vector across = edge.cross(along), apart = from - p;
    const T across2 = across.squaredNorm();
    if (!(across2 > T(1e-8) * edge.squaredNorm() * along.squaredNorm())) return;
    const T on_edge = apart.cross(along).dot(across), on_ridge = apart.cross(edge).dot(across);
    if (!(on_edge >= 0 && on_edge <= across2 && on_ridge >= 0 && on_ridge <= across2)) return;
    Vector d = across / std::sqrt(across2);
    if (!is_in_cone(r, d, -aligned)) d = -d;
    const T gap = -d.dot(apart);
    if (!is_in_cone(r, d, -aligned) || !is_near(gap) || !is_lowest(p, d)) return;
    add(d, gap, Vector(p + on_edge / across2 * edge),
        FeatureKey(FeatureKey::Kind::edge_edge, e, r));
  }
  /// The contact of vertex v with a ridge, if it is nearest to the ridge: strictly between the facets,
  /// because above a facet it touches the facet.
  template <class Add>
  void touch_ridge(std::uint32_t r, std::uint32_t v, const Vector& from, const Vector& along,
                   T length2, const Add& add) {
    const Vector x = core_.vertex(v), apart = x - from;
    const T part = apart.dot(along) / length2;
    if (!(part > 0 && part < 1)) return;
    const Vector away = apart - part * along;
    const T gap = away.norm();
    if (!(gap > near_ && gap <= margin_)) return;
    const Vector d = away / gap;
    if (is_in_cone(r, d, aligned) && is_lowest(x, d))
      add(d, gap, x, FeatureKey(FeatureKey::Kind::vertex_edge, v, r));
  }
  template <class Add>
  void touch_tip(std::size_t first, const Add& add) {
    const std::uint32_t v = scratch_.tips[first].first;
    const Vector x = wall_.vertex(v) - center_;
    if (!is_within(x)) return;
    const auto found = core_.distance(x, margin_);
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
  Vector last_direction_ = Vector::Zero();  ///< of is_within()
  T last_reach_ = 0;
};

/// Collides the core of a shape, with the radius around it.
template <class ShapeT, class Wall, class T, class Use>
bool collide_core(const Placed<ShapeT>& a, T radius, const Wall& wall, T margin,
                  const Aabb<SpaceOf<ShapeT>>& box, MeshScratch& scratch,
                  Manifold<SpaceOf<ShapeT>>& out, const Use& use) {
  if constexpr (is_rounded<ShapeT>) {
    return collide_core(a.core(), radius + a.rounding_radius(), wall, margin, box, scratch, out,
                        use);
  } else if constexpr (is_one_of<ShapeT>) {
    return a.visit([&](const auto& held) {
      return collide_core(held, radius, wall, margin, box, scratch, out, use);
    });
  } else {
    T thickness = radius;
    if constexpr (is_ball<ShapeT>) thickness += a.radius();
    MeshCollision<ShapeT> collision(a, thickness, wall, margin, scratch, out);
    collision.find(box);
    const bool faces = collision.touch_faces(use), points = collision.touch_points(use);
    return faces || points;
  }
}

}  // namespace detail

/// Computes the contact points of a convex shape with a mesh wall. Feature keys have the number of a
/// face (MeshWall::Side::face), a ridge or a vertex of the wall as b.
/// @param a      placed in the frame of the wall
/// @param margin largest gap of a contact point [m], >= 0
/// @param out    overwritten for each manifold, in the frame of the wall
/// @param use    called for each manifold: with the number of a face when `out` has the points on this
///               face, with MeshWall::none when it has one point at a ridge or a tip
/// @returns whether there was a contact point
template <class ShapeT, class Use>
requires MeshCollidable<ShapeT>
bool collide_each(const Placed<ShapeT>& a, const MeshWall<SpaceOf<ShapeT>>& wall,
                  typename SpaceOf<ShapeT>::Scalar margin, MeshScratch& scratch,
                  Manifold<SpaceOf<ShapeT>>& out, const Use& use) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  MOREAU_ASSERT(margin >= 0);
  return detail::collide_core(a, T(0), wall, margin, a.bounding_box(), scratch, out, use);
}

}  // namespace moreau
