// SPDX-License-Identifier: MIT
// Internal edges: contacts of a grain with an obstacle or a mesh wall that ends flush beside another one.
//
// Obstacles and walls whose tops lie in one plane, or the flush convex parts of a compound grain, are one surface for
// a grain X that slides over them. But X overlaps the plane by rounding errors and by the overlap that the law admits,
// so that its corner touches the side of the next obstacle B, and would stop there. (Box2D: ghost vertices;
// Jolt Physics and Bullet: internal edges.)
//
// Let C be a body that touches X with the outward normal m, and P the plane of C's surface there. If X lies
// above P, to the depth of this contact, and B below P, to the flush tolerance, then P separates X from B:
// the normal of their contact is m. So a contact of X and B with another normal is replaced by one along
// m, with the same points, if its normal
//
//   - makes more than 45 degrees with m, as that of a side of B, or
//   - is that between two nearest vertices or edges.
//
// If the body of B is a mesh wall, B is the face, ridge or vertex that X touches. The facets of one mesh have no internal edges (mesh_wall.hpp).
//
// Any step that is higher than the tolerance, a side wall, a ramp or a groove reaches above P and is left
// as it is. If P of B separates X from C as well, both contacts stay. Only the geometry of the present step
// decides, so neither the order of bodies nor the past has an influence.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "moreau/contact/contact.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/sort_items.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/shape/concepts.hpp"

namespace moreau::detail {

/// Replaces the contacts at internal edges in the list of a step.
template <class ShapeT>
class InternalEdges {
 public:
  using S = SpaceOf<ShapeT>;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;

  /// @param grains     ascending by body, with their placed shapes
  /// @param meshes     the mesh walls
  /// @param has_walls  whether there is another wall beside a mesh
  /// @param bodies     those whose motion is prescribed are obstacles
  /// @param resolution contact points closer together than this are merged; a fifth of it is the largest
  ///                   height of a step that counts as none [m]
  /// @param margin     largest gap of a contact [m]
  /// @param contacts   in: as detected; out: with contacts replaced or removed
  template <class Grains, class Meshes>
  void replace(const Grains& grains, const Meshes& meshes, bool has_walls, const Bodies<S>& bodies,
               Scalar resolution, Scalar margin, DetectedContacts<S>& contacts) {
    const auto is_obstacle = [&](const auto& grain) {
      return bodies.is_prescribed(grain.body.index());
    };
    const bool has_obstacles = has_walls || std::any_of(grains.begin(), grains.end(), is_obstacle);
    if (!CompoundShape<ShapeT> && !has_obstacles) return;
    const Scalar flush = resolution / 5;
    const Reach<Grains, Meshes> reach{grains, meshes, bodies, contacts};
    find_views(bodies, has_obstacles, contacts);
    gone_.clear();
    found_.clear();
    for (std::size_t begin = 0, end = 0; begin < views_.size(); begin = end) {
      while (end < views_.size() && views_[end].is_beside(views_[begin])) ++end;
      if (end > begin + 1) compare(begin, end, flush, reach, contacts);
    }
    for (const Found& found : found_) apply(found, resolution, margin, contacts);
    if (!gone_.empty()) contacts.erase([&](std::size_t c) { return gone_[c] != 0; });
  }

 private:
  static constexpr std::uint32_t obstacles = 0xffffffff;

  /// A manifold as the body X sees it, which touches another body.
  struct View {
    std::uint32_t x, part;  ///< index of X, and the part that touches
    std::uint32_t
        group;  ///< `obstacles`, or the index of a compound grain: bodies with one number move together
    std::uint32_t first, last;  ///< its points
    bool is_a;                  ///< whether X is body a of the contact
    bool is_beside(const View& other) const {
      return x == other.x && part == other.part && group == other.group;
    }
    friend constexpr auto operator<=>(const View&, const View&) = default;
  };
  /// A contact to replace.
  struct Found {
    View view;
    Vector normal;      ///< m
    Scalar separation;  ///< of X and B along m [m]
  };

