// SPDX-License-Identifier: MIT
// Pairs with a compound grain. Parts of the two grains collide as convex shapes: each pair of parts
// that touches has a manifold of its own, whose numbers of parts identify it. (The simulation collides
// only parts whose boxes are near: world/detail/pair_caches.hpp.)
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/pairs/collide_cylinder_wall.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/polytope/axis.hpp"
#include "moreau/detect/polytope/face_axes.hpp"
#include "moreau/detect/polytope/make_manifold.hpp"
#include "moreau/detect/polytope/polytope_pair.hpp"
#include "moreau/detect/shape_kinds.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau {

/// A pair of which at least one grain is a compound.
template <class A, class B>
concept CompoundPair = CompoundShape<A> || CompoundShape<B>;

/// Calls use(k, part) for each convex part of a placed grain. A convex grain is its own part 0.
template <class ShapeT, class Use>
void for_each_part(const Placed<ShapeT>& grain, Use&& use) {
  if constexpr (CompoundShape<ShapeT>) {
    for (std::size_t k = 0; k < grain.part_count(); ++k)
      use(static_cast<std::uint32_t>(k), grain.part(k));
  } else {
    use(std::uint32_t{0}, grain);
  }
}

namespace detail {

/// Calls use(v) for the vertices v of a feature of a polygon, a vertex or a face. Its faces are its edges; there is no
/// FeatureKind::edge.
template <std::floating_point T, class Use>
void for_each_vertex(const Polygon<T>& polygon, FeatureKind kind, std::size_t feature, Use&& use) {
  use(feature);
  if (kind == FeatureKind::face) use((feature + 1) % polygon.vertex_count());
}
/// Calls use(v) for the vertices v of a feature of a polyhedron.
template <std::floating_point T, class Use>
void for_each_vertex(const Polyhedron<T>& polyhedron, FeatureKind kind, std::size_t feature,
                     Use&& use) {
  if (kind == FeatureKind::vertex) {
    use(feature);
  } else if (kind == FeatureKind::edge) {
    for (const auto v : polyhedron.edges()[feature].vertex) use(v);
  } else {
    for (const auto v : polyhedron.face(feature)) use(v);
  }
}

/// Whether the parts of a compound have vertices, so that seams between them are known.
template <class ShapeT>
inline constexpr bool has_seams = CompoundShape<ShapeT>&& requires(const Placed<ShapeT>& grain) {
  for_each_vertex(grain.part(0).shape(), FeatureKind::face, 0, [](std::size_t) {});
};

/// Lengths below this share of the size of a part are not seen where it is asked how far parts reach.
inline constexpr double seam_tolerance = 0.05;

/// Whether one of the neighbours of part `part` reaches beyond a point of the part along the direction.
/// If the point lies in this neighbour, the grain continues there, so the point cannot make a contact
/// with this normal.
/// @param others the neighbours that are asked, as in detail::Seams::Set
/// @param point  relative to the centre of the part, world axes [m]
/// @param direction unit, out of the part, world axes
template <CompoundShape ShapeT>
bool reaches_beyond(const Placed<ShapeT>& grain, std::uint32_t part, std::uint64_t others,
                    const typename SpaceOf<ShapeT>::Vector& point,
                    const typename SpaceOf<ShapeT>::Vector& direction) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  for (std::size_t bit = 0; others != 0; ++bit, others >>= 1) {
    if ((others & 1) == 0) continue;
    const auto& other = grain.part(grain.shape().seams().neighbour(part, bit));
    const auto here = (grain.part(part).center() - other.center() + point).eval();
    if (direction.dot(other.support(direction) - here) > T(seam_tolerance) * other.radius())
      return true;
  }
  return false;
}

