// SPDX-License-Identifier: MIT
// The narrow phase: all pairs of shapes, in either order.
//
//   bool           overlap(a, b[, cache])                    whether they have a point in common
//   SignedDistance distance(a, b[, cache])                   gap, normal, nearest points
//   bool           collide(a, b, margin, manifold[, cache])  contact points, if gap <= margin
//
// a and b are Placed shapes. Each unordered pair of elementary shapes has one function, found by
// the types of its arguments, for the shape of lower rank first; the other order is made here.
// Rounded shapes are judged by their cores, those that are one of several kinds by what they are.
//
// A convex shape of one's own works by its support function alone (collide_convex.hpp): with one
// point of contact, but up to seven against a wall. Or it joins in by functions of these names in
// its own namespace.
#pragma once

#include "moreau/detect/convex/collide_convex.hpp"
#include "moreau/detect/pairs/collide_half_space.hpp"
#include "moreau/detect/pairs/collide_one_of.hpp"
#include "moreau/detect/pairs/collide_polygons.hpp"
#include "moreau/detect/pairs/collide_polyhedra.hpp"
#include "moreau/detect/pairs/collide_rounded.hpp"
#include "moreau/detect/pairs/collide_segment_polytope.hpp"
#include "moreau/detect/pairs/collide_segments.hpp"
#include "moreau/detect/pairs/collide_sphere_polytope.hpp"
#include "moreau/detect/pairs/collide_spheres.hpp"
#include "moreau/detect/reduce.hpp"

namespace moreau {

/// Which of two shapes of different kind comes first in the functions that exist.
template <class Shape>
inline constexpr int collide_rank = 2;
template <class S>
inline constexpr int collide_rank<BallIn<S>> = 0;
template <class S>
inline constexpr int collide_rank<Segment<S>> = 1;
template <class S>
inline constexpr int collide_rank<HalfSpace<S>> = 3;

/// A pair of elementary shapes whose functions exist for the other order.
template <class A, class B>
concept ReversedPair = Elementary<A> && Elementary<B> &&(collide_rank<A> > collide_rank<B>);

/// That of (b, a), seen from the other side.
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

/// That of (b, a), seen from the other side.
template <class A, class B>
requires ReversedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                                const Placed<B>& b) {
  SignedDistance<SpaceOf<A>> found = distance(b, a);
  found.normal = -found.normal;
  std::swap(found.witness_a, found.witness_b);
  return found;
}

/// Contact points, without a memory of the pair.
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

/// Signed distance of pairs that have nothing to remember.
template <class A, class B>
SignedDistance<SpaceOf<A>> distance(const Placed<A>& a, const Placed<B>& b,
                                    PairCache<SpaceOf<A>>&) {
  return distance(a, b);
}
/// Whether pairs that have nothing to remember have a point in common.
template <class A, class B>
bool overlap(const Placed<A>& a, const Placed<B>& b, PairCache<SpaceOf<A>>&) {
  return overlap(a, b);
}

}  // namespace moreau