  [[gnu::cold, gnu::noinline]] void find_views(const Bodies<S>& bodies, bool has_obstacles,
                                               const DetectedContacts<S>& contacts) {
    views_.clear();
    const auto count = static_cast<std::uint32_t>(contacts.size());
    for (std::uint32_t first = 0, last = 0; first < count; first = last) {
      const ContactKey& key = contacts.keys[first];
      last = static_cast<std::uint32_t>(end_of_pair(contacts, first));
      if (has_obstacles && bodies.is_prescribed(key.a))
        add_views(first, last, false, obstacles, contacts);
      if (has_obstacles && bodies.is_prescribed(key.b))
        add_views(first, last, true, obstacles, contacts);
      if (!CompoundShape<ShapeT> || has_one_manifold(first, last, contacts)) continue;
      add_views(first, last, false, key.a, contacts);
      add_views(first, last, true, key.b, contacts);
    }
    sort_items(views_);
  }
  /// Whether two contact points belong to one manifold.
  static bool are_of_one(std::uint32_t c, std::uint32_t d, const DetectedContacts<S>& contacts) {
    return contacts.keys[c].is_of_parts_of(contacts.keys[d]) &&
           Vector(contacts.points[c].frame.col(0)) == Vector(contacts.points[d].frame.col(0));
  }
  static bool has_one_manifold(std::uint32_t first, std::uint32_t last,
                               const DetectedContacts<S>& contacts) {
    while (first + 1 < last && are_of_one(first, last - 1, contacts)) ++first;
    return first + 1 == last;
  }
  /// Adds the manifolds of a pair.
  [[gnu::cold, gnu::noinline]] void add_views(std::uint32_t first, std::uint32_t last, bool is_a,
                                              std::uint32_t group,
                                              const DetectedContacts<S>& contacts) {
    for (std::uint32_t end = first; first < last; first = end) {
      const ContactKey& key = contacts.keys[first];
      while (end < last && are_of_one(first, end, contacts)) ++end;
      views_.push_back(
          {is_a ? key.a : key.b, is_a ? key.part_a : key.part_b, group, first, end, is_a});
    }
  }

  /// Normal out of the other body, towards X.
  static Vector outward(const View& view, const DetectedContacts<S>& contacts) {
    const Vector normal = contacts.points[view.first].frame.col(0);
    return view.is_a ? Vector(-normal) : normal;
  }
  /// The plane P of a contact, relative to the centre of X.
  struct Surface {
    Vector normal;
    Scalar height;  ///< along the normal [m]
    Scalar gap;     ///< of the contact [m]
  };
  [[gnu::cold, gnu::noinline]] static Surface surface_of(const View& view,
                                                         const DetectedContacts<S>& contacts) {
    Surface surface{outward(view, contacts), 0, 0};
    for (std::uint32_t c = view.first; c < view.last; ++c) {
      const Contact<S>& point = contacts.points[c];
      const Vector& lever = view.is_a ? point.lever_a : point.lever_b;
      const Scalar height = surface.normal.dot(lever) - point.gap / 2;
      surface.height = c == view.first ? height : std::max(surface.height, height);
      surface.gap = c == view.first ? point.gap : std::min(surface.gap, point.gap);
    }
    return surface;
  }
  /// How far the bodies of a contact reach along a unit vector, from their centres [m].
  template <class Grains, class Meshes>
  struct Reach {
    const Grains& grains;
    const Meshes& meshes;
    const Bodies<S>& bodies;
    const DetectedContacts<S>& contacts;

