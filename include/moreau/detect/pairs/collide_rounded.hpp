// SPDX-License-Identifier: MIT
// Pairs with a rounded shape. The query is made for the cores, with the rounding radii added to the
// margin. Then the gaps and positions are corrected by the radii. This is exact, because along any
// axis the separation of two rounded shapes is the separation of their cores minus the sum of the
// radii. The feature keys and the contact class are those of the cores.
#pragma once

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"

namespace moreau {

namespace detail {

/// The core of a rounded shape; for any other shape, the shape itself.
template <class ShapeT>
const Placed<ShapeT>& core_of(const Placed<ShapeT>& shape) {
  return shape;
}
template <class Core>
const Placed<Core>& core_of(const Placed<Rounded<Core>>& shape) {
  return shape.core();
}
/// Distance of the surface from the core [m]; 0 if the shape is not rounded.
template <class ShapeT>
typename SpaceOf<ShapeT>::Scalar radius_about_core(const Placed<ShapeT>&) {
  return 0;
}
template <class Core>
typename SpaceOf<Core>::Scalar radius_about_core(const Placed<Rounded<Core>>& shape) {
  return shape.rounding_radius();
}

/// The signed distance of rounded shapes, computed from the signed distance of their cores.
template <class S>
SignedDistance<S> rounded(const SignedDistance<S>& cores, typename S::Scalar radius_a,
                          typename S::Scalar radius_b) {
  const typename S::Vector witness = cores.witness_a + radius_a * cores.normal;
  const auto gap = cores.gap - (radius_a + radius_b);
  return {gap, cores.normal, witness, witness + gap * cores.normal};
}

}  // namespace detail

/// Signed distance of rounded shapes: the signed distance of the cores minus the radii.
template <class A, class B>
requires RoundedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                               const Placed<B>& b) {
  return detail::rounded(distance(detail::core_of(a), detail::core_of(b)),
                         detail::radius_about_core(a), detail::radius_about_core(b));
}
/// Signed distance of rounded shapes, with the cache of the pair of cores.
template <class A, class B>
requires RoundedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                               const Placed<B>& b,
                                                               PairCache<SpaceOf<A>>& cache) {
  return detail::rounded(distance(detail::core_of(a), detail::core_of(b), cache),
                         detail::radius_about_core(a), detail::radius_about_core(b));
}

/// The contact points of the cores, moved along the normal to midway between the rounded surfaces.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, without meaning otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
requires RoundedPair<A, B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out, PairCache<SpaceOf<A>>& cache) {
  MOREAU_ASSERT(margin >= 0);
  const auto radius_a = detail::radius_about_core(a), radius_b = detail::radius_about_core(b);
  const auto thickness = radius_a + radius_b;
  if (!collide(detail::core_of(a), detail::core_of(b), margin + thickness, out, cache))
    return false;
  out.gap -= thickness;
  const typename SpaceOf<A>::Vector shift = (radius_a - radius_b) / 2 * out.normal;
  for (auto& point : out.points) {
    point.gap -= thickness;
    point.position += shift;
  }
  return true;
}

}  // namespace moreau
