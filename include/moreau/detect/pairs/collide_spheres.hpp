// SPDX-License-Identifier: MIT
// Ball against ball, disk against disk.
#pragma once

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"

namespace moreau {

/// Signed distance of two balls. Concentric ones are given the x axis for a normal.
template <class S>
SignedDistance<S> distance(const Placed<BallIn<S>>& a, const Placed<BallIn<S>>& b) {
  using Vector = typename S::Vector;
  const Vector offset = b.center() - a.center();
  const auto between = offset.stableNorm();
  const Vector normal = between > 0 ? Vector(offset / between) : Vector(Vector::UnitX());
  return {between - (a.radius() + b.radius()), normal, a.center() + a.radius() * normal,
          b.center() - b.radius() * normal};
}

/// One contact point.
/// @param margin  pairs up to this gap are in contact [m], >= 0
/// @param out     filled if the pair is in contact, left alone otherwise
/// @returns whether the signed gap is at most the margin
template <class S>
bool collide(const Placed<BallIn<S>>& a, const Placed<BallIn<S>>& b, typename S::Scalar margin,
             Manifold<S>& out, PairCache<S>&) {
  MOREAU_ASSERT(margin >= 0);
  const auto reach = a.radius() + b.radius() + margin;
  if ((b.center() - a.center()).squaredNorm() > reach * reach) return false;
  const SignedDistance<S> found = distance(a, b);
  if (found.gap > margin) return false;
  out.clear();
  out.normal = found.normal;
  out.gap = found.gap;
  out.contact_class = ContactClass::vertex_vertex;
  out.points.push_back({(found.witness_a + found.witness_b) / 2, found.gap,
                        FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0)});
  return true;
}

}  // namespace moreau
