// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>
#include <random>

namespace moreau {

/// A random rotation of the space S: uniform in the plane, nearly uniform in space.
///
/// It is the product of three rotations by uniform angles about uniform axes (in the plane an axis
/// is +1 or -1). The mean of the rotation matrix of one of them is a third of the identity in
/// space, so that of the product is 1/27 of the identity; the mean of a uniform distribution is
/// zero.
template <class S>
typename S::Rotation random_rotation(std::mt19937_64& random) {
  using T = typename S::Scalar;
  std::uniform_real_distribution<T> angle(-std::numbers::pi_v<T>, std::numbers::pi_v<T>);
  std::normal_distribution<T> normal;
  typename S::Rotation q = S::identity();
  for (int turn = 0; turn < 3; ++turn) {
    // The direction of a vector of independent normal numbers is uniform.
    typename S::Angular axis;
    for (int k = 0; k < S::angular_dim; ++k) axis[k] = normal(random);
    q = S::normalized(S::exp(axis.normalized() * angle(random)) * q);
  }
  return q;
}

}  // namespace moreau
