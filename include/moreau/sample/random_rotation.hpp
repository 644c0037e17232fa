// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <random>

namespace moreau {

/// A random rotation of the space S: uniform in the plane, nearly uniform in space.
///
/// The rotation is the product of three rotations by uniform angles about uniform axes (in the
/// plane an axis is +1 or -1). In space the mean of the rotation matrix of each factor is 1/3 of
/// the identity. So the mean of the product is 1/27 of the identity; for a uniform distribution it
/// would be zero.
template <class S>
typename S::Rotation random_rotation(std::mt19937_64& random) {
  using T = typename S::Scalar;
  std::uniform_real_distribution<T> angle(-std::numbers::pi_v<T>, std::numbers::pi_v<T>);
  std::normal_distribution<T> normal;
  typename S::Rotation q = S::identity();
  for (int turn = 0; turn < 3; ++turn) {
    // A vector with independent normally distributed components has a uniformly distributed
    // direction.
    typename S::Angular axis;
    for (int k = 0; k < S::angular_dim; ++k) axis[k] = normal(random);
    q = S::normalized(S::exp(axis.normalized() * angle(random)) * q);
  }
  return q;
}

}  // namespace moreau
