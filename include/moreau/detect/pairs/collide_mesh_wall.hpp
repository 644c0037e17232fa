// SPDX-License-Identifier: MIT
// A convex shape against a mesh wall, in the frame of the wall.
//
// Only the outside of the wall counts: a facet takes part if the centre of the shape lies in front of
// its plane, or would lie there if it were moved out of the wall by less than the inradius. The contact
// points are those at which the features of the two surfaces can touch first:
//
//   1. a vertex of the shape above a facet, or below it by a small depth. The normal is that of the
//      facet. All points on one face of the wall (facets in one plane that are connected) make one
//      manifold, as on a half-space. For concave ridges and rims see mesh_facet_region.hpp;
//   2. in space, an edge of the shape and a convex ridge of the wall that cross (ridge_contacts.hpp). In a pass, where
//      two ridges rise from one vertex, an edge that overlaps both touches both, also a little beyond their common end;
//   3. a vertex of the shape and a convex ridge, if the vertex is nearest to the ridge (ridge_contacts.hpp);
//   4. a tip of the wall (a vertex at which convex ridges end) and the nearest feature of the shape (tip_contacts.hpp).
//
// A vertex that is behind the surface and that no face has touches the nearest facet, alone. A tip in the shape
// touches the nearest face whose normal is possible at the tip, and not the far side of a thin shape.
//
// A normal of 2, 3 and 4 must lie between the normals of the facets that join there: in the normal
// cone of the ridge or the tip. The shape must lie on one side of the plane through the point, so that
// the normal lies in its normal cone as well, or nearly so for 2. Therefore no flat and no concave ridge gives a contact,
// and of several facets that join only one gives it. Where two
// normal cones meet, each of them takes what rounding errors might push out of it, and a contact that
// is known is left out: those of faces come first, those of tips last.
//
// If the shape overlaps the wall, several edges can cross a ridge. A contact of 2 is left out if the
// ridge is not in the shape, or if ending the overlap of a shallower contact takes the shape off the whole
// ridge: a block that leans against a step does not jump onto it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pairs/collide_half_space.hpp"
#include "moreau/detect/pairs/mesh_collidable.hpp"
#include "moreau/detect/pairs/mesh_facet_region.hpp"
#include "moreau/detect/pairs/mesh_neighbours.hpp"
#include "moreau/detect/pairs/mesh_pair.hpp"
#include "moreau/detect/pairs/mesh_scratch.hpp"
#include "moreau/detect/pairs/nearest_on_facet.hpp"
#include "moreau/detect/pairs/ridge_contacts.hpp"
#include "moreau/detect/pairs/tip_contacts.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"
#include "moreau/mesh/mesh_wall.hpp"

namespace moreau {

namespace detail {

/// The contacts with the faces of a mesh wall, and the order in which those of all features are taken.
template <class ShapeT>
class MeshCollision {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Wall = MeshWall<S>;

  /// @param radius  of the rounding around the core [m]
  /// @param margin  how far the facets that decide are from the shape [m]
  /// @param largest gap of a contact, <= margin [m]
  MeshCollision(const Placed<ShapeT>& a, T radius, const Wall& wall, T margin, T largest,
                MeshScratch& scratch, Manifold<S>& out)
      : pair_(a, radius, wall, margin, largest, scratch), out_(out) {}

  /// Calls use(face) for each manifold on a face; collects ridges and tips for touch_points().
  /// @param near facets whose boxes overlap that of the shape, inflated by the margin; face after face
  template <class Use>
  bool touch_faces(const Aabb<S>& box, std::span<const NearFacet> near, const Use& use) {
    pair_.scratch.ridges.clear();
    pair_.scratch.tips.clear();
    pair_.scratch.known.clear();
    pair_.scratch.passed.clear();
    facets_ = near;
    const FacetRegion<S> region{pair_.wall,        near,       pair_.reference,
                                pair_.core.size(), pair_.near, pair_.beside};
    move_reference(region);
    bool touch = false;
    const Aabb<S> within = box.inflated(pair_.largest - pair_.radius);
    for (std::size_t begin = 0, end = 0; begin < near.size(); begin = end) {
      while (end < near.size() && near[end].face == near[begin].face) ++end;
      if (!take_face(near.subspan(begin, end - begin), within) || !touch_face(region)) continue;
      finish();
      use(near[begin].face);
      touch = true;
    }
    begin_of_points_ = pair_.scratch.known.size();
    touch_nearest(region);
    return touch;
  }
  /// Calls use(none) for each contact at a ridge or a tip, a manifold of one point.
  template <class Use>
  bool touch_points(const Use& use) {
    sort_short(pair_.scratch.ridges);
    sort_short(pair_.scratch.tips);
    auto& known = pair_.scratch.known;
    const T flatness = pair_.wall.flatness();
    const auto add = [&](const Vector& to_shape, T gap, const Vector& x, FeatureKey key) {
      known.add(Known{x, to_shape, gap, key},
                2 * flatness + 4 * pair_.near + T(1e-4) * std::abs(gap));
    };
    for (const std::uint32_t r : pair_.scratch.ridges) ridges_.touch(S{}, r, add);
    pair_.scratch.pierced.clear();
    pair_.scratch.pricked.clear();
    tips_.touch(MeshPair<ShapeT>::aligned, add);
    tips_.touch_pierced(pair_.scratch.pierced, add);
    // A tip a little below the surface of the shape, whose vertices are on the other side of a rim: none touches a face.
    if (!known.has_below(-double(pair_.near))) tips_.touch_pierced(pair_.scratch.pricked, add);
    if (pair_.radius > 0 && known.is_empty()) {
      // High above a corner of faces whose vertices lie near their planes only, normal cones that were
      // computed from these planes can leave a gap.
      T least = std::numeric_limits<T>::infinity();
      const auto find = [&](const Vector&, T gap, const auto&...) { least = std::min(least, gap); };
      tips_.touch(uneven, find);
      tips_.touch(uneven, [&](const Vector& to_shape, T gap, const auto&... rest) {
        if (gap == least && known.is_empty()) add(to_shape, gap, rest...);
      });
    }
    return use_points(begin_of_points_, use);
  }

