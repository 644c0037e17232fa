// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace moreau::detail {

/// Tells whether a sequence of values has stopped decreasing.
class StagnationTest {
 public:
  /// @returns true after `checks` values in a row that were not below `progress` times the least
  ///          value before them; the count then begins anew
  bool stagnates(double value) {
    if (value < progress * least_) {
      least_ = value;
      count_ = 0;
    } else if (++count_ == checks) {
      count_ = 0;
      return true;
    }
    return false;
  }
  int count() const { return count_; }  ///< values in a row without progress, below `checks`

  static constexpr int checks = 8;

 private:
  static constexpr double progress = 0.9;

  double least_ = std::numeric_limits<double>::infinity();
  int count_ = 0;
};

}  // namespace moreau::detail
