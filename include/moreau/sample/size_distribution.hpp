// SPDX-License-Identifier: MIT
// Numbers of grains by size, and the meaning of "size".
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

/// The meaning of a grain's size d, which publications do not always state.
enum class SizeReading : std::uint8_t {
  circumdiameter,  ///< twice the largest distance from the centre of mass to a vertex
  circumradius     ///< that distance itself
};

/// The largest distance from the centre of mass to a vertex [m] of a grain of the size [m], > 0.
/// @throws std::invalid_argument unless the size is finite and greater than zero
inline double circumradius_of(double size, SizeReading reading) {
  require(std::isfinite(size) && size > 0, "circumradius_of", "size", size,
          "must be finite and greater than zero");
  return reading == SizeReading::circumdiameter ? size / 2 : size;
}

/// Classes of sizes with shares by number. SizeReading tells what a size means.
class SizeDistribution {
 public:
  /// Grains of one size.
  struct Class {
    double size;   ///< [m], > 0
    double share;  ///< by number, relative to the sum of all shares, >= 0 [-]
  };

  /// @throws std::invalid_argument for no class, a size that is not finite and positive, a share
  ///   that is not finite or negative, or shares that are all zero
  explicit SizeDistribution(std::vector<Class> classes) : classes_(std::move(classes)) {
    require(!classes_.empty(), "SizeDistribution", "classes.size()", classes_.size(),
            "must be at least 1");
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      const auto [size, share] = classes_[i];
      const std::string name = "classes[" + std::to_string(i) + "]";
      require(std::isfinite(size) && size > 0, "SizeDistribution", name + ".size", size,
              "must be finite and greater than zero");
      require(std::isfinite(share) && share >= 0, "SizeDistribution", name + ".share", share,
              "must be finite and not negative");
      total_ += share;
    }
    require(std::isfinite(total_) && total_ > 0, "SizeDistribution", "sum of shares", total_,
            "must be finite and greater than zero");
  }

  /// 50 % of 2.5 cm, 34 % of 3.75 cm, 16 % of 5 cm, by number.
  /// Source: E. Azema et al., "Short-time dynamics of a packing of polyhedral grains under
  /// horizontal vibrations" (2008), section 2.
  static SizeDistribution azema2008() {
    return SizeDistribution({{0.025, 0.50}, {0.0375, 0.34}, {0.05, 0.16}});
  }

  const std::vector<Class>& classes() const { return classes_; }  ///< in the order given
  double smallest() const { return std::min_element(begin(), end(), by_size)->size; }  ///< [m]
  double largest() const { return std::max_element(begin(), end(), by_size)->size; }   ///< [m]

  /// How many of n grains are of each class: the shares of n rounded down, and the grains left over
  /// given to the largest remainders (the first class among equals). They sum up to n.
  std::vector<std::size_t> counts(std::size_t n) const {
    std::vector<std::size_t> count(classes_.size());
    std::vector<double> remainder(classes_.size());
    std::size_t left = n;
    for (std::size_t i = 0; i < classes_.size(); ++i) {
      const double exact = classes_[i].share / total_ * static_cast<double>(n);
      // A share of a whole number of grains may come out one rounding error below it.
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

  /// The sizes [m] of n grains: counts(n) of each class, in random order, which `random` decides.
  /// @throws std::invalid_argument for n = 0
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
