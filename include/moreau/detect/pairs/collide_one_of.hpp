// SPDX-License-Identifier: MIT
// Pairs with a OneOf, a shape whose type is chosen at run time. The functions find out which shapes
// the pair holds, and call the function for these shapes.
#pragma once

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"
#include "moreau/detect/shape_kinds.hpp"

namespace moreau {

namespace detail {

/// Calls use(a, b) with the shapes that a and b hold.
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

/// Signed distance of the shapes that the pair holds.
template <class A, class B>
requires MixedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a,
                                                             const Placed<B>& b) {
  return detail::visit_pair(a, b, [](const auto& x, const auto& y) { return distance(x, y); });
}
/// Signed distance of the shapes that the pair holds, with the pair's cache.
template <class A, class B>
requires MixedPair<A, B> SignedDistance<SpaceOf<A>> distance(const Placed<A>& a, const Placed<B>& b,
                                                             PairCache<SpaceOf<A>>& cache) {
  return detail::visit_pair(a, b,
                            [&](const auto& x, const auto& y) { return distance(x, y, cache); });
}
/// Whether the shapes that the pair holds have a point in common.
template <class A, class B>
requires MixedPair<A, B>
[[nodiscard]] bool overlap(const Placed<A>& a, const Placed<B>& b) {
  return detail::visit_pair(a, b, [](const auto& x, const auto& y) { return overlap(x, y); });
}
/// Whether the shapes that the pair holds have a point in common, with the pair's cache.
template <class A, class B>
requires MixedPair<A, B>
[[nodiscard]] bool overlap(const Placed<A>& a, const Placed<B>& b, PairCache<SpaceOf<A>>& cache) {
  return detail::visit_pair(a, b,
                            [&](const auto& x, const auto& y) { return overlap(x, y, cache); });
}

/// Contact points of the shapes that the pair holds.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, without meaning otherwise
/// @returns whether the signed gap is at most the margin
template <class A, class B>
requires MixedPair<A, B>
bool collide(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
             Manifold<SpaceOf<A>>& out, PairCache<SpaceOf<A>>& cache) {
  return detail::visit_pair(
      a, b, [&](const auto& x, const auto& y) { return collide(x, y, margin, out, cache); });
}

}  // namespace moreau
