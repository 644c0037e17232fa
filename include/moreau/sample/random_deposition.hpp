// SPDX-License-Identifier: MIT
// A loose sample of grains above a floor, made by random ballistic deposition. It can then be
// compressed, or fall under gravity.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/sample/random_rotation.hpp"

namespace moreau {

namespace detail {

/// Spheres above a floor, sorted into vertical columns.
template <class S>
class DepositedSpheres {
 public:
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static constexpr int up = S::dim - 1;
  using Lengths = std::array<T, std::size_t(up)>;

  /// @param lengths of the floor along the horizontal axes [m]
  /// @param widest  radius of the largest sphere [m], at most half of the shortest length
  DepositedSpheres(const Lengths& lengths, T widest) {
    std::size_t columns = 1;
    for (std::size_t k = 0; k < std::size_t{up}; ++k) {
      count_[k] = std::max<std::size_t>(
          1, static_cast<std::size_t>(std::min(lengths[k] / (2 * widest), T(most_columns))));
      width_[k] = lengths[k] / static_cast<T>(count_[k]);
      columns *= count_[k];
    }
    columns_.resize(columns);
  }

  /// The lowest height of the centre of a sphere that comes down and touches the floor or a sphere
  /// [m].
  /// @param x      horizontal position; the last coordinate is not read [m]
  /// @param radius [m]
  T height_at(const Vector& x, T radius) const {
    T height = radius;
    // Columns are at least as wide as the largest sphere: two spheres that touch lie in the same
    // column or in neighbours.
    std::array<std::size_t, std::size_t{up}> from{}, to{}, at{};
    for (std::size_t k = 0; k < std::size_t{up}; ++k) {
      const std::size_t column = column_along(k, x[Eigen::Index(k)]);
      from[k] = at[k] = column > 0 ? column - 1 : 0;
      to[k] = std::min(column + 1, count_[k] - 1);
    }
    while (true) {
      for (const Sphere& sphere : columns_[index(at)]) {
        const T reach = radius + sphere.radius;
        if (sphere.center[up] + reach <= height) continue;
        const T aside = (sphere.center.template head<up>() - x.template head<up>()).squaredNorm();
        if (aside >= reach * reach) continue;
        height = std::max(height, sphere.center[up] + std::sqrt(reach * reach - aside));
      }
      std::size_t k = 0;
      for (; k < std::size_t{up} && at[k] == to[k]; ++k) at[k] = from[k];
      if (k == std::size_t{up}) return height;
      ++at[k];
    }
  }
  void add(const Vector& center, T radius) {
    std::array<std::size_t, std::size_t{up}> at{};
    for (std::size_t k = 0; k < std::size_t{up}; ++k)
      at[k] = column_along(k, center[Eigen::Index(k)]);
    columns_[index(at)].push_back({center, radius});
  }

 private:
  static constexpr int most_columns = 1000;  // along one axis
  struct Sphere {
    Vector center;
    T radius;
  };

  std::size_t column_along(std::size_t axis, T x) const {
    return std::min(count_[axis] - 1, static_cast<std::size_t>(std::max(T(0), x / width_[axis])));
  }
  std::size_t index(const std::array<std::size_t, std::size_t{up}>& at) const {
    std::size_t index = 0;
    for (std::size_t k = 0; k < std::size_t{up}; ++k) index = index * count_[k] + at[k];
    return index;
  }

