// SPDX-License-Identifier: MIT
// The narrow phase: three queries for pairs of shapes, in either order; walls that surround a grain have the third only.
//
//   bool           overlap(a, b[, cache])                    whether the shapes have a common point
//   SignedDistance distance(a, b[, cache])                   signed gap, normal, nearest points
//   bool           collide(a, b, margin, manifold[, cache])  contact points, if the gap <= margin
//
// a and b are Placed shapes (placed.hpp). The functions for each kind of pair are in a file of the
// folder pairs/, or in convex/ for shapes of which only the support function is known. They take
// the shape of lower rank (collide_rank) as their first argument. Overload resolution selects the
// function. This file adds functions for the reversed order of arguments and for calls without a
// cache.
//
//   polyhedra, polygons        pairs/collide_polytopes.hpp, polytope/
//   balls, disks               pairs/collide_balls.hpp, pairs/collide_ball_polytope.hpp
//   capsules, rounded shapes   pairs/collide_rounded.hpp, which collides their cores
//   segments                   pairs/collide_segments.hpp, pairs/collide_segment_polytope.hpp
//   half-spaces                pairs/collide_half_space.hpp
//   a Cylinder along its side  pairs/collide_cylinder.hpp
//   inside of a cylinder       pairs/collide_cylinder_wall.hpp, function collide_each()
//   mesh walls                 pairs/collide_mesh_wall.hpp, function collide_each()
//   OneOf                      pairs/collide_one_of.hpp, which collides the shapes that they hold
//   Compound                   pairs/collide_compound.hpp, function collide_parts(): its parts
//   any convex shape           convex/collide_convex.hpp
//
// A convex shape of your own needs only a support function. Its contacts then have a single contact
// point, or up to seven contact points against a half-space. For more, define functions of the
// three names above in the namespace of your shape.
#pragma once

#include "moreau/detect/convex/collide_convex.hpp"
#include "moreau/detect/pairs/collide_ball_polytope.hpp"
#include "moreau/detect/pairs/collide_balls.hpp"
#include "moreau/detect/pairs/collide_compound.hpp"
#include "moreau/detect/pairs/collide_cylinder.hpp"
#include "moreau/detect/pairs/collide_half_space.hpp"
#include "moreau/detect/pairs/collide_one_of.hpp"
#include "moreau/detect/pairs/collide_polytopes.hpp"
#include "moreau/detect/pairs/collide_rounded.hpp"
#include "moreau/detect/pairs/collide_segment_polytope.hpp"
#include "moreau/detect/pairs/collide_segments.hpp"
#include "moreau/detect/reduce.hpp"

namespace moreau {

/// The rank of a shape. For a pair of shapes of different rank, the functions exist only with the
/// shape of lower rank as first argument.
template <class Shape>
inline constexpr int collide_rank = 2;
template <class S>
inline constexpr int collide_rank<BallIn<S>> = 0;
template <class S>
inline constexpr int collide_rank<Segment<S>> = 1;
template <class S>
inline constexpr int collide_rank<HalfSpace<S>> = 3;

/// A pair of elementary shapes of which the first has the higher rank, so that functions exist only
/// for the reversed order.
template <class A, class B>
concept ReversedPair = Elementary<A> && Elementary<B> &&(collide_rank<A> > collide_rank<B>);

/// Contact points of a pair in reversed order.
/// @param margin largest gap of a pair in contact [m], >= 0
/// @param out    filled if the pair is in contact, without meaning otherwise
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

/// Contact points of a pair without a cache from the previous step.
/// @param margin largest gap of a pair in contact [m], >= 0
/// @param out    filled if the pair is in contact, without meaning otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out) {
  PairCache<SpaceOf<A>> none;
  return collide(a, b, margin, out, none);
}

/// Whether the shapes have a point in common: distance(a, b).gap <= 0.
template <class A, class B>
[[nodiscard]] bool overlap(const Placed<A>& a, const Placed<B>& b) {
  return distance(a, b).gap <= 0;
}

/// Signed distance of a pair whose functions make no use of a cache.
template <class A, class B>
SignedDistance<SpaceOf<A>> distance(const Placed<A>& a, const Placed<B>& b,
                                    PairCache<SpaceOf<A>>&) {
  return distance(a, b);
}
/// Whether the shapes have a point in common, for a pair whose functions make no use of a cache.
template <class A, class B>
[[nodiscard]] bool overlap(const Placed<A>& a, const Placed<B>& b, PairCache<SpaceOf<A>>&) {
  return overlap(a, b);
}

}  // namespace moreau
