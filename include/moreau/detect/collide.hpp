// SPDX-License-Identifier: MIT
// The narrow phase: three queries for any pair of shapes, in either order.
//
//   bool           overlap(a, b[, cache])                    whether they have a point in common
//   SignedDistance distance(a, b[, cache])                   gap, normal, nearest points
//   bool           collide(a, b, margin, manifold[, cache])  contact points, if gap <= margin
//
// a and b are Placed shapes (placed.hpp). Each kind of pair has a file in pairs/, or convex/ for
// shapes known by their support function alone, with the functions for the shape of lower rank
// first; overload resolution selects them. This file adds the reversed order and the forms without
// a cache.
//
//   polyhedra, polygons        pairs/collide_polytopes.hpp, polytope/
//   balls, disks               pairs/collide_spheres.hpp, pairs/collide_sphere_polytope.hpp
//   capsules, rounded shapes   by their cores: pairs/collide_rounded.hpp
//   segments                   pairs/collide_segments.hpp, pairs/collide_segment_polytope.hpp
//   half-spaces                pairs/collide_half_space.hpp
//   inside of a cylinder       pairs/collide_cylinder_wall.hpp, collide_each()
//   OneOf                      by the shapes that they hold: pairs/collide_one_of.hpp
//   any convex shape           convex/collide_convex.hpp
//
// Your own convex shape needs a support function only. It gets one contact point, and up to seven
// against a half-space. Or it brings functions of these names in its own namespace.
#pragma once

#include "moreau/detect/convex/collide_convex.hpp"
#include "moreau/detect/pairs/collide_half_space.hpp"
#include "moreau/detect/pairs/collide_one_of.hpp"
#include "moreau/detect/pairs/collide_polytopes.hpp"
#include "moreau/detect/pairs/collide_rounded.hpp"
#include "moreau/detect/pairs/collide_segment_polytope.hpp"
#include "moreau/detect/pairs/collide_segments.hpp"
#include "moreau/detect/pairs/collide_sphere_polytope.hpp"
#include "moreau/detect/pairs/collide_spheres.hpp"
#include "moreau/detect/reduce.hpp"

namespace moreau {

/// The rank of a shape: of two shapes of different rank, the functions exist for the lower one
/// first.
template <class Shape>
inline constexpr int collide_rank = 2;
template <class S>
inline constexpr int collide_rank<BallIn<S>> = 0;
template <class S>
inline constexpr int collide_rank<Segment<S>> = 1;
template <class S>
inline constexpr int collide_rank<HalfSpace<S>> = 3;

/// A pair of elementary shapes whose functions exist for the reversed order.
template <class A, class B>
concept ReversedPair = Elementary<A> && Elementary<B> &&(collide_rank<A> > collide_rank<B>);

/// Contact points of a pair in reversed order.
/// @param margin pairs up to this gap are in contact [m], >= 0
/// @param out    filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
requires ReversedPair<A, B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out, PairCache<SpaceOf<A>>& cache) {
  cache.axis = -cache.axis;
  const bool touch = collide(b, a, margin, out, cache);
  cache.axis = -cache.axis;
  if (touch) out.swap_sides();
  return touch;
}

/// Signed distance of a pair in reversed order.
template <class A, class B>
requires ReversedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                                const Placed<B>& b) {
  SignedDistance<SpaceOf<A>> found = distance(b, a);
  found.normal = -found.normal;
  std::swap(found.witness_a, found.witness_b);
  return found;
}

/// Contact points without a memory of the pair.
/// @param margin pairs up to this gap are in contact [m], >= 0
/// @param out    filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out) {
  PairCache<SpaceOf<A>> none;
  return collide(a, b, margin, out, none);
}

/// Whether the shapes have a point in common: distance(a, b).gap <= 0.
template <class A, class B>
bool overlap(const Placed<A>& a, const Placed<B>& b) {
  return distance(a, b).gap <= 0;
}

/// Signed distance of pairs whose functions use no memory.
template <class A, class B>
SignedDistance<SpaceOf<A>> distance(const Placed<A>& a, const Placed<B>& b,
                                    PairCache<SpaceOf<A>>&) {
  return distance(a, b);
}
/// Whether the shapes have a point in common, for pairs whose functions use no memory.
template <class A, class B>
bool overlap(const Placed<A>& a, const Placed<B>& b, PairCache<SpaceOf<A>>&) {
  return overlap(a, b);
}

}  // namespace moreau