  std::array<std::size_t, std::size_t(up)> count_{};  // columns along each horizontal axis
  Lengths width_{};                                   // of a column [m]
  std::vector<std::vector<Sphere>> columns_;
};

}  // namespace detail

/// Poses of grains with the given circumradii in a box with side walls. The last axis points up,
/// and the floor is at height 0. Along axis k the box is [0, lengths[k]]. The circumscribed
/// spheres of the grains lie in the box and do not overlap. So the grains do not overlap.
///
/// The spheres are placed one by one. For each sphere, 40 random horizontal positions are tried. At
/// each position the sphere is lowered until it touches the floor or another sphere. The lowest of
/// these 40 places is taken. The rotations are random. The cost is proportional to the number of
/// grains times the number of layers, if the radii differ little.
/// @tparam S      the space, e.g. Space<3>
/// @param radii   radii of the circumscribed spheres, > 0 [m]
/// @param lengths lengths of the floor along the horizontal axes, at least the largest diameter [m]
/// @param random  random number generator, whose state is advanced
/// @param on_floor function: position [m], radius [m] -> whether a sphere at this horizontal position lies above the
///                floor as a whole; the last coordinate is 0. For floors of other outlines than the box; see
///                round_floor()
/// @throws std::invalid_argument if a length is not finite, if a radius is not > 0 or does not
///                               fit into the box, or if no place above the floor was found in 1000 attempts
template <class S>
std::vector<Pose<S>> random_deposition(
    const std::vector<typename S::Scalar>& radii,
    const std::array<typename S::Scalar, std::size_t(S::dim - 1)>& lengths, std::mt19937_64& random,
    const auto& on_floor) {
  using T = typename S::Scalar;
  constexpr const char* self = "random_deposition";
  constexpr int trials = 40, attempts = 1000, up = S::dim - 1;
  for (const T length : lengths)
    require(std::isfinite(length), self, "length", length, "must be finite");
  const T length = *std::min_element(lengths.begin(), lengths.end());
  T widest = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (!(radii[i] > 0 && 2 * radii[i] <= length))
      throw_invalid(self, "radii[" + std::to_string(i) + "]", radii[i],
                    "must be > 0 and at most half of the length");
    widest = std::max(widest, radii[i]);
  }
  std::vector<Pose<S>> poses(radii.size());
  if (radii.empty()) return poses;
  detail::DepositedSpheres<S> deposited(lengths, widest);
  std::uniform_real_distribution<T> unit(0, 1);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    typename S::Vector lowest;
    for (int trial = 0; trial < trials; ++trial) {
      typename S::Vector x = S::Vector::Zero();
      int attempt = 0;
      do {
        for (int k = 0; k < up; ++k)
          x[k] = radii[i] + unit(random) * (lengths[std::size_t(k)] - 2 * radii[i]);
      } while (!on_floor(x, radii[i]) && ++attempt < attempts);
      if (attempt == attempts)
        throw_invalid(self, "radii[" + std::to_string(i) + "]", radii[i],
                      "must leave room above the floor: no place was found in " +
                          std::to_string(attempts) + " attempts");
      x[up] = deposited.height_at(x, radii[i]);
      if (trial == 0 || x[up] < lowest[up]) lowest = x;
    }
    deposited.add(lowest, radii[i]);
    poses[i].position = lowest;
    poses[i].rotation = random_rotation<S>(random);
  }
  return poses;
}

/// The same above the whole floor of the box.
template <class S>
std::vector<Pose<S>> random_deposition(
    const std::vector<typename S::Scalar>& radii,
    const std::array<typename S::Scalar, std::size_t(S::dim - 1)>& lengths,
    std::mt19937_64& random) {
  return random_deposition<S>(radii, lengths, random,
                              [](const typename S::Vector&, typename S::Scalar) { return true; });
}

/// The same above a floor of one length along all horizontal axes [m].
template <class S>
std::vector<Pose<S>> random_deposition(const std::vector<typename S::Scalar>& radii,
                                       typename S::Scalar length, std::mt19937_64& random) {
  std::array<typename S::Scalar, std::size_t(S::dim - 1)> lengths;
  lengths.fill(length);
  return random_deposition<S>(radii, lengths, random);
}

/// A round floor for random_deposition(), such as that of an upright cylinder; in the plane the whole length.
/// @param diameter [m]; pass the same length along all axes of the box
/// @returns the function `on_floor`, for a circle around the middle of the floor
template <class S>
auto round_floor(typename S::Scalar diameter) {
  return [diameter](const typename S::Vector& x, typename S::Scalar radius) {
    constexpr int up = S::dim - 1;
    typename S::Scalar square = 0;
    for (int k = 0; k < up; ++k) square += (x[k] - diameter / 2) * (x[k] - diameter / 2);
    const typename S::Scalar reach = diameter / 2 - radius;
    return square <= reach * reach;
  };
}

}  // namespace moreau
