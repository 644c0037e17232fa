// SPDX-License-Identifier: MIT
// Distribution of the sizes of grains by number, and the definition of "size".
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "moreau/core/error.hpp"

namespace moreau {

/// The definition of a grain's size d. Publications do not always state it.
enum class SizeReading : std::uint8_t {
  circumdiameter,  ///< twice the largest distance from the centre of mass to a vertex
  circumradius     ///< largest distance from the centre of mass to a vertex
};

/// The circumradius of a grain: the largest distance from its centre of mass to a vertex [m].
/// @param size     size of the grain [m], > 0
/// @param reading  definition of the size
/// @throws std::invalid_argument unless the size is finite and > 0
inline double circumradius_of(double size, SizeReading reading) {
  require_positive(size, "circumradius_of", "size");
  return reading == SizeReading::circumdiameter ? size / 2 : size;
}

/// Classes of sizes with their shares by number. SizeReading defines what a size means.
class SizeDistribution {
 public:
  /// A class of grains with the same size.
  struct Class {
    double size;   ///< size of the grains [m], > 0
    double share;  ///< share by number, >= 0, relative to the sum of all shares [-]
  };

  /// @throws std::invalid_argument if there is no class, if a size is not finite or not positive,
  ///                               if a share is not finite or negative, or if all shares are zero
  explicit SizeDistribution(std::vector<Class> classes) : classes_(std::move(classes)) {
    require(!classes_.empty(), "SizeDistribution", "classes.size()", classes_.size(),
            "must be at least 1");
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      const auto [size, share] = classes_[i];
      const std::string name = "classes[" + std::to_string(i) + "]";
      require_positive(size, "SizeDistribution", name + ".size");
      require(std::isfinite(share) && share >= 0, "SizeDistribution", name + ".share", share,
              "must be finite and not negative");
      total_ += share;
    }
    require_positive(total_, "SizeDistribution", "sum of shares");
  }

  /// By number, 50 % of the grains have the size 2.5 cm, 34 % have 3.75 cm and 16 % have 5 cm.
  /// Source: E. Azema et al., "Short-time dynamics of a packing of polyhedral grains under
  /// horizontal vibrations" (2008), section 2.
  static SizeDistribution azema2008() {
    return SizeDistribution({{0.025, 0.50}, {0.0375, 0.34}, {0.05, 0.16}});
  }

  /// in the order in which they were given
  const std::vector<Class>& classes() const { return classes_; }
  /// size of the smallest class [m]
  double smallest() const { return std::min_element(begin(), end(), by_size)->size; }
  /// size of the largest class [m]
  double largest() const { return std::max_element(begin(), end(), by_size)->size; }

  /// The number of grains in each class, for n grains in total. Each class gets its share of n
  /// rounded down. The remaining grains are given to the classes with the largest remainders; of
  /// equal remainders, to the first class. The numbers add up to n.
  std::vector<std::size_t> counts(std::size_t n) const {
    std::vector<std::size_t> count(classes_.size());
    std::vector<double> remainder(classes_.size());
    std::size_t left = n;
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      const double exact = classes_[i].share / total_ * static_cast<double>(n);
      // If a share is a whole number of grains, rounding errors may make it slightly smaller.
      const double whole = std::floor(exact * (1 + 1e-14));
      count[i] = std::min(left, static_cast<std::size_t>(whole));
      remainder[i] = exact - whole;
      left -= count[i];
    }
    std::vector<std::size_t> order(classes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return remainder[a] > remainder[b] || (remainder[a] == remainder[b] && a < b);
    });
    for (std::size_t i = 0; i < left; ++i) ++count[order[i % order.size()]];
    return count;
  }

  /// The sizes [m] of n grains: counts(n) grains of each class, in random order.
  /// @param random random number generator, whose state is advanced
  /// @throws std::invalid_argument if n is 0
  std::vector<double> sample(std::size_t n, std::mt19937_64& random) const {
    require(n > 0, "SizeDistribution::sample", "n", n, "must be at least 1");
    std::vector<double> sizes;
    sizes.reserve(n);
    const std::vector<std::size_t> count = counts(n);
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      sizes.insert(sizes.end(), count[i], classes_[i].size);
    }
    std::shuffle(sizes.begin(), sizes.end(), random);
    return sizes;
  }

 private:
  static bool by_size(const Class& a, const Class& b) { return a.size < b.size; }
  std::vector<Class>::const_iterator begin() const { return classes_.begin(); }
  std::vector<Class>::const_iterator end() const { return classes_.end(); }

  std::vector<Class> classes_;
  double total_ = 0;
};

}  // namespace moreau
