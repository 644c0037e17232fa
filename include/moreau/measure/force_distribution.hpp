// SPDX-License-Identifier: MIT
// Probability distribution of the contact forces of an assembly.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <vector>

#include "moreau/core/error.hpp"

namespace moreau {

/// Histogram of the probability density of f / (mean of f), with bins of equal width that begin at
/// zero.
template <std::floating_point T>
struct ForceDistribution {
  std::size_t count = 0;   ///< number of forces
  T mean = 0;              ///< mean of all forces [N]
  T width = 0;             ///< width of a bin, in units of the mean [-]
  std::vector<T> density;  ///< density in each bin; sum(density) * width = 1 - beyond [-]
  T beyond = 0;            ///< fraction of the forces above the last bin, in [0, 1] [-]

  /// The middle of bin k, in units of the mean [-].
  T ratio(std::size_t k) const { return (static_cast<T>(k) + T(0.5)) * width; }
};

/// The distribution of normal forces, friction forces or other magnitudes, for example of the
/// result of pair_forces():
///
///   force_distribution<double>(pairs.size(), [&](std::size_t k) { return pairs[k].normal_force; })
///
/// @param count    number of forces
/// @param force_of function: k -> magnitude of force k [N], >= 0
/// @param bins     number of bins, > 0
/// @param reach    upper end of the last bin, in units of the mean, > 0 [-]
/// @returns zero in all bins if no force is greater than zero
/// @throws std::invalid_argument if bins is 0, if reach is not finite or not positive, or if a
///                               force is not finite or negative
template <std::floating_point T>
ForceDistribution<T> force_distribution(std::size_t count, const auto& force_of,
                                        std::size_t bins = 24, T reach = 6) {
  constexpr const char* self = "force_distribution";
  require(bins > 0, self, "bins", bins, "must be > 0");
  require_positive(reach, self, "reach");
  ForceDistribution<T> result;
  result.count = count;
  result.width = reach / static_cast<T>(bins);
  result.density.assign(bins, T(0));
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const T force = force_of(k);
    require(std::isfinite(force) && force >= 0, self, "force", force, "must be finite and >= 0");
    sum += double(force);
  }
  if (!(sum > 0)) return result;
  result.mean = static_cast<T>(sum / double(count));
  std::vector<std::size_t> held(bins, 0);
  std::size_t beyond = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const T place = static_cast<T>(force_of(k)) / result.mean / result.width;
    if (place < static_cast<T>(bins))
      ++held[static_cast<std::size_t>(place)];
    else
      ++beyond;
  }
  const auto share = [&](std::size_t forces) {
    return static_cast<T>(double(forces) / double(count));
  };
  for (std::size_t k = 0; k < bins; ++k) result.density[k] = share(held[k]) / result.width;
  result.beyond = share(beyond);
  return result;
}

}  // namespace moreau