/// Whether a feature of a part lies in another part of its grain that reaches beyond it along the
/// direction (reaches_beyond()).
template <CompoundShape ShapeT>
bool is_inside(const Placed<ShapeT>& grain, std::uint32_t part, FeatureKind kind,
               std::uint32_t feature, const typename SpaceOf<ShapeT>::Vector& direction) {
  auto others = ~std::uint64_t{0};
  std::uint32_t vertex = 0;
  for_each_vertex(grain.part(part).shape(), kind, feature, [&](std::size_t v) {
    others &= grain.shape().seams().neighbours_at(part, v);
    vertex = std::uint32_t(v);
  });
  return others != 0 &&
         reaches_beyond(grain, part, others, grain.part(part).vertices()[vertex], direction);
}
/// The same for the vertices of a part that are farthest along the direction.
template <CompoundShape ShapeT>
bool is_end_inside(const Placed<ShapeT>& grain, std::uint32_t part,
                   const typename SpaceOf<ShapeT>::Vector& direction) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  const auto& placed = grain.part(part);
  const auto farthest = placed.vertices().farthest(direction);
  auto others = grain.shape().seams().neighbours_at(part, farthest.index);
  if (others == 0) return false;
  // If a face lies nearly across the direction, another of its vertices can touch.
  placed.vertices().for_each_above(
      direction, farthest.value - T(seam_tolerance) * placed.radius(),
      [&](std::size_t v) { others &= grain.shape().seams().neighbours_at(part, v); });
  return others != 0 && reaches_beyond(grain, part, others,
                                       placed.vertices()[std::uint32_t(farthest.index)], direction);
}

/// Whether the normal of a contact of two parts is that of a feature inside one of the grains, or
/// whether the feature that it touches is inside. Without this test a grain that slides over the seam
/// between two parts would bump against the edge or face of the second part. Features are known for
/// pairs of polytopes.
/// @param cache  of the pair of parts, after the collision
/// @param normal unit, from a to b, world axes
template <CompoundShape ShapeT>
bool is_at_seam(const Placed<ShapeT>& a, std::uint32_t part_a, const Placed<ShapeT>& b,
                std::uint32_t part_b, const PairCache<SpaceOf<ShapeT>>& cache,
                const typename SpaceOf<ShapeT>::Vector& normal) {
  if constexpr (has_seams<ShapeT>) {
    const AxisKind kind = cache.kind;
    if (kind == AxisKind::none || kind == AxisKind::nearest_points) return false;
    const typename SpaceOf<ShapeT>::Vector back = -normal;
    return (kind == AxisKind::face_b ? is_end_inside(a, part_a, normal)
                                     : is_inside(a, part_a, feature_of_a(kind), cache.a, normal)) ||
           (kind == AxisKind::face_a ? is_end_inside(b, part_b, back)
                                     : is_inside(b, part_b, feature_of_b(kind), cache.b, back));
  } else {
    return false;
  }
}

/// Collides two parts that overlap along a face that is not inside one of the grains. The axis of two parts can be at a
/// seam although they overlap elsewhere: of a tip in a concave corner whose seam ends in the corner, both parts have a
/// vertex there, and the sides of the tip are the axes of least overlap. Along the faces outside the tip overlaps by more, at most
/// by the reciprocal of the sine of half its angle. Where the parts overlap by much more, other parts of the grains touch
/// there, and such an overlap would be one of the parts, not of the grains.
/// @param out of the collision that is at a seam (is_at_seam()); replaced if the parts are in contact
/// @returns whether they are: not if they do not overlap, or overlap by more than what is not seen of a part, or than the sharpest
///          tip that is seen
template <CompoundShape ShapeT>
[[gnu::cold, gnu::noinline]] bool collide_outside(const Placed<ShapeT>& a, std::uint32_t part_a,
                                                  const Placed<ShapeT>& b, std::uint32_t part_b,
                                                  typename SpaceOf<ShapeT>::Scalar margin,
                                                  Manifold<SpaceOf<ShapeT>>& out) {
  if constexpr (has_seams<ShapeT>) {
    using S = SpaceOf<ShapeT>;
    using T = typename S::Scalar;
    const PolytopePair pair(a.part(part_a), b.part(part_b));
    if (out.gap > pair.rounding()) return false;
    Axis<S> best;
    const T overlap = std::max(-out.gap, T(0)) + pair.rounding();
    best.gap = -std::min(T(seam_tolerance) * std::min(pair.a.radius(), pair.b.radius()),
                         overlap / T(seam_tolerance));
    for_each_face_axis(pair, [&](const Axis<S>& axis) {
      if (!(axis.gap > best.gap)) return;
      PairCache<S> features;
      features.kind = axis.kind;
      features.a = axis.a;
      features.b = axis.b;
      if (!is_at_seam(a, part_a, b, part_b, features, axis.normal)) best = axis;
    });
    if (best.kind == AxisKind::none) return false;
    make_manifold(pair, FoundAxis<S>{best}, margin, out);
    return true;
  } else {
    return false;
  }
}