    /// The placed shape of a grain, or null if the body is a wall.
    const Placed<ShapeT>* placed(std::uint32_t body) const {
      const BodyId id = bodies.id[body];
      const auto found =
          std::lower_bound(grains.begin(), grains.end(), id,
                           [](const auto& grain, BodyId other) { return grain.body < other; });
      return found != grains.end() && found->body == id ? &found->placed : nullptr;
    }
    std::uint32_t other(const View& view) const {
      const ContactKey& key = contacts.keys[view.first];
      return view.is_a ? key.b : key.a;
    }
    /// Whether two contacts of X are with facets of one mesh.
    bool are_of_one_mesh(const View& s, const View& t) const {
      return other(s) == other(t) && meshes.has(other(s));
    }
    /// The part of X that touches, or nothing if X is a wall.
    std::optional<Scalar> of_x(const View& view, const Vector& direction) const {
      const auto* x = placed(view.x);
      return x ? std::optional(of_part(*x, view.part, direction)) : std::nullopt;
    }
    /// What X touches of the other body, or nothing if that is a plane or a cylinder.
    std::optional<Scalar> of_other(const View& view, const Vector& direction) const {
      const ContactKey& key = contacts.keys[view.first];
      if (const auto* grain = placed(other(view)))
        return of_part(*grain, view.is_a ? key.part_b : key.part_a, direction);
      return meshes.reach(other(view), view.x, key.feature, direction);
    }
    static Scalar of_part(const Placed<ShapeT>& grain, [[maybe_unused]] std::uint32_t part,
                          const Vector& direction) {
      if constexpr (CompoundShape<ShapeT>)
        return direction.dot(grain.part(part).center() - grain.center()) +
               direction.dot(grain.part(part).support(direction));
      else
        return direction.dot(grain.support(direction));
    }
  };
  /// Height of X above, and of the other body below, along the normal of a surface [m].
  struct Heights {
    Scalar x, other;
  };
  static std::optional<Heights> heights(const View& view, const Vector& normal, const auto& reach,
                                        const DetectedContacts<S>& contacts) {
    const std::optional<Scalar> of_x = reach.of_x(view, -normal);
    const std::optional<Scalar> of_other = reach.of_other(view, normal);
    if (!of_x || !of_other) return std::nullopt;
    const Contact<S>& point = contacts.points[view.first];
    const Vector between =
        view.is_a ? point.lever_a - point.lever_b : point.lever_b - point.lever_a;
    return Heights{-*of_x, normal.dot(between) + *of_other};
  }

