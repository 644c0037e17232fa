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
    const Vector from = pair_.wall.vertex(ridge.vertices[0]) - pair_.center;
    const Vector along = pair_.wall.vertex(ridge.vertices[1]) - pair_.center - from;
    const T length2 = along.squaredNorm();
    const T part = std::clamp(-from.dot(along) / length2, T(0), T(1));
    if (!pair_.is_within(from + part * along, pair_.largest)) return;
    // The points of a contact lie within the largest gap above the ridge, along the middle of its cone. An
    // edge through such a point has an end there or below.
    const T lowest = -ridge.middle.dot(from) - pair_.largest;
    pair_.scratch.low.clear();
    const auto add_low = [&](std::uint32_t v) { pair_.scratch.low.push_back(v); };
    pair_.core.for_each_above(-ridge.middle, lowest, add_low);
    const auto is_below = [&](std::uint32_t v) {
      return -ridge.middle.dot(pair_.core.vertex(v)) >= lowest;
    };
    for (const std::uint32_t v : pair_.scratch.low) {
      pair_.core.for_each_edge_at(v, [&](std::uint32_t e, std::uint32_t other) {
        if (other > v || !is_below(other)) cross(r, e, v, other, from, along, add);
      });
      touch_vertex(r, v, from, along, length2, add);
    }
  }
  /// Whether a ridge lies in the shape and no shallower contact leads out of the wall there.
  bool is_deepest(const Known& contact) {
    if (contact.feature.kind() != FeatureKey::Kind::edge_edge) return true;
    const auto& ends = pair_.wall.ridge(contact.feature.b()).vertices;
    const auto bounds = [&](const Known& other) {
      return pair_.is_lowest(other.x, other.to_shape);
    };
    return pair_.core.meets(pair_.wall.vertex(ends.front()) - pair_.center,
                            pair_.wall.vertex(ends.back()) - pair_.center, pair_.near) &&
           !pair_.scratch.known.frees(contact, pair_.near, bounds);
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
  /// Whether a direction lies between the normals of the two facets of a ridge, to a tolerance [-].
  bool is_in_cone(std::uint32_t r, const Vector& d, T tolerance = MeshPair<ShapeT>::aligned) const {
    const auto& beyond = pair_.wall.ridge(r).beyond;
    return d.dot(beyond[0]) >= -tolerance && d.dot(beyond[1]) >= -tolerance;
  }
  /// The contact of an edge, from vertex v to w, with a ridge.
  template <class Add>
  void cross(std::uint32_t r, std::uint32_t e, std::uint32_t v, std::uint32_t w, const Vector& from,
             const Vector& along, const Add& add) {
    const Vector p = pair_.core.vertex(v), edge = pair_.core.vertex(w) - p;
    const Vector across = edge.cross(along), apart = from - p;
    const T across2 = across.squaredNorm();
    if (!(across2 > T(1e-8) * edge.squaredNorm() * along.squaredNorm())) return;
    const T on_edge = apart.cross(along).dot(across), on_ridge = apart.cross(edge).dot(across);
    if (!(on_edge >= 0 && on_edge <= across2 && on_ridge >= 0 && on_ridge <= across2)) return;
    // At a rim two opposite directions can lie in the normal cone. A capsule is on the side of its segment.
    T first = std::sqrt(across2);
    if (!MeshCore<ShapeT>::has_inside && across.dot(apart) > 0) first = -first;
    for (const T length : {first, -first}) {
      const Vector d = across / length;
      if (is_in_cone(r, d) && pair_.is_near(-d.dot(apart)) && pair_.is_low(p, -d.dot(apart), d))
        return add(d, -d.dot(apart), Vector(p + on_edge / across2 * edge),
                   FeatureKey(FeatureKey::Kind::edge_edge, e, r));
    }
  }
  /// The contact of vertex v with a ridge, if it is nearest to the ridge.
  template <class Add>
  void touch_vertex(std::uint32_t r, std::uint32_t v, const Vector& from, const Vector& along,
                    T length2, const Add& add) {
    const Vector x = pair_.core.vertex(v), apart = x - from;
    const T exact = apart.dot(along) / length2, part = std::clamp(exact, T(0), T(1));
    const Vector away = apart - part * along;
    const T gap = away.norm(), off = (exact - part) * (exact - part) * length2;
    if (!(gap > pair_.near && gap <= pair_.largest && off <= bent * bent * gap * gap)) return;
    const Vector d = away / gap;
    if (is_in_cone(r, d) && pair_.is_lowest(x, d))
      add(d, gap, x, FeatureKey(FeatureKey::Kind::vertex_edge, v, r));
  }

  // Sines of the largest angle outside of a normal cone [-]:
  static constexpr T level = T(0.1);  // of a face that a ridge grazes
  static constexpr T bent = T(2e-5);  // of two ridges without a tip between them
  MeshPair<ShapeT>& pair_;
};

}  // namespace moreau::detail
