// SPDX-License-Identifier: MIT
// Polyhedron against polyhedron.
#pragma once

#include <limits>
#include <type_traits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/polyhedron_manifold.hpp"

namespace moreau {

/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <std::floating_point T>
bool collide(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b,
             std::type_identity_t<T> margin, Manifold<Space<3, T>>& out,
             PairCache<Space<3, T>>& cache) {
  MOREAU_ASSERT(margin >= T(0));
  const detail::PolyhedronPair<T> pair(a, b);
  if (pair.is_apart_at_once(margin, cache)) return false;
  const detail::PolyhedronAxis<T> found(pair, margin);
  cache.axis = found.axis().normal;
  if (found.is_beyond()) return false;
  detail::fill(pair, found.axis(), found.simplex(), margin, out);
  return true;
}

template <std::floating_point T>
SignedDistance<Space<3, T>> distance(const Placed<Polyhedron<T>>& a,
                                     const Placed<Polyhedron<T>>& b) {
  using Vector = typename Space<3, T>::Vector;
  const detail::PolyhedronPair<T> pair(a, b);
  const detail::PolyhedronAxis<T> found(pair, std::numeric_limits<T>::infinity());
  const auto& axis = found.axis();
  const Vector middle = detail::middle_of_contact(pair, axis, found.simplex());
  const Vector half = T(0.5) * axis.gap * axis.normal;
  return {axis.gap, axis.normal, a.center() + (middle - half), a.center() + (middle + half)};
}

template <std::floating_point T>
bool overlap(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b,
             PairCache<Space<3, T>>& cache) {
  const detail::PolyhedronPair<T> pair(a, b);
  if (pair.is_apart_at_once(T(0), cache)) return false;
  detail::Simplex<T> simplex(pair.support(pair.start()));
  typename Space<3, T>::Vector axis = pair.start();
  const auto proximity = detail::approach<T>([&](const auto& n) { return pair.support(n); },
                                             simplex, axis, T(0), pair.size, detail::all_steps);
  cache.axis = axis.normalized();
  return proximity == detail::Proximity::touching;
}

template <std::floating_point T>
bool overlap(const Placed<Polyhedron<T>>& a, const Placed<Polyhedron<T>>& b) {
  PairCache<Space<3, T>> none;
  return overlap(a, b, none);
}

}  // namespace moreau
