// SPDX-License-Identifier: MIT
// A loose sample of grains above a floor, made by random ballistic deposition. It can then be
// compressed, or fall under gravity.
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

/// Poses of grains with the given circumradii in a box with side walls. The last axis points up,
/// and the floor is at height 0. Along each other axis the box is [0, length]. The circumscribed
/// spheres of the grains lie in the box and do not overlap. So the grains do not overlap.
///
/// The spheres are placed one by one. For each sphere, 40 random horizontal positions are tried. At
/// each position the sphere is lowered until it touches the floor or another sphere. The lowest of
/// these 40 places is taken. The rotations are random. The cost is proportional to the square of
/// the number of grains.
/// @tparam S      the space, e.g. Space<3>
/// @param radii   radii of the circumscribed spheres, > 0 [m]
/// @param length  length of the floor, at least the largest diameter [m]
/// @param random  random number generator, whose state is advanced
/// @throws std::invalid_argument if the length is not finite, or if a radius is not > 0 or does not
///                               fit into the box
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
