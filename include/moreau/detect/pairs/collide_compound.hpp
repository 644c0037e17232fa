// SPDX-License-Identifier: MIT
// Pairs with a compound grain. Parts of the two grains collide as convex shapes: each pair of parts
// that touches has a manifold of its own, whose numbers of parts identify it. (The simulation collides
// only parts whose boxes are near: world/detail/pair_caches.hpp.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/pairs/collide_cylinder_wall.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"

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
bool overlap(const Placed<A>& a, const Placed<B>& b) {
  bool found = false;
  for_each_part(a, [&](std::uint32_t, const auto& part_a) {
    for_each_part(b, [&](std::uint32_t, const auto& part_b) {
      found = found || overlap(part_a, part_b);
    });
  });
  return found;
}

}  // namespace moreau
