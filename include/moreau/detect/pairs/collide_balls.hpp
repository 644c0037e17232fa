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

/// The length of a vector, without overflow of the squares of its components. Eigen's stableNorm()
/// is not used, because it adds the squares in an order that depends on the memory address of the
/// vector. Its last bits therefore change from build to build.
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

/// Signed distance of two balls. If their centres coincide, the normal is the x axis.
template <class S>
SignedDistance<S> distance(const Placed<BallIn<S>>& a, const Placed<BallIn<S>>& b) {
  using Vector = typename S::Vector;
  const Vector offset = b.center() - a.center();
  const auto between = detail::stable_length(offset);
  const Vector normal = between > 0 ? Vector(offset / between) : Vector(Vector::UnitX());
  return {between - (a.radius() + b.radius()), normal, a.center() + a.radius() * normal,
          b.center() - b.radius() * normal};
}

/// Contact of two balls at one point.
/// @param margin  largest gap of a pair in contact [m], >= 0
/// @param out     filled if the pair is in contact, unchanged otherwise
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
