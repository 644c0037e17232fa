// SPDX-License-Identifier: MIT
// The energy that impulses give an island, a parabola of their share. restitution_limit.hpp has the symbols.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "moreau/core/compiled_once.hpp"

namespace moreau::detail {

/// Sums over the contacts of an island; r and u with restitution, r_0 and u_0 without [J].
template <class Scalar>
struct IslandEnergy {
  /// Of sums, relative [-].
  static constexpr double rounding =
      std::max(1e-12, 8 * double(std::numeric_limits<Scalar>::epsilon()));

  bool hits = false;                   ///< some contact hits: E counts, not G
  bool bonded = false;                 ///< has a bond: nothing counts
  double gain = 0, rest_gain = 0;      // G(r), G(r_0)
  double forced = 0, rest_forced = 0;  // r . a / 2, r_0 . a / 2
  // Sums of the absolute values of the terms of E and G: a multiple bounds their rounding.
  double gain_terms = 0, rest_terms = 0;
  double least_gain = 0, least_rest_gain = 0;  // energy that does not count
  double rest_work = 0;                        // r_0 . u_0
  // G(r_0 + s (r - r_0)) = rest_gain + slope s + curvature s^2 / 2
  double slope = 0, curvature = 0;
  double largest_free = 0,
         largest_change = 0;  // relative velocities without impulses, by rest_share() [m/s]

  /// More than the rounding of its terms.
  bool makes_energy() const {
    return !bonded && gain - (hits ? forced : 0) > rounding * gain_terms;
  }
  /// More than what does not count.
  bool counts() const { return !bonded && gain > rounding * gain_terms + least_gain; }
  bool rest_counts() const {
    return !bonded && rest_gain > rounding * rest_terms + least_rest_gain;
  }
  /// The largest s <= 1 with G(s r_0) = s r_0 . u_f + s^2 r_0 . W r_0 / 2 <= 0, where u_f = u_0 - W r_0; 1 if G(r_0)
  /// does not count.
  MOREAU_INLINED Scalar rest_share() const {
    if (!rest_counts()) return 1;
    const double linear = 2 * rest_gain - rest_work, square = rest_work - rest_gain;
    return linear < 0 ? Scalar(std::min(1.0, -linear / square)) : Scalar(0);
  }
  /// The largest s in [0, 1] with E(r_0 + s (r - r_0)) <= max(0, E(r_0)), or G in place of E; 1 if r makes no energy.
  Scalar share() const {
    if (!makes_energy()) return 1;
    if (rest_counts() || curvature <= 0) return 0;
    const double at_0 = std::min(rest_gain - (hits ? rest_forced : 0), 0.);
    const double tilt = slope - (hits ? forced - rest_forced : 0);
    const double root = std::sqrt(tilt * tilt - 2 * curvature * at_0);
    // The larger root of the parabola, without the difference of nearly equal numbers.
    const double s = tilt < 0 ? (root - tilt) / curvature : -2 * at_0 / (tilt + root);
    return s < 1 ? Scalar(s) : s >= 1 ? Scalar(1) : Scalar(0);  // 0 of 0/0
  }
};

}  // namespace moreau::detail
