// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace moreau::detail {

/// The sum of any numbers, exact until it is rounded once: a fixed-point number as wide as the range of
/// double (U. Kulisch's accumulator). It does not depend on the order or on the grouping of the terms.
/// Up to 2^30 terms.
class ExactSum {
 public:
  static constexpr std::size_t size = 69;

  void add(double x) {
    if (!std::isfinite(x)) {
      ++parts_[size - 1];
      return;
    }
    if (x == 0) return;
    int exponent = 0;
    // x = mantissa 2^(exponent - 53), with a whole mantissa below 2^53.
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
    const int bit = exponent - 53 + offset;
    if (bit < 0) return;  // below the smallest number
    const auto part = std::size_t(bit / 32);
    __extension__ using Wide = __int128;
    Wide shifted = Wide(mantissa < 0 ? -mantissa : mantissa) << (bit % 32);
    for (std::size_t k = part; shifted != 0; ++k, shifted >>= 32) {
      const auto low = static_cast<std::int64_t>(shifted & 0xffffffff);
      parts_[k] += mantissa < 0 ? -low : low;
    }
  }
  /// The sum, rounded; not a number if a term was not finite.
  double value() const {
    if (parts_[size - 1] != 0) return std::numeric_limits<double>::quiet_NaN();
    std::array<std::int64_t, size> carried = parts_;
    // All parts but the highest in [0, 2^32): the same parts for the same sum.
    for (std::size_t k = 0; k + 2 < size; ++k) {
      const std::int64_t over = carried[k] >> 32;
      carried[k] -= over * (std::int64_t{1} << 32);
      carried[k + 1] += over;
    }
    double sum = 0;
    for (std::size_t k = size - 1; k-- > 0;)
      sum += std::ldexp(double(carried[k]), 32 * int(k) - offset);
    return sum;
  }
  /// The numbers that sums of several processes add up, one by one.
  std::array<std::int64_t, size>& parts() { return parts_; }
  static std::span<std::int64_t> parts_of(std::vector<ExactSum>& sums) {
    static_assert(sizeof(ExactSum) == size * sizeof(std::int64_t));
    return {sums.empty() ? nullptr : sums[0].parts_.data(), sums.size() * size};
  }

 private:
  static constexpr int offset = 1074 + 53;  // bit of 2^0
  std::array<std::int64_t, size> parts_{};
};

}  // namespace moreau::detail