 private:
  using Known = KnownContacts::Contact<Vector>;

  /// Calls use(none) for the contacts at ridges and tips, from number `begin` on.
  template <class Use>
  bool use_points(std::size_t begin, const Use& use) {
    bool touch = false;
    for (std::size_t i = begin; i < pair_.scratch.known.size(); ++i) {
      auto contact = pair_.scratch.known.template at<Vector>(i);
      if (contact.gap < -pair_.near) {
        if (!ridges_.is_deepest(contact) || !passes_surface(contact)) continue;
        ridges_.leave_by_face(contact);
      }
      const Vector middle = contact.x - contact.gap / 2 * contact.to_shape;
      out_.set_single_point(-contact.to_shape, contact.gap, pair_.center + middle, contact.feature);
      finish();
      use(Wall::none);
      touch = true;
    }
    return touch;
  }
  /// Whether a segment, the core of a capsule, passes through a facet, if the contact is one of the segment with a ridge.
  /// Otherwise the segment lies behind the ridge without an overlap: beyond a rim, or within a thin wall. Shapes with
  /// an inside are not asked.
  bool passes_surface(const Known& contact) const {
    if constexpr (MeshCore<ShapeT>::has_inside) {
      return true;
    } else {
      if (contact.feature.kind() != FeatureKey::Kind::edge_edge) return true;
      const Vector from = pair_.center + pair_.core.vertex(0),
                   to = pair_.center + pair_.core.vertex(1);
      return std::any_of(facets_.begin(), facets_.end(), [&](const NearFacet& facet) {
        return goes_through(pair_.wall, facet.place, from, to, pair_.near) ||
               goes_through(pair_.wall, facet.place, to, from, pair_.near);
      });
    }
  }
  /// Moves the reference point in front of a surface with one side, if the centre is behind the surface, less deep
  /// than the inradius: the centre of a thin shape passes the surface where a crest reaches into the shape, and the
  /// rest of the shape is still in front.
  void move_reference(const FacetRegion<S>& region) {
    if (pair_.wall.sides() == WallSides::both) return;
    const T deepest = pair_.core.deepest();
    T least = deepest, highest = 0;  // distance of the nearest facet, height above its plane [m]
    Vector to_facet = Vector::Zero();
    std::uint32_t place = 0;
    const Vector most = Vector::Constant(deepest + pair_.near);
    const Aabb<S> nearby{pair_.center - most, pair_.center + most};
    const auto counts = [&](const NearFacet& facet) {
      return pair_.wall.box(facet.place).overlaps(nearby);
    };
    // Most centres are in front of all facets near them.
    if (std::none_of(region.facets.begin(), region.facets.end(), [&](const NearFacet& facet) {
          return counts(facet) && pair_.height(pair_.wall.side(facet.place)) < 0;
        }))
      return;
    for (const NearFacet& facet : region.facets) {
      if (!counts(facet)) continue;
      const auto& side = pair_.wall.side(facet.place);
      const Vector nearest =
          nearest_on_facet(typename S::Matrix(side.corners.colwise() - pair_.center));
      const T distance = nearest.norm(), above = pair_.height(side);
      if (distance > least + pair_.near) continue;
      // If several facets are nearest, the one with the largest height of the centre above its plane counts.
      if (distance >= least - pair_.near && std::abs(above) <= std::abs(highest)) continue;
      least = std::min(least, distance);
      highest = above;
      to_facet = nearest;
      place = facet.place;
    }
    if (highest < 0 && least > pair_.near && !region.is_beyond_rim(place, pair_.center))
      pair_.reference += (1 + deepest / (8 * least)) * to_facet;
  }
  /// Takes the facets of a face if the shape is in front of it and near it.
  /// @param within the box of the shape, inflated by the largest gap. A facet beside a concave ridge can have vertices
  ///               that are as far beyond the ridge as the margin
  bool take_face(std::span<const NearFacet> face, const Aabb<S>& within) {
    pair_.scratch.facets.clear();
    plane_ = nullptr;
    const bool is_less = pair_.largest < pair_.margin;  // otherwise all boxes overlap that box
    for (const NearFacet& facet : face) {
      if (is_less && !facet.has_concave && !pair_.wall.box(facet.place).overlaps(within)) continue;
      if (!plane_) {
        plane_ = &pair_.wall.side(facet.place);
        above_ = pair_.height(*plane_);
        if (!(pair_.reference_height(*plane_) > 0)) return false;
        gap_ = above_ - pair_.reach(-plane_->normal);
        if (gap_ > pair_.largest) return false;
      }
      // Most facets of a large face have no other feature: touch_face() finds out which are near.
      if ((facet.is_plain && face.size() > 1) || take_features(facet))
        pair_.scratch.facets.push_back(facet);
    }
    return !pair_.scratch.facets.empty();
  }
  /// Takes ridges and tips of a facet that may be near enough.
  bool take_features(const NearFacet& facet) {
    const std::uint32_t k = facet.place;
    const auto& side = pair_.wall.side(k);
    if (!pair_.is_within(
            nearest_on_facet(typename S::Matrix(side.corners.colwise() - pair_.center)),
            facet.has_concave ? pair_.margin : pair_.largest))
      return false;
    for (const std::uint32_t r : side.ridge)
      if (r != Wall::none) pair_.scratch.ridges.push_back(r);
    for (const std::uint32_t v : pair_.wall.facet(k))
      if (pair_.wall.is_tip(v)) pair_.scratch.tips.emplace_back(v, k);
    return true;
  }

