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
//   2. in space, an edge of the shape and a convex ridge of the wall that cross;
//   3. a vertex of the shape and a convex ridge, if the vertex is nearest to the ridge;
//   4. a tip of the wall (a vertex at which convex ridges end) and the nearest feature of the shape.
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
// ridge is not in the shape, or if ending the overlap of a shallower contact takes the shape off the
// point of the ridge: a block that leans against a step does not jump onto it.
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
#include "moreau/detect/pairs/mesh_core.hpp"
#include "moreau/detect/pairs/mesh_facet_region.hpp"
#include "moreau/detect/pairs/mesh_neighbours.hpp"
#include "moreau/detect/pairs/mesh_scratch.hpp"
#include "moreau/detect/pairs/nearest_on_facet.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"
#include "moreau/detect/tolerance.hpp"
#include "moreau/mesh/mesh_wall.hpp"

namespace moreau {

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
        reference_(center_),
        radius_(radius),
        margin_(margin + radius),
        rounding_((core_.size() + radius) * DetectionTolerance<T>::rounding),
        near_((core_.size() + radius) * DetectionTolerance<T>::coincident),
        scratch_(scratch),
        out_(out) {}

  /// Calls use(face) for each manifold on a face; collects ridges and tips for touch_points().
  /// @param near facets among which are those within the margin, face after face
  template <class Use>
  bool touch_faces(const Aabb<S>& box, std::span<const NearFacet> near, const Use& use) {
    scratch_.ridges.clear();
    scratch_.tips.clear();
    scratch_.known.clear();
    scratch_.passed.clear();
    const Aabb<S> around = box.inflated(margin_ - radius_);
    const T beside = std::max(margin_ - radius_, core_.deepest() / 8);
    const FacetRegion<S> region{wall_, near, around, reference_, core_.size(), near_, beside};
    move_reference(region);
    bool touch = false;
    for (std::size_t begin = 0, end = 0; begin < near.size(); begin = end) {
      while (end < near.size() && near[end].face == near[begin].face) ++end;
      if (!take_face(near.subspan(begin, end - begin), around) || !touch_face(region)) continue;
      finish();
      use(near[begin].face);
      touch = true;
    }
    begin_of_points_ = scratch_.known.size();
    touch_nearest(region);
    return touch;
  }
  /// Calls use(none) for each contact at a ridge or a tip, a manifold of one point.
  template <class Use>
  bool touch_points(const Use& use) {
    sort_short(scratch_.ridges);
    sort_short(scratch_.tips);
    auto& known = scratch_.known;
    const T flatness = wall_.flatness();
    const auto add = [&](const Vector& to_shape, T gap, const Vector& x, FeatureKey key) {
      known.add(Known{x, to_shape, gap, key}, 2 * flatness + 4 * near_ + T(1e-4) * std::abs(gap));
    };
    for (const std::uint32_t r : scratch_.ridges) touch_ridge(S{}, r, add);
    scratch_.pierced.clear();
    touch_tips(aligned, add);
    touch_pierced(add);
    if (radius_ > 0 && known.is_empty()) {
      // High above a corner of faces whose vertices lie near their planes only, normal cones that were
      // computed from these planes can leave a gap.
      T least = std::numeric_limits<T>::infinity();
      const auto find = [&](const Vector&, T gap, const auto&...) { least = std::min(least, gap); };
      touch_tips(uneven, find);
      touch_tips(uneven, [&](const Vector& to_shape, T gap, const auto&... rest) {
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
    for (std::size_t i = begin; i < scratch_.known.size(); ++i) {
      auto contact = scratch_.known.template at<Vector>(i);
      if (contact.gap < -near_) {
        if (!is_deepest(contact)) continue;
        leave_by_face(contact);
      }
      const Vector middle = contact.x - contact.gap / 2 * contact.to_shape;
      out_.set_single_point(-contact.to_shape, contact.gap, center_ + middle, contact.feature);
      finish();
      use(Wall::none);
      touch = true;
    }
    return touch;
  }
  /// Whether a ridge lies in the shape and no shallower contact leads out of the wall there.
  bool is_deepest(const Known& contact) {
    if (contact.feature.kind() != FeatureKey::Kind::edge_edge) return true;
    const auto& ends = wall_.ridge(contact.feature.b()).vertices;
    const auto bounds = [&](const Known& other) { return is_lowest(other.x, other.to_shape); };
    return core_.meets(wall_.vertex(ends.front()) - center_, wall_.vertex(ends.back()) - center_,
                       near_) &&
           !scratch_.known.frees(contact, near_, bounds);
  }
  /// A rim that grazes a face of the shape is not as deep as the face is wide: if the point of a ridge at which an edge
  /// touches it leaves the shape by a shorter way, through a face beside the edge and out of the wall, the contact
  /// is with this face.
  void leave_by_face(Known& contact) const {
    if (contact.feature.kind() != FeatureKey::Kind::edge_edge) return;
    const Known deep = contact;
    const Vector on_wall = deep.on_wall();
    core_.for_each_face([&](auto, const Vector& outward, T offset) {
      const T gap = outward.dot(on_wall) - offset;
      if (outward.dot(deep.x) >= offset - T(4) * near_ || gap <= contact.gap + near_) return;
      if (!is_in_cone(std::uint32_t(deep.feature.b()), -outward, level)) return;
      contact = {on_wall - gap * outward, -outward, gap, deep.feature};
    });
  }
  /// Height of the centre above the plane of a facet [m].
  T height(const typename Wall::Side& side) const { return side.normal.dot(center_) - side.offset; }
  /// Height of the reference point above the plane of a facet [m].
  T reference_height(const typename Wall::Side& side) const {
    return side.normal.dot(reference_) - side.offset;
  }
  /// Moves the reference point in front of a surface with one side, if the centre is behind the surface, less deep
  /// than the inradius: the centre of a thin shape passes the surface where a crest reaches into the shape, and the
  /// rest of the shape is still in front.
  void move_reference(const FacetRegion<S>& region) {
    if (wall_.sides() == WallSides::both) return;
    const T deepest = core_.deepest();
    T least = deepest, highest = 0;  // distance of the nearest facet, height above its plane [m]
    Vector to_facet = Vector::Zero();
    std::uint32_t place = 0;
    for (const NearFacet& facet : region.facets) {
      if (!wall_.box(facet.place).inflated(least + near_).contains(center_)) continue;
      const auto& side = wall_.side(facet.place);
      const Vector nearest = nearest_on_facet(typename S::Matrix(side.corners.colwise() - center_));
      const T distance = nearest.norm(), above = height(side);
      if (distance > least + near_) continue;
      // Of several facets that are nearest, the one that the centre sees under the largest angle counts.
      if (distance >= least - near_ && std::abs(above) <= std::abs(highest)) continue;
      least = std::min(least, distance);
      highest = above;
      to_facet = nearest;
      place = facet.place;
    }
    if (highest < 0 && least > near_ && !region.is_beyond_rim(place, center_))
      reference_ += (1 + deepest / (8 * least)) * to_facet;
  }
  /// Whether a convex set, of which `nearest` is the point nearest to the centre, may be within the
  /// margin: the plane through this point, perpendicular to its direction, separates the set.
  /// @param nearest relative to the centre [m]
  bool is_within(const Vector& nearest) {
    const T distance2 = nearest.squaredNorm(), farthest = core_.size() + margin_;
    if (distance2 > farthest * farthest) return false;
    if (!(distance2 > margin_ * margin_)) return true;
    const T distance = std::sqrt(distance2);
    return distance - reach(nearest / distance) <= margin_;
  }
  /// How far the core reaches along a unit vector. Above a flat floor it is often the same vector.
  T reach(const Vector& d) {
    if (d != last_direction_) {
      last_direction_ = d;
      last_reach_ = core_.reach(d);
    }
    return last_reach_;
  }
  /// Takes the facets of a face if the shape is in front of it and near it.
  bool take_face(std::span<const NearFacet> face, const Aabb<S>& around) {
    scratch_.facets.clear();
    plane_ = nullptr;
    for (const NearFacet& facet : face) {
      if (!wall_.box(facet.place).overlaps(around)) continue;
      if (!plane_) {
        plane_ = &wall_.side(facet.place);
        above_ = height(*plane_);
        if (!(reference_height(*plane_) > 0)) return false;
        gap_ = above_ - reach(-plane_->normal);
        if (gap_ > margin_) return false;
      }
      // Of a large face most facets have no other feature: touch_face() finds out which are near.
      if ((facet.is_plain && face.size() > 1) || take_features(facet.place))
        scratch_.facets.push_back(facet);
    }
    return !scratch_.facets.empty();
  }
  /// Takes ridges and tips of a facet that may be within the margin.
  bool take_features(std::uint32_t k) {
    const auto& side = wall_.side(k);
    if (!is_within(nearest_on_facet(typename S::Matrix(side.corners.colwise() - center_))))
      return false;
    for (const std::uint32_t r : side.ridge)
      if (r != Wall::none) scratch_.ridges.push_back(r);
    for (const std::uint32_t v : wall_.facet(k))
      if (wall_.is_tip(v)) scratch_.tips.emplace_back(v, k);
    return true;
  }

  /// The points above the facets of the list, which are of one face.
  bool touch_face(const FacetRegion<S>& region) {
    const std::uint32_t face = scratch_.facets[0].face;
    const Vector normal = -plane_->normal;  // into the wall
    out_.start(normal, gap_);
    // A shape that passes below the plane of the face stands beside it.
    const T highest = gap_ < -margin_ ? T(0) : margin_, off = wall_.flatness() + T(1e3) * near_;
    core_.for_each_above(normal, above_ - highest - rounding_, [&](std::uint32_t v) {
      const Vector x = core_.vertex(v);
      const T gap_v = above_ - normal.dot(x);
      if (gap_v < -near_ && passes(region, center_ + x, gap_v)) scratch_.passed.push_back(v);
      if (gap_v < -core_.deepest()) return;
      const Vector projected = center_ + (x + gap_v * normal);
      for (const NearFacet& facet : scratch_.facets) {
        const T around = facet.has_concave ? off + region.beside : off;
        if (!wall_.box(facet.place).inflated(around).contains(projected)) continue;
        if (!region.holds(facet, center_ + x, gap_v)) continue;
        out_.points.push_back({center_ + (x + T(0.5) * gap_v * normal), gap_v,
                               FeatureKey(vertex_on_face(S{}), v, face)});
        scratch_.known.add_new(Known{x, -normal, gap_v, FeatureKey()});
        return;
      }
    });
    if (out_.points.empty()) return false;
    out_.contact_class = class_at_plane(S{}, out_.points.size());
    return true;
  }

  /// Whether the way from the reference point to a vertex at x passes a facet of the list.
  bool passes(const FacetRegion<S>& region, const Vector& x, T gap) const {
    const T above = reference_height(*plane_);
    const Vector at_plane = reference_ + above / (above - gap) * (x - reference_);
    for (const NearFacet& facet : scratch_.facets)
      if (wall_.box(facet.place).inflated(near_).contains(at_plane) &&
          region.passes(facet.place, x))
        return true;
    return false;
  }
  /// The contacts of vertices that are behind the surface and that no facet has.
  void touch_nearest(const FacetRegion<S>& region) {
    sort_short(scratch_.passed);
    for (const std::uint32_t v : scratch_.passed) {
      const Vector x = core_.vertex(v);
      if (scratch_.known.has(x, begin_of_points_)) continue;
      region.touches_nearest(center_ + x, [&](std::uint32_t f, T gap) {
        const auto& side = wall_.side(f);
        scratch_.known.add(
            Known{x, side.normal, gap, FeatureKey(vertex_on_face(S{}), v, side.face)}, near_);
      });
    }
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
    const auto add_low = [&](std::uint32_t v) { scratch_.low.push_back(v); };
    core_.for_each_above(-ridge.middle, lowest, add_low);
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
  bool is_in_cone(std::uint32_t r, const Vector& d, T tolerance = aligned) const {
    const auto& beyond = wall_.ridge(r).beyond;
    return d.dot(beyond[0]) >= -tolerance && d.dot(beyond[1]) >= -tolerance;
  }
  /// The contact of an edge, from vertex v to w, with a ridge.
  template <class Add>
  void cross_ridge(std::uint32_t r, std::uint32_t e, std::uint32_t v, std::uint32_t w,
                   const Vector& from, const Vector& along, const Add& add) {
    const Vector p = core_.vertex(v), edge = core_.vertex(w) - p;
    const Vector across = edge.cross(along), apart = from - p;
    const T across2 = across.squaredNorm();
    if (!(across2 > T(1e-8) * edge.squaredNorm() * along.squaredNorm())) return;
    const T on_edge = apart.cross(along).dot(across), on_ridge = apart.cross(edge).dot(across);
    if (!(on_edge >= 0 && on_edge <= across2 && on_ridge >= 0 && on_ridge <= across2)) return;
    // At a rim two opposite directions can lie in the normal cone.
    for (const T length : {std::sqrt(across2), -std::sqrt(across2)}) {
      const Vector d = across / length;
      if (is_in_cone(r, d) && is_near(-d.dot(apart)) && is_low(p, -d.dot(apart), d))
        return add(d, -d.dot(apart), Vector(p + on_edge / across2 * edge),
                   FeatureKey(FeatureKey::Kind::edge_edge, e, r));
    }
  }
  /// The contact of vertex v with a ridge, if it is nearest to the ridge.
  template <class Add>
  void touch_ridge(std::uint32_t r, std::uint32_t v, const Vector& from, const Vector& along,
                   T length2, const Add& add) {
    const Vector x = core_.vertex(v), apart = x - from;
    const T exact = apart.dot(along) / length2, part = std::clamp(exact, T(0), T(1));
    const Vector away = apart - part * along;
    const T gap = away.norm(), off = (exact - part) * (exact - part) * length2;
    if (!(gap > near_ && gap <= margin_ && off <= bent * bent * gap * gap)) return;
    const Vector d = away / gap;
    if (is_in_cone(r, d) && is_lowest(x, d))
      add(d, gap, x, FeatureKey(FeatureKey::Kind::vertex_edge, v, r));
  }
  /// @param tolerance sine of the largest angle outside of the normal cone of a tip [-]
  template <class Add>
  void touch_tips(T tolerance, const Add& add) {
    const auto& tips = scratch_.tips;
    for (std::size_t k = 0; k < tips.size(); ++k)
      if (k == 0 || tips[k].first != tips[k - 1].first) touch_tip(k, tolerance, add);
  }
  template <class Add>
  void touch_tip(std::size_t first, T tolerance, const Add& add) {
    const std::uint32_t v = scratch_.tips[first].first;
    const Vector x = wall_.vertex(v) - center_;
    if (!is_within(x)) return;
    const auto found = core_.distance(x, margin_);
    if (!is_near(found.distance)) return;
    const Vector d = -found.outward;
    if (wall_.is_top(v, d, tolerance) && is_outside(first, d))
      return add(d, found.distance, Vector(x - found.distance * found.outward),
                 FeatureKey(found.feature.kind(), found.feature.a(), v));
    if (found.distance < -core_.deepest() / 8) scratch_.pierced.push_back(first);
  }
  /// Whether a direction at a tip leads out of one of its facets that are near the shape.
  bool is_outside(std::size_t first, const Vector& d) const {
    const std::uint32_t v = scratch_.tips[first].first;
    bool is = false;
    for (std::size_t k = first; k < scratch_.tips.size() && scratch_.tips[k].first == v; ++k)
      is = is || d.dot(wall_.side(scratch_.tips[k].second).normal) >= -aligned ||
           wall_.has_rim_at(scratch_.tips[k].second, v);
    return is;
  }
  /// The contacts of tips deep in the shape, if the normal of the nearest face of the shape is not in the normal
  /// cone of the tip: a crest is beyond the middle of a thin shape, or higher than its neighbours along this
  /// normal. The nearest face counts whose normal is in the cone, otherwise the nearest one that leads out of the
  /// facets at the tip.
  template <class Add>
  void touch_pierced(const Add& add) {
    const auto bounds = [&](const Known& other) { return is_lowest(other.x, other.to_shape); };
    for (const std::size_t first : scratch_.pierced) {
      const std::uint32_t v = scratch_.tips[first].first;
      const Vector x = wall_.vertex(v) - center_;
      int best = 0;
      Known contact{x, x, -std::numeric_limits<T>::infinity(), FeatureKey()};
      core_.for_each_face([&](std::uint32_t f, const Vector& outward, T offset) {
        const T gap = outward.dot(x) - offset;
        const int rank = rank_of(first, -outward);
        if (rank < std::max(best, 1) || (rank == best && !(gap > contact.gap))) return;
        best = rank;
        contact = {x - gap * outward, -outward, gap,
                   FeatureKey(vertex_on_face(S{}), v, f).swapped()};
      });
      if (best > 0 && !scratch_.known.frees(contact, near_, bounds))
        add(contact.to_shape, contact.gap, contact.x, contact.feature);
    }
  }
  /// 2 if a direction is in the normal cone of a tip; 1 if it leads out of all facets at the tip that are near the
  /// shape, or of a surface with two sides out of the facet above which the centre is highest; otherwise 0.
  int rank_of(std::size_t first, const Vector& d) const {
    const std::uint32_t v = scratch_.tips[first].first;
    if (wall_.is_top(v, d, aligned) && is_outside(first, d)) return 2;
    T least = 1, highest = 0, of_highest = 0;  // cosines, and a height [m]
    for (std::size_t k = first; k < scratch_.tips.size() && scratch_.tips[k].first == v; ++k) {
      const auto& side = wall_.side(scratch_.tips[k].second);
      const T cosine = d.dot(side.normal), above = reference_height(side);
      least = std::min(least, cosine);
      if (above > highest) highest = above, of_highest = cosine;
    }
    return (wall_.sides() == WallSides::both ? of_highest : least) >= T(0.5) ? 1 : 0;
  }
  bool is_near(T gap) const { return gap <= margin_ && gap >= -core_.deepest(); }
  /// Whether a contact point x of the shape with a ridge counts: where a face comes down on the ridge, each end
  /// of the line of contact is a point while the gap is small, and not only the lower one, as on a face of the
  /// wall. The shape may reach below the plane through the ridge by 1 % of its width, and by more if x is its
  /// lowest point.
  bool is_low(const Vector& x, T gap, const Vector& d) const {
    return core_.reach(-d) <= -d.dot(x) + std::max(near_, gap - radius_ + core_.deepest() / 50);
  }
  /// Whether no point of the shape lies below x along d.
  bool is_lowest(const Vector& x, const Vector& d) const {
    return core_.reach(-d) <= -d.dot(x) + near_;
  }
  /// Moves points to midway between the surfaces.
  void finish() {
    out_.gap -= radius_;
    for (auto& point : out_.points) {
      point.gap -= radius_;
      point.position += radius_ / 2 * out_.normal;
    }
  }

  static constexpr T aligned = T(1e-6);  ///< sine of the largest angle outside of a normal cone [-]
  static constexpr T level = T(0.1);     ///< the same of a face that a ridge grazes [-]
  static constexpr T bent = T(2e-5);     ///< the same of two ridges without a tip between them [-]
  static constexpr T uneven = T(1e-2);   ///< the same at a corner of uneven faces [-]
  const MeshCore<ShapeT> core_;
  const Wall& wall_;
  const Vector center_;
  Vector reference_;  // says on which side of a facet the shape is
  const T radius_, margin_, rounding_, near_;
  MeshScratch& scratch_;
  Manifold<S>& out_;
  Vector last_direction_ = Vector::Zero();
  T last_reach_ = 0;
  std::size_t begin_of_points_ = 0;  // of the known contacts, after those in manifolds of faces
  // Of take_face().
  const typename Wall::Side* plane_ = nullptr;
  T above_ = 0, gap_ = 0;  // of the centre above the plane, of the shape [m]
};

/// Collides the core of a shape, with the radius around it.
template <class ShapeT, class Wall, class T, class Use>
bool collide_core(const Placed<ShapeT>& a, T radius, const Wall& wall, T margin,
                  const Aabb<SpaceOf<ShapeT>>& box, const MeshNeighbours<SpaceOf<ShapeT>>* near,
                  MeshScratch& scratch, Manifold<SpaceOf<ShapeT>>& out, const Use& use) {
  if constexpr (is_rounded<ShapeT>) {
    return collide_core(a.core(), radius + a.rounding_radius(), wall, margin, box, near, scratch,
                        out, use);
  } else if constexpr (is_one_of<ShapeT>) {
    return a.visit([&](const auto& held) {
      return collide_core(held, radius, wall, margin, box, near, scratch, out, use);
    });
  } else {
    T thickness = radius;
    if constexpr (is_ball<ShapeT>) thickness += a.radius();
    MeshCollision<ShapeT> collision(a, thickness, wall, margin, scratch, out);
    std::span<const NearFacet> facets;
    if (near) {
      facets = near->facets();
    } else {
      find_facets(wall, box.inflated(margin), scratch.all);
      facets = scratch.all;
    }
    const bool faces = collision.touch_faces(box, facets, use);
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
  return detail::collide_core(a, T(0), wall, margin, a.bounding_box(), nullptr, scratch, out, use);
}
/// The same, among facets that are known.
/// @param near updated for a box that contains that of the shape, inflated by the margin
template <class ShapeT, class Use>
requires MeshCollidable<ShapeT>
bool collide_each(const Placed<ShapeT>& a, const MeshWall<SpaceOf<ShapeT>>& wall,
                  typename SpaceOf<ShapeT>::Scalar margin,
                  const MeshNeighbours<SpaceOf<ShapeT>>& near, MeshScratch& scratch,
                  Manifold<SpaceOf<ShapeT>>& out, const Use& use) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  MOREAU_ASSERT(margin >= 0);
  return detail::collide_core(a, T(0), wall, margin, a.bounding_box(), &near, scratch, out, use);
}

}  // namespace moreau
