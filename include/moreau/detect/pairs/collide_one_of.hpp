// SPDX-License-Identifier: MIT
// Shapes that are one of several kinds: one visit finds what the pair is.
#pragma once

#include <utility>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"

namespace moreau {

namespace detail {

/// use(a, b) with what the shapes are.
template <class A, class B, class Use>
decltype(auto) visit_pair(const Placed<A>& a, const Placed<B>& b, Use&& use) {
  if constexpr (is_one_of<A>)
    return a.visit([&](const auto& x) { return visit_pair(x, b, use); });
  else if constexpr (is_one_of<B>)
    return b.visit([&](const auto& y) { return use(a, y); });
  else
    return use(a, b);
}

}  // namespace detail

/// Signed distance of what the two are.
template <class A, class B>
requires MixedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                             const Placed<B>& b) {
  return detail::visit_pair(a, b, [](const auto& x, const auto& y) { return distance(x, y); });
}
/// The same with what is remembered of the pair.
template <class A, class B>
requires MixedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a, const Placed<B>& b,
                                                             PairCache<SpaceOf<A>>& cache) {
  return detail::visit_pair(a, b,
                            [&](const auto& x, const auto& y) { return distance(x, y, cache); });
}
/// Whether what the two are has a point in common.
template <class A, class B>
requires MixedPair<A, B>
bool overlap(const Placed<A>& a, const Placed<B>& b) {
  return detail::visit_pair(a, b, [](const auto& x, const auto& y) { return overlap(x, y); });
}
/// The same with what is remembered of the pair.
template <class A, class B>
requires MixedPair<A, B>
bool overlap(const Placed<A>& a, const Placed<B>& b, PairCache<SpaceOf<A>>& cache) {
  return detail::visit_pair(a, b,
                            [&](const auto& x, const auto& y) { return overlap(x, y, cache); });
}

/// Contact points of what the two are.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
requires MixedPair<A, B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out, PairCache<SpaceOf<A>>& cache) {
  return detail::visit_pair(
      a, b, [&](const auto& x, const auto& y) { return collide(x, y, margin, out, cache); });
}

}  // namespace moreau