  /// The points above the facets of the list, which are of one face.
  bool touch_face(const FacetRegion<S>& region) {
    const std::uint32_t face = pair_.scratch.facets[0].face;
    const Vector normal = -plane_->normal;  // into the wall
    out_.start(normal, gap_);
    // A shape that passes below the plane of the face stands beside it.
    const T highest = gap_ < -pair_.margin ? T(0) : pair_.largest,
            off = pair_.wall.flatness() + T(1e3) * pair_.near;
    pair_.core.for_each_above(normal, above_ - highest - pair_.rounding, [&](std::uint32_t v) {
      const Vector x = pair_.core.vertex(v);
      const T gap_v = above_ - normal.dot(x);
      if (gap_v < -pair_.near && passes(region, pair_.center + x, gap_v))
        pair_.scratch.passed.push_back(v);
      if (gap_v < -pair_.core.deepest()) return;
      const Vector projected = pair_.center + (x + gap_v * normal);
      for (const NearFacet& facet : pair_.scratch.facets) {
        const T around = facet.has_concave ? off + region.beside : off;
        if (!pair_.wall.box(facet.place).inflated(around).contains(projected)) continue;
        if (!region.holds(facet, pair_.center + x, gap_v)) continue;
        out_.points.push_back({pair_.center + (x + T(0.5) * gap_v * normal), gap_v,
                               FeatureKey(vertex_on_face(S{}), v, face)});
        pair_.scratch.known.add_new(Known{x, -normal, gap_v, FeatureKey()});
        return;
      }
    });
    if (out_.points.empty()) return false;
    out_.contact_class = class_at_plane(S{}, out_.points.size());
    return true;
  }

  /// Whether the way from the reference point to a vertex at x passes a facet of the list.
  bool passes(const FacetRegion<S>& region, const Vector& x, T gap) const {
    const T above = pair_.reference_height(*plane_);
    const Vector at_plane = pair_.reference + above / (above - gap) * (x - pair_.reference);
    for (const NearFacet& facet : pair_.scratch.facets)
      if (pair_.wall.box(facet.place).inflated(pair_.near).contains(at_plane) &&
          region.passes(facet.place, x))
        return true;
    return false;
  }
  /// The contacts of vertices that are behind the surface and that no facet has.
  void touch_nearest(const FacetRegion<S>& region) {
    sort_short(pair_.scratch.passed);
    for (const std::uint32_t v : pair_.scratch.passed) {
      const Vector x = pair_.core.vertex(v);
      if (pair_.scratch.known.has(x, begin_of_points_) || is_held_far(region, pair_.center + x))
        continue;
      region.touches_nearest(pair_.center + x, [&](std::uint32_t f, T gap) {
        const auto& side = pair_.wall.side(f);
        pair_.scratch.known.add(
            Known{x, side.normal, gap, FeatureKey(vertex_on_face(S{}), v, side.face)}, pair_.near);
      });
    }
  }