/// The kind of a's feature of a contact point with a mesh wall.
template <class S>
constexpr FeatureKind feature_on_wall(FeatureKey key) {
  switch (key.kind()) {
    case FeatureKey::Kind::face_vertex:
      return FeatureKind::face;
    case FeatureKey::Kind::edge_edge:
    case FeatureKey::Kind::edge_vertex:
      return S::dim == 2 ? FeatureKind::face : FeatureKind::edge;
    default:
      return FeatureKind::vertex;
  }
}

/// Takes away the points of a contact of a part with a mesh wall that are inside the grain, and says
/// how many. A vertex at a seam is inside, too, where its own part reaches beyond it.
/// @param points of the manifold; their keys have the features of the part as a
/// @param normal unit, out of the part
template <CompoundShape ShapeT>
std::size_t drop_points_at_seams(const Placed<ShapeT>& grain, std::uint32_t part, auto& points,
                                 const typename SpaceOf<ShapeT>::Vector& normal) {
  using T = typename SpaceOf<ShapeT>::Scalar;
  if constexpr (!has_seams<ShapeT>) {
    return 0;
  } else {
    const auto& vertices = grain.part(part).vertices();
    return erase_if(points, [&](const auto& point) {
      const auto kind = feature_on_wall<SpaceOf<ShapeT>>(point.feature);
      const auto feature = std::uint32_t(point.feature.a());
      if (is_inside(grain, part, kind, feature, normal)) return true;
      return kind == FeatureKind::vertex &&
             grain.shape().seams().neighbours_at(part, feature) != 0 &&
             vertices.reach(normal) - normal.dot(vertices[feature]) >
                 T(seam_tolerance) * grain.part(part).radius();
    });
  }
}

}  // namespace detail

/// The contacts of all parts of a pair, without caches.
/// @param margin largest gap of two parts in contact [m], >= 0
/// @param out    overwritten for each pair of parts in contact
/// @param use    called without arguments for each pair of parts in contact, when `out` contains its
///               points, sorted by the parts of a and then of b
/// @returns whether there was one
template <class A, class B, class Use>
bool collide_parts(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
                   Manifold<SpaceOf<A>>& out, Use&& use) {
  bool touch = false;
  for_each_part(a, [&](std::uint32_t i, const auto& part_a) {
    for_each_part(b, [&](std::uint32_t j, const auto& part_b) {
      PairCache<SpaceOf<A>> none;
      if (!collide(part_a, part_b, margin, out, none)) return;
      if constexpr (std::same_as<A, B> && CompoundShape<A>)
        if (detail::is_at_seam(a, i, b, j, none, out.normal) &&
            !detail::collide_outside(a, i, b, j, margin, out))
          return;
      out.part_a = i;
      out.part_b = j;
      touch = true;
      use();
    });
  });
  return touch;
}

/// The contact points of all parts of a compound grain in a cylinder, as for a convex grain.
template <CompoundShape ShapeT, class Use>
bool collide_each(const Placed<ShapeT>& a, const Placed<CylinderWall<SpaceOf<ShapeT>>>& b,
                  typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
                  Use&& use) {
  bool touch = false;
  for_each_part(a, [&](std::uint32_t k, const auto& part) {
    out.part_a = k;
    out.part_b = 0;
    touch |= collide_each(part, b, margin, out, use);
  });
  return touch;
}

/// Signed distance of two grains: that of their nearest parts, or, where they overlap, of the parts
/// that overlap most.
template <class A, class B>
requires CompoundPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                                const Placed<B>& b) {
  SignedDistance<SpaceOf<A>> nearest;
  nearest.gap = std::numeric_limits<typename SpaceOf<A>::Scalar>::infinity();
  for_each_part(a, [&](std::uint32_t, const auto& part_a) {
    for_each_part(b, [&](std::uint32_t, const auto& part_b) {
      const auto found = distance(part_a, part_b);
      if (found.gap < nearest.gap) nearest = found;
    });
  });
  return nearest;
}

/// Whether two grains have a point in common.
template <class A, class B>
requires CompoundPair<A, B>
[[nodiscard]] bool overlap(const Placed<A>& a, const Placed<B>& b) {
  bool found = false;
  for_each_part(a, [&](std::uint32_t, const auto& part_a) {
    for_each_part(
        b, [&](std::uint32_t, const auto& part_b) { found = found || overlap(part_a, part_b); });
  });
  return found;
}

}  // namespace moreau
