// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "moreau/core/space.hpp"

namespace conformance {

/// A unit vector. All directions are equally probable.
template <class S>
typename S::Vector random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  typename S::Vector v;
  do {
    for (auto& x : v) x = static_cast<typename S::Scalar>(normal(random));
  } while (v.norm() < 1e-3);
  return v.normalized();
}

}  // namespace conformance