  /// Whether a normal can be that of an internal edge: of a side, or between two nearest vertices or edges
  /// of polytopes, not that of a face.
  static bool is_candidate(const View& view, Scalar cosine, const DetectedContacts<S>& contacts) {
    if (cosine < Scalar(0.7)) return true;
    if (cosine > Scalar(1 - 1e-6)) return false;
    const ContactClass found = contacts.classes[view.first];
    if (vertex_on_face(S{}) == FeatureKey::Kind::vertex_edge)  // the faces are the edges
      return found == ContactClass::vertex_vertex;
    return found == ContactClass::vertex_vertex || found == ContactClass::vertex_edge ||
           found == ContactClass::edge_edge;
  }
  /// Whether a surface separates X from the other body, for the heights along its normal.
  static bool separates(const Heights& found, const Surface& surface, Scalar flush) {
    return found.other <= surface.height + flush &&
           found.x >= surface.height + std::min(surface.gap, Scalar(0)) - flush;
  }
  /// Whether the surface of another contact separates X from the other body of this one.
  [[gnu::cold, gnu::noinline]] static bool is_separated(const View& view, const Surface& surface,
                                                        Scalar flush, const auto& reach,
                                                        const DetectedContacts<S>& contacts) {
    const std::optional<Heights> found = heights(view, surface.normal, reach, contacts);
    return found && separates(*found, surface, flush);
  }
  /// The contact to replace if another one's surface separates X from the other body, or nothing.
  /// @param t         index of the view, counted from `begin`
  /// @param begin     the first view of the group
  /// @param kept_only whether surfaces of contacts that are replaced themselves do not count
  [[gnu::cold, gnu::noinline]] std::optional<Found> separating(
      std::size_t t, std::size_t begin, bool kept_only, Scalar flush, const auto& reach,
      const DetectedContacts<S>& contacts) const {
    const View& view = views_[begin + t];
    std::optional<Found> best;
    std::optional<Heights> found;  // along the normal of contact `along`
    std::size_t along = t;
    for (std::size_t s = 0; s < normals_.size(); ++s) {
      if (!is_candidate(view, normals_[t].dot(normals_[s]), contacts)) continue;
      const View& other = views_[begin + s];
      if (s == t || (kept_only && is_replaced_[s]) || reach.are_of_one_mesh(other, view)) continue;
      if (along == t || normals_[s] != normals_[along])
        found = heights(view, normals_[s], reach, contacts);
      along = s;
      if (!found || !separates(*found, surface_of(other, contacts), flush) ||
          is_separated(other, surface_of(view, contacts), flush, reach, contacts))
        continue;
      const Scalar separation = found->x - found->other;
      if (!best || separation > best->separation) best = {view, normals_[s], separation};
    }
    return best;
  }
  /// Finds the contacts to replace among those of one part of X with one group. Where four blocks meet,
  /// the side of a block can separate X from the block diagonal to it, but the contact with this side is
  /// replaced as well: surfaces of contacts that stay have precedence.
  [[gnu::cold, gnu::noinline]] void compare(std::size_t begin, std::size_t end, Scalar flush,
                                            const auto& reach,
                                            const DetectedContacts<S>& contacts) {
    // X can lie on thousands of flush obstacles, or of facets of one mesh: most have nothing to compare.
    bool differs = false, is_one_mesh = reach.are_of_one_mesh(views_[begin], views_[begin]);
    normals_.clear();
    for (std::size_t t = begin; t < end; ++t) {
      normals_.push_back(outward(views_[t], contacts));
      differs = differs || normals_.back() != normals_[0];
      is_one_mesh = is_one_mesh && reach.other(views_[t]) == reach.other(views_[begin]);
    }
    if (!differs || is_one_mesh) return;
    is_replaced_.assign(end - begin, 0);
    const auto find = [&](std::size_t t, bool kept_only) {
      return separating(t, begin, kept_only, flush, reach, contacts);
    };
    for (std::size_t t = 0; t < end - begin; ++t) found_of_.push_back(find(t, false));
    for (std::size_t t = 0; t < end - begin; ++t) is_replaced_[t] = found_of_[t].has_value();
    for (std::size_t t = 0; t < end - begin; ++t) {
      if (!is_replaced_[t]) continue;
      const std::optional<Found> kept = find(t, true);
      found_.push_back(kept ? *kept : *found_of_[t]);
    }
    found_of_.clear();
  }

  /// Gives a contact the normal m; of points that then coincide only the first stays.
  [[gnu::cold, gnu::noinline]] void apply(const Found& found, Scalar near, Scalar margin,
                                          DetectedContacts<S>& contacts) {
    const Vector old = outward(found.view, contacts);
    const Vector normal = found.view.is_a ? Vector(-found.normal) : found.normal;
    const auto frame = S::contact_frame(normal);
    gone_.resize(contacts.size(), 0);
    for (std::uint32_t c = found.view.first; c < found.view.last; ++c) {
      Contact<S>& point = contacts.points[c];
      point.gap = std::max(found.separation, point.gap * old.dot(found.normal));
      point.frame = frame;
      gone_[c] = point.gap > margin;
      for (std::uint32_t k = found.view.first; k < c; ++k)
        if (!gone_[k] && (point.lever_a - contacts.points[k].lever_a).norm() <= near) gone_[c] = 1;
    }
  }

  List<View> views_;
  List<Found> found_;
  // Of the group that is compared:
  List<std::optional<Found>> found_of_;  // one per view
  List<unsigned char> is_replaced_;      // one per view
  List<Vector> normals_;                 // one per view, outward
  List<unsigned char> gone_;             // one per contact
};

}  // namespace moreau::detail
