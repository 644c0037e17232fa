// SPDX-License-Identifier: MIT
// Distribution of the contact forces of an assembly.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <vector>

#include "moreau/core/error.hpp"

namespace moreau {

/// The probability density of f over the mean of f as a histogram of equal bins from zero on.
template <std::floating_point T>
struct ForceDistribution {
  std::size_t count = 0;   ///< forces
  T mean = 0;              ///< of all forces [N]
  T width = 0;             ///< of a bin, in means [-]
  std::vector<T> density;  ///< per bin; times width it sums to 1 - beyond [-]
  T beyond = 0;            ///< share of the forces above the last bin, in [0, 1] [-]

  /// The middle of bin k, in means [-].
  T ratio(std::size_t k) const { return (static_cast<T>(k) + T(0.5)) * width; }
};

/// Normal forces, friction forces or any other magnitudes, e.g. those of pair_forces():
///
///   force_distribution<double>(pairs.size(), [&](std::size_t k) { return pairs[k].normal_force; })
///
/// @param count    number of forces
/// @param force_of k -> the magnitude of force k [N], >= 0
/// @param bins     > 0
/// @param reach    where the last bin ends, in means, > 0 [-]
/// @returns densities of zero if there is no force greater than zero
/// @throws std::invalid_argument for no bins, a reach that is not finite or not positive, a force
///         that is not finite or negative
template <std::floating_point T>
ForceDistribution<T> force_distribution(std::size_t count, const auto& force_of,
                                        std::size_t bins = 24, T reach = 6) {
  constexpr const char* self = "force_distribution";
  require(bins > 0, self, "bins", bins, "must be > 0");
  require(std::isfinite(reach) && reach > 0, self, "reach", reach, "must be finite and > 0");
  ForceDistribution<T> result;
  result.count = count;
  result.width = reach / static_cast<T>(bins);
  result.density.assign(bins, T(0));
  T sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const T force = force_of(k);
    require(std::isfinite(force) && force >= 0, self, "force", force, "must be finite and >= 0");
    sum += force;
  }
  if (!(sum > 0)) return result;
  result.mean = sum / static_cast<T>(count);
  const T share = 1 / static_cast<T>(count);
  for (std::size_t k = 0; k < count; ++k) {
    const T place = static_cast<T>(force_of(k)) / result.mean / result.width;
    if (place < static_cast<T>(bins))
      result.density[static_cast<std::size_t>(place)] += share / result.width;
    else
      result.beyond += share;
  }
  return result;
}

}  // namespace moreau
