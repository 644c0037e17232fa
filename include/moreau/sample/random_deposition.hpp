// SPDX-License-Identifier: MIT
// A loose sample above a floor, to be compressed or to fall: random ballistic deposition.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/sample/random_rotation.hpp"

namespace moreau {

/// Poses of grains of these circumradii, in a box whose floor is [0, length] along every axis but
/// the last, which points up; the floor is at height 0. The circumscribed spheres lie in the box
/// and do not overlap, so neither do the grains.
///
/// The spheres are lowered one by one. Each is lowered at 40 random places, until it touches the
/// floor or a sphere, and takes the lowest place. The rotations are random. The work grows with the
/// square of the number of grains.
/// @tparam S      the space, e.g. Space<3>
/// @param radii   of the circumscribed spheres, > 0 [m]
/// @param length  of the floor, at least the largest diameter [m]
/// @throws std::invalid_argument for a length that is not finite, or a radius that is not > 0 or
///         does not fit
template <class S>
std::vector<Pose<S>> random_deposition(const std::vector<typename S::Scalar>& radii,
                                       typename S::Scalar length, std::mt19937_64& random) {
  using T = typename S::Scalar;
  constexpr const char* self = "random_deposition";
  constexpr int trials = 40, up = S::dim - 1;
  require(std::isfinite(length), self, "length", length, "must be finite");
  for (std::size_t i = 0; i < radii.size(); ++i)
    require(radii[i] > 0 && 2 * radii[i] <= length, self, "radii[" + std::to_string(i) + "]",
            radii[i], "must be > 0 and at most half of the length");
  std::vector<Pose<S>> poses(radii.size());
  std::uniform_real_distribution<T> unit(0, 1);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    typename S::Vector lowest;
    for (int trial = 0; trial < trials; ++trial) {
      typename S::Vector x;
      for (int k = 0; k < up; ++k) x[k] = radii[i] + unit(random) * (length - 2 * radii[i]);
      x[up] = radii[i];
      for (std::size_t j = 0; j < i; ++j) {
        const T reach = radii[i] + radii[j];
        const T aside =
            (poses[j].position.template head<up>() - x.template head<up>()).squaredNorm();
        if (aside >= reach * reach) continue;
        x[up] = std::max(x[up], poses[j].position[up] + std::sqrt(reach * reach - aside));
      }
      if (trial == 0 || x[up] < lowest[up]) lowest = x;
    }
    poses[i].position = lowest;
    poses[i].rotation = random_rotation<S>(random);
  }
  return poses;
}

}  // namespace moreau