  /// Whether a vertex touches a facet with a gap within the margin and above the largest one.
  bool is_held_far(const FacetRegion<S>& region, const Vector& x) const {
    if (!(pair_.largest < pair_.margin)) return false;
    const T off = pair_.wall.flatness() + T(1e3) * pair_.near;
    return std::any_of(region.facets.begin(), region.facets.end(), [&](const NearFacet& facet) {
      const Aabb<S>& box = pair_.wall.box(facet.place);
      const auto& side = pair_.wall.side(facet.place);
      const T gap = side.normal.dot(x) - side.offset;
      if (!(gap > pair_.largest && gap <= pair_.margin) || !(pair_.reference_height(side) > 0) ||
          pair_.height(side) - pair_.core.reach(-side.normal) < -pair_.margin)
        return false;
      const T around = facet.has_concave ? off + region.beside : off;
      return box.inflated(around).contains(x - gap * side.normal) && region.holds(facet, x, gap);
    });
  }

  /// Moves points to midway between the surfaces.
  void finish() {
    out_.gap -= pair_.radius;
    for (auto& point : out_.points) {
      point.gap -= pair_.radius;
      point.position += pair_.radius / 2 * out_.normal;
    }
  }

  /// Sine of the largest angle outside of a normal cone, at a corner of uneven faces [-].
  static constexpr T uneven = T(1e-2);
  MeshPair<ShapeT> pair_;
  RidgeContacts<ShapeT> ridges_{pair_};
  TipContacts<ShapeT> tips_{pair_};
  Manifold<S>& out_;
  std::span<const NearFacet> facets_;  // whose boxes are within the margin
  std::size_t begin_of_points_ = 0;    // of the known contacts, after those in manifolds of faces
  // Of take_face().
  const typename Wall::Side* plane_ = nullptr;
  T above_ = 0, gap_ = 0;  // of the centre above the plane, of the shape [m]
};

/// Collides the core of a shape, with the radius around it.
template <class ShapeT, class Wall, class T, class Use>
bool collide_core(const Placed<ShapeT>& a, T radius, const Wall& wall, T margin, T largest,
                  const Aabb<SpaceOf<ShapeT>>& box, const MeshNeighbours<SpaceOf<ShapeT>>* near,
                  MeshScratch& scratch, Manifold<SpaceOf<ShapeT>>& out, const Use& use) {
  if constexpr (is_rounded<ShapeT>) {
    return collide_core(a.core(), radius + a.rounding_radius(), wall, margin, largest, box, near,
                        scratch, out, use);
  } else if constexpr (is_one_of<ShapeT>) {
    return a.visit([&](const auto& held) {
      return collide_core(held, radius, wall, margin, largest, box, near, scratch, out, use);
    });
  } else {
    T thickness = radius;
    if constexpr (is_ball<ShapeT>) thickness += a.radius();
    MeshCollision<ShapeT> collision(a, thickness, wall, margin, largest, scratch, out);
    const Aabb<SpaceOf<ShapeT>> around = box.inflated(margin);
    if (near)
      select_facets(wall, around, near->facets(), scratch.all);
    else
      find_facets(wall, around, scratch.all);
    const bool faces = collision.touch_faces(box, scratch.all, use);
    const bool points = collision.touch_points(use);
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
  return detail::collide_core(a, T(0), wall, margin, margin, a.bounding_box(), nullptr, scratch,
                              out, use);
}
/// The same, among facets that are known, and only contact points that are nearer than the margin.
/// @param largest gap of a contact point, <= margin [m]. Points with a smaller gap do not depend on it
/// @param near updated for a box that contains that of the shape, inflated by the margin
template <class ShapeT, class Use>
requires MeshCollidable<ShapeT>
bool collide_each(const Placed<ShapeT>& a, const MeshWall<SpaceOf<ShapeT>>& wall,
                  typename SpaceOf<ShapeT>::Scalar margin, typename SpaceOf<ShapeT>::Scalar largest,
                  const MeshNeighbours<SpaceOf<ShapeT>>& near, MeshScratch& scratch,
                  Manifold<SpaceOf<ShapeT>>& out, const Use& use) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  MOREAU_ASSERT(largest >= 0 && margin >= largest);
  return detail::collide_core(a, T(0), wall, margin, largest, a.bounding_box(), &near, scratch, out,
                              use);
}

}  // namespace moreau
