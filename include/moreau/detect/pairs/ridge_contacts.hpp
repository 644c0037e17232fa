// SPDX-License-Identifier: MIT
// Contacts of a convex shape with the convex ridges of a mesh wall, in space: an edge that crosses a ridge, and a
// vertex that is nearest to one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "moreau/core/space.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pairs/mesh_pair.hpp"
#include "moreau/detect/pairs/mesh_scratch.hpp"

namespace moreau::detail {

/// Contacts with ridges.
template <class ShapeT>
class RidgeContacts {
 public:
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  using Known = KnownContacts::Contact<Vector>;

  explicit RidgeContacts(MeshPair<ShapeT>& pair) : pair_(pair) {}

  /// In the plane a ridge is a tip.
  template <class Add>
  void touch(Space<2, T>, std::uint32_t, const Add&) {}
  /// Calls add(to_shape, gap, x, key) for the contacts of edges and vertices with ridge r.
  template <class Add>
  void touch(Space<3, T>, std::uint32_t r, const Add& add) {
    const auto& ridge = pair_.wall.ridge(r);
    Line line{r, pair_.wall.vertex(ridge.vertices[0]) - pair_.center, {}, 0, 0};
    line.along = pair_.wall.vertex(ridge.vertices[1]) - pair_.center - line.from;
    line.length2 = line.along.squaredNorm();
    line.beyond = pair_.beside / std::sqrt(line.length2);
    const T part = std::clamp(-line.from.dot(line.along) / line.length2, T(0), T(1));
    if (!pair_.is_within(line.from + part * line.along, pair_.largest)) return;
    // The points of a contact lie within the largest gap above the ridge, along the middle of its cone. An
    // edge through such a point has an end there or below.
    const T lowest = -ridge.middle.dot(line.from) - pair_.largest;
    pair_.scratch.low.clear();
    std::uint64_t low = 0;  // bit v: whether vertex v < 64 is in the list
    pair_.core.for_each_above(-ridge.middle, lowest, [&](std::uint32_t v) {
      pair_.scratch.low.push_back(v);
      if (v < 64) low |= std::uint64_t{1} << v;
    });
    const auto is_below = [&](std::uint32_t v) {
      return v < 64 ? (low >> v & 1) != 0 : -ridge.middle.dot(pair_.core.vertex(v)) >= lowest;
    };
    for (const std::uint32_t v : pair_.scratch.low) {
      pair_.core.for_each_edge_at(v, [&](std::uint32_t e, std::uint32_t other) {
        if (other > v || !is_below(other)) cross(line, e, v, other, add);
      });
      touch_vertex(line, v, add);
    }
  }
  /// Whether a ridge lies in the shape, and no motion that ends the overlap of a shallower contact takes all of the ridge
  /// off the shape.
  bool is_deepest(const Known& contact) {
    if (contact.feature.kind() != FeatureKey::Kind::edge_edge) return true;
    const auto& ends = pair_.wall.ridge(contact.feature.b()).vertices;
    const Vector from = pair_.wall.vertex(ends.front()) - pair_.center,
                 to = pair_.wall.vertex(ends.back()) - pair_.center;
    if (!pair_.core.meets(from, to, pair_.near)) return false;
    const Vector on_wall = contact.on_wall();
    return !pair_.scratch.known.frees(contact, pair_.near, [&](const Known& other) {
      if (!MeshCore<ShapeT>::has_inside) return pair_.leads_off(other, on_wall);
      const Vector way = -std::min(other.gap, T(0)) * other.to_shape;
      return other.gap <= pair_.near && pair_.is_lowest(other.x, other.to_shape) &&
             !pair_.core.meets(from - way, to - way, -pair_.near);
    });
  }
  /// A rim that grazes a face of the shape is not as deep as the face is wide: if the point of a ridge at which an edge
  /// touches it leaves the shape by a shorter way, through a face beside the edge and out of the wall, the contact
  /// is with this face.
  void leave_by_face(Known& contact) const {
    if (contact.feature.kind() != FeatureKey::Kind::edge_edge) return;
    const Known deep = contact;
    const Vector on_wall = deep.on_wall();
    pair_.core.for_each_face([&](auto, const Vector& outward, T offset) {
      const T gap = outward.dot(on_wall) - offset;
      if (outward.dot(deep.x) >= offset - T(4) * pair_.near || gap <= contact.gap + pair_.near)
        return;
      if (!is_in_cone(std::uint32_t(deep.feature.b()), -outward, level)) return;
      contact = {on_wall - gap * outward, -outward, gap, deep.feature};
    });
  }

