// SPDX-License-Identifier: MIT
// Polyhedron against polyhedron, polygon against polygon. The steps, each in a file of polytope/:
//   1. prove_axis.hpp, prove_faces.hpp or find_axis.hpp
//                                        the separating axis, its features and the signed gap
//   2. facing_features.hpp               the two faces, or edges in the plane, that face each other
//   3. contact_polygon.hpp               the overlap of these faces, with the gap at each corner
//   4. make_manifold.hpp                 the contact points
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "moreau/detect/convex/gjk.hpp"
#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/polytope/find_axis.hpp"
#include "moreau/detect/polytope/make_manifold.hpp"
#include "moreau/detect/polytope/prove_axis.hpp"
#include "moreau/detect/polytope/prove_faces.hpp"

namespace moreau {

namespace detail {

/// The separating axis of a pair by search. Its features are stored in the cache.
/// @param margin  the gap need not be exact if it is larger than this [m]
template <class ShapeT>
FoundAxis<SpaceOf<ShapeT>> search_axis(const PolytopePair<ShapeT>& pair,
                                       typename SpaceOf<ShapeT>::Scalar margin,
                                       PairCache<SpaceOf<ShapeT>>& cache) {
  const auto found = find_axis(pair, margin);
  cache.axis = found.axis.normal;
  cache.kind = found.is_beyond ? AxisKind::none : found.axis.kind;
  cache.a = found.axis.a;
  cache.b = found.axis.b;
  return found;
}
/// The separating axis of a pair. If the features in the cache are proved, the axis is computed
/// from them. Otherwise the axis is searched. If the
/// proved gap equals the margin to rounding, the axis is searched too, so that the result does not
/// depend on the cache.
/// @param margin  the gap need not be exact if it is larger than this [m]
template <class ShapeT>
FoundAxis<SpaceOf<ShapeT>> axis_of(const PolytopePair<ShapeT>& pair,
                                   typename SpaceOf<ShapeT>::Scalar margin,
                                   PairCache<SpaceOf<ShapeT>>& cache) {
  const auto proved = prove_axis(pair, cache);
  if (proved && std::abs(proved->gap - margin) > pair.rounding())
    return {*proved, proved->gap > margin};
  return search_axis(pair, margin, cache);
}

/// How far the contact of two faces that lie on each other is known from the features in the cache.
enum class RememberedFaces : std::uint8_t {
  none,   ///< there are no such faces
  made,   ///< the manifold is made, but the features are not proved
  proved  ///< the manifold is made and right
};
/// Makes the contact of two faces that lie on each other from the features in the cache (prove_faces.hpp).
template <std::floating_point T>
RememberedFaces collide_remembered_faces(const PolytopePair<Polyhedron<T>>& pair,
                                         const RememberedAxis<Space<3, T>>& remembered, T margin,
                                         Manifold<Space<3, T>>& out) {
  if (!(remembered.axis.gap < margin - pair.rounding()) ||
      !faces_may_lie_on_each_other(pair, remembered.axis))
    return RememberedFaces::none;
  bool proved = false;
  make_manifold(pair, {remembered.axis}, margin, out,
                [&](const auto& polygon, const FacingFeatures& facing, T deepest) {
                  proved = prove_faces(pair, remembered, facing, polygon, deepest);
                });
  return proved ? RememberedFaces::proved : RememberedFaces::made;
}
/// For polygons, never: the search is as fast.
template <std::floating_point T>
RememberedFaces collide_remembered_faces(const PolytopePair<Polygon<T>>&,
                                         const RememberedAxis<Space<2, T>>&, T,
                                         Manifold<Space<2, T>>&) {
  return RememberedFaces::none;
}
/// Fills the manifold of a pair, if it is in contact.
/// @returns whether it is
template <class ShapeT>
bool collide_axis(const PolytopePair<ShapeT>& pair, const FoundAxis<SpaceOf<ShapeT>>& found,
                  typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out) {
  if (!found.is_beyond) make_manifold(pair, found, margin, out);
  return !found.is_beyond;
}

/// Tests with GJK alone whether two polyhedra overlap or are apart. The result is `undecided` if it
/// depends on rounding. The features must then be searched, so that overlap() agrees with collide()
/// and distance().
template <std::floating_point T>
Proximity quick_proximity(const PolytopePair<Polyhedron<T>>& pair) {
  using Vector = typename Space<3, T>::Vector;
  Vector axis = pair.start();
  const auto first = pair.support(axis);
  // GJK does not test its first direction.
  if (const T s = axis.dot(first.point);
      s > T(0) && s * s > pair.rounding() * pair.rounding() * axis.squaredNorm())
    return Proximity::beyond;
  Simplex<T> simplex(first, pair.size);
  const auto proximity = gjk<T>([&](const Vector& n) { return pair.support(n); }, simplex, axis,
                                pair.rounding(), pair.size, all_steps);
  if (proximity == Proximity::beyond) return proximity;
  return simplex.holds_origin(pair.size * DetectionTolerance<T>::certain) ? Proximity::touching
                                                                          : Proximity::undecided;
}
/// For polygons, always undecided, because the search is as fast as GJK.
template <std::floating_point T>
Proximity quick_proximity(const PolytopePair<Polygon<T>>&) {
  return Proximity::undecided;
}

}  // namespace detail

/// All contact points of two polytopes of the same kind. reduce() selects a few of them.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, without meaning otherwise
/// @returns whether the signed gap is at most the margin
template <class ShapeT>
requires Polytope<ShapeT>
bool collide(const Placed<ShapeT>& a, const Placed<ShapeT>& b,
             typename SpaceOf<ShapeT>::Scalar margin, Manifold<SpaceOf<ShapeT>>& out,
             PairCache<SpaceOf<ShapeT>>& cache) {
  MOREAU_ASSERT(margin >= 0);
  const detail::PolytopePair<ShapeT> pair(a, b);
  if (pair.is_clearly_apart(margin, cache)) return false;
  const auto remembered = detail::remember_axis(pair, cache);
  if (!remembered)
    return detail::collide_axis(pair, detail::axis_of(pair, margin, cache), margin, out);
  const auto& axis = remembered->axis;
  auto faces = detail::RememberedFaces::none;
  if (std::abs(axis.gap - margin) > pair.rounding()) {
    if (detail::is_proved(pair, *remembered))
      return detail::collide_axis(pair, {axis, axis.gap > margin}, margin, out);
    faces = detail::collide_remembered_faces(pair, *remembered, margin, out);
    if (faces == detail::RememberedFaces::proved) return true;
  }
  const auto found = detail::search_axis(pair, margin, cache);
  const bool is_made =
      faces == detail::RememberedFaces::made && !found.is_beyond && found.axis == axis;
  return is_made || detail::collide_axis(pair, found, margin, out);
}

/// Signed distance of two polytopes, exact to rounding, with the pair's cache.
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

/// Signed distance of two polytopes, without a cache.
template <class ShapeT>
requires Polytope<ShapeT> SignedDistance<SpaceOf<ShapeT>> distance(const Placed<ShapeT>& a,
                                                                   const Placed<ShapeT>& b) {
  PairCache<SpaceOf<ShapeT>> none;
  return distance(a, b, none);
}

/// Whether two polytopes have a point in common, with the pair's cache. The function also finds the
/// features of the separating axis and stores them in the cache.
template <class ShapeT>
requires Polytope<ShapeT>
[[nodiscard]] bool overlap(const Placed<ShapeT>& a, const Placed<ShapeT>& b,
                           PairCache<SpaceOf<ShapeT>>& cache) {
  const detail::PolytopePair<ShapeT> pair(a, b);
  return !pair.is_clearly_apart(0, cache) && !detail::axis_of(pair, 0, cache).is_beyond;
}

/// Whether two polytopes have a point in common, without a cache.
template <class ShapeT>
requires Polytope<ShapeT>
[[nodiscard]] bool overlap(const Placed<ShapeT>& a, const Placed<ShapeT>& b) {
  PairCache<SpaceOf<ShapeT>> none;
  const detail::PolytopePair<ShapeT> pair(a, b);
  if (pair.is_clearly_apart(0, none)) return false;
  const auto proximity = detail::quick_proximity(pair);
  if (proximity != detail::Proximity::undecided) return proximity == detail::Proximity::touching;
  return !detail::axis_of(pair, 0, none).is_beyond;
}

}  // namespace moreau
