// SPDX-License-Identifier: MIT
// Ball against ball, disk against disk.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/detect/manifold.hpp"
#include "moreau/detect/pair_cache.hpp"
#include "moreau/detect/placed.hpp"

namespace moreau {

namespace detail {

/// The length of a vector, without overflow of its squares. Eigen's stableNorm() adds the squares
/// in an order that depends on the address of the vector, so that its bits change from build to
/// build.
template <class Vector>
typename Vector::Scalar stable_length(const Vector& v) {
  using T = typename Vector::Scalar;
  const T scale = std::max(v.cwiseAbs().maxCoeff(), std::numeric_limits<T>::min());
  const T inverse = T(1) / scale;
  T sum = 0;
  for (const T x : v) sum += (x * inverse) * (x * inverse);
  return scale * std::sqrt(sum);
}

}  // namespace detail

/// Signed distance of two balls. The normal of concentric balls is the x axis.
template <class S>
SignedDistance<S> distance(const Placed<BallIn<S>>& a, const Placed<BallIn<S>>& b) {
  using Vector = typename S::Vector;
  const Vector offset = b.center() - a.center();
  const auto between = detail::stable_length(offset);
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
  return detail::touch_at_one_point(distance(a, b), margin,
                                    FeatureKey(FeatureKey::Kind::vertex_vertex, 0, 0), out);
}

}  // namespace moreau