 private:
  /// A ridge, relative to the centre of the shape.
  struct Line {
    std::uint32_t ridge;
    Vector from, along;  ///< begin, vector to the end [m]
    T length2;           ///< of `along`, squared [m^2]
    T beyond;            ///< how far beyond an end an overlap counts, in lengths of the ridge [-]
  };
  /// Whether a direction lies in the normal cone of ridge r: between the normals of its two facets; at a rim, on the side away from the
  /// facet. See ConvexRidge::beyond.
  /// @param d         contact normal towards the grain, unit, axes of MeshPair::wall
  /// @param tolerance sine of the largest angle outside of the cone [-]
  bool is_in_cone(std::uint32_t r, const Vector& d, T tolerance = MeshPair<ShapeT>::aligned) const {
    const auto& beyond = pair_.wall.ridge(r).beyond;
    return d.dot(beyond[0]) >= -tolerance && d.dot(beyond[1]) >= -tolerance;
  }
  /// Whether an edge that lies below the end of a ridge, which is in the shape, lies between two ridges that rise from
  /// this end, as in a pass of a crest: along the edge they are seen as a valley. It touches both, as at two
  /// half-spaces, also a little beyond their common end. Along an edge that lies in a valley, the other slope is nearly a face: its ridge can be at
  /// the other end of the valley.
  /// @param end 0 or 1: of the ridge
  /// @param d   normal of the contact with the ridge
  bool is_in_pass(std::uint32_t r, bool end, const Vector& edge, const Vector& d) const {
    const auto& wall = pair_.wall;
    const std::uint32_t v = wall.ridge(r).vertices[end];
    const Vector tip = wall.vertex(v) - pair_.center,
                 along = wall.vertex(wall.ridge(r).vertices[!end]) - wall.vertex(v);
    if (!pair_.core.meets(tip, tip, pair_.near)) return false;
    const auto is_other_slope = [&](std::uint32_t q) {
      const auto& ends = wall.ridge(q).vertices;
      if (q == r || (ends.front() != v && ends.back() != v)) return false;
      const Vector rise = wall.vertex(ends[ends.front() == v]) - wall.vertex(v);
      Vector normal = edge.cross(rise).normalized();
      if (normal.dot(along) < 0) normal = -normal;
      return normal.dot(along) > 0 && d.dot(rise) > 0 && is_in_cone(q, normal, level);
    };
    return std::any_of(pair_.scratch.ridges.begin(), pair_.scratch.ridges.end(), is_other_slope);
  }
  /// The contact of an edge, from vertex v to w, with a ridge.
  template <class Add>
  void cross(const Line& line, std::uint32_t e, std::uint32_t v, std::uint32_t w, const Add& add) {
    const std::uint32_t r = line.ridge;
    const Vector p = pair_.core.vertex(v), edge = pair_.core.vertex(w) - p;
    const Vector across = edge.cross(line.along), apart = line.from - p;
    const T across2 = across.squaredNorm();
    if (!(across2 > T(1e-8) * edge.squaredNorm() * line.length2)) return;
    const T on_edge = apart.cross(line.along).dot(across), on_ridge = apart.cross(edge).dot(across);
    if (!(on_edge >= 0 && on_edge <= across2)) return;
    const T past = std::max(-on_ridge, on_ridge - across2);  // the end of the ridge, if > 0
    if (past > line.beyond * across2) return;
    // At a rim two opposite directions can lie in the normal cone. A capsule is on the side of its segment.
    T first = std::sqrt(across2);
    if (!MeshCore<ShapeT>::has_inside && across.dot(apart) > 0) first = -first;
    for (const T length : {first, -first}) {
      const Vector d = across / length;
      if (is_in_cone(r, d) && pair_.is_near(-d.dot(apart)) && pair_.is_low(p, -d.dot(apart), d) &&
          (!(past > 0) || (d.dot(apart) > 0 && is_in_pass(r, on_ridge > 0, edge, d))))
        return add(d, -d.dot(apart), Vector(p + on_edge / across2 * edge),
                   FeatureKey(FeatureKey::Kind::edge_edge, e, r));
    }
  }
  /// The contact of vertex v with a ridge, if it is nearest to the ridge.
  template <class Add>
  void touch_vertex(const Line& line, std::uint32_t v, const Add& add) {
    const Vector x = pair_.core.vertex(v), apart = x - line.from;
    const T exact = apart.dot(line.along) / line.length2, part = std::clamp(exact, T(0), T(1));
    const Vector away = apart - part * line.along;
    const T gap = away.norm(), off = (exact - part) * (exact - part) * line.length2;
    if (!(gap > pair_.near && gap <= pair_.largest && off <= bent * bent * gap * gap)) return;
    const Vector d = away / gap;
    if (is_in_cone(line.ridge, d) && pair_.is_lowest(x, d))
      add(d, gap, x, FeatureKey(FeatureKey::Kind::vertex_edge, v, line.ridge));
  }

  // Sines of the largest angle outside of a normal cone [-]:
  static constexpr T level = T(0.1);  // of a face that a ridge grazes, of the other slope of a pass
  static constexpr T bent = T(2e-5);  // of two ridges without a tip between them
  MeshPair<ShapeT>& pair_;
};

}  // namespace moreau::detail
