// SPDX-License-Identifier: MIT
// Polyhedron against polyhedron, polygon against polygon. The way of a pair:
//   1. find_axis.hpp or prove_axis.hpp   the separating axis, its features and the signed gap
//   2. facing_features.hpp               the two faces or edges that look at each other
//   3. contact_polygon.hpp               where these overlap, with the gap at each corner
//   4. make_manifold.hpp                 the contact points
// all in polytope/.
#pragma once

#include <cmath>
#include <limits>

#include "moreau/detect/convex/gjk.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/polytope/find_axis.hpp"
#include "moreau/detect/polytope/make_manifold.hpp"
#include "moreau/detect/polytope/prove_axis.hpp"

namespace moreau {

namespace detail {

/// The axis of a pair: proved from the remembered features, or found by search and then remembered.
/// A proved gap that equals the margin to rounding does not count, so that the answer does not
/// depend on the memory.
/// @param margin  a gap larger than this need not be known exactly [m]
template <class ShapeT>
FoundAxis<SpaceOf<ShapeT>> axis_of(const PolytopePair<ShapeT>& pair,
                                   typename SpaceOf<ShapeT>::Scalar margin,
                                   PairCache<SpaceOf<ShapeT>>& cache) {
  const auto proved = prove_axis(pair, cache);
  if (proved && std::abs(proved->gap - margin) > pair.rounding())
    return {*proved, proved->gap > margin};
  const auto found = find_axis(pair, margin);
  cache.axis = found.axis.normal;
  cache.kind = found.is_beyond ? AxisKind::none : found.axis.kind;
  cache.a = found.axis.a;
  cache.b = found.axis.b;
  return found;
}

/// Whether GJK alone tells that two polyhedra overlap or are apart; undecided where rounding has a
/// say, so that the features must be searched for the answer to be that of the other queries.
template <std::floating_point T>
Proximity quick_proximity(const PolytopePair<Polyhedron<T>>& pair) {
  using Vector = typename Space<3, T>::Vector;
  Vector axis = pair.start();
  Simplex<T> simplex(pair.support(axis));
  const auto proximity = gjk<T>([&](const Vector& n) { return pair.support(n); }, simplex, axis,
                                pair.rounding(), pair.size, all_steps);
  if (proximity == Proximity::beyond) return proximity;
  return simplex.holds_origin(pair.size * DetectionTolerance<T>::certain) ? Proximity::touching
                                                                          : Proximity::undecided;
}
/// For polygons the search is as quick.
template <std::floating_point T>
Proximity quick_proximity(const PolytopePair<Polygon<T>>&) {
  return Proximity::undecided;
}

}  // namespace detail

/// All points of the contact of two polytopes of one kind; reduce() keeps a few of them.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class ShapeT>
requires Polytope<ShapeT>
bool collide(const Placed<ShapeT>& a, const Placed<ShapeT>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>& cache) {
  MOREAU_ASSERT(margin >= 0);
  const detail::PolytopePair<ShapeT> pair(a, b);
  if (pair.is_clearly_apart(margin, cache)) return false;
  const auto found = detail::axis_of(pair, margin, cache);
  if (found.is_beyond) return false;
  detail::make_manifold(pair, found, margin, out);
  return true;
}

/// Signed distance of two polytopes, exact to rounding, with the memory of the pair.
template <class ShapeT>
requires Polytope<ShapeT> SignedDistance<SpaceOf<ShapeT>> distance(
    const Placed<ShapeT>& a, const Placed<ShapeT>& b, PairCache<SpaceOf<ShapeT>>& cache) {
  using S = SpaceOf<ShapeT>;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const detail::PolytopePair<ShapeT> pair(a, b);
  const auto found = detail::axis_of(pair, std::numeric_limits<T>::infinity(), cache);
  const auto& axis = found.axis;
  const Vector middle = detail::middle_of_contact(pair, found);
  const Vector half = T(0.5) * axis.gap * axis.normal;
  return {axis.gap, axis.normal, a.center() + (middle - half), a.center() + (middle + half)};
}

/// Signed distance of two polytopes, without a memory of the pair.
template <class ShapeT>
requires Polytope<ShapeT> SignedDistance<SpaceOf<ShapeT>> distance(const Placed<ShapeT>& a,
                                                                   const Placed<ShapeT>& b) {
  PairCache<SpaceOf<ShapeT>> none;
  return distance(a, b, none);
}

/// Whether two polytopes have a point in common, with the memory of the pair: the features are
/// found along with the answer, so that they can be remembered.
template <class ShapeT>
requires Polytope<ShapeT>
bool overlap(const Placed<ShapeT>& a, const Placed<ShapeT>& b, PairCache<SpaceOf<ShapeT>>& cache) {
  const detail::PolytopePair<ShapeT> pair(a, b);
  return !pair.is_clearly_apart(0, cache) && !detail::axis_of(pair, 0, cache).is_beyond;
}

/// Whether two polytopes have a point in common, without a memory of the pair.
template <class ShapeT>
requires Polytope<ShapeT>
bool overlap(const Placed<ShapeT>& a, const Placed<ShapeT>& b) {
  PairCache<SpaceOf<ShapeT>> none;
  const detail::PolytopePair<ShapeT> pair(a, b);
  if (pair.is_clearly_apart(0, none)) return false;
  const auto proximity = detail::quick_proximity(pair);
  if (proximity != detail::Proximity::undecided) return proximity == detail::Proximity::touching;
  return !detail::axis_of(pair, 0, none).is_beyond;
}

}  // namespace moreau
