// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace moreau::detail {

/// How far the next sweep starts ahead of the last result, along the last change: a moving average
/// of the rate at which the changes shrink. Fletcher and Reeves' quotient is that rate for the
/// non-linear conjugate gradients of M. Silcowitz, S. Niebe and K. Erleben (Vis. Comput. 26 (2010)
/// 893). A change that grew counts as one half, which draws the average down. That caution is right
/// while contacts open and close; afterwards it costs a sixth of the sweeps, half of them where
/// friction makes them circle. So it goes, until momentum drives away.
class Momentum {
 public:
  /// @param change2 squared change of all impulses by the last sweep
  /// @returns beta in [0, 1)
  double next(double change2) {
    double rate = last_ > 0 ? change2 / last_ : 0;
    if (rate > 1) rate = grown_;
    last_ = change2;
    beta_ = memory * beta_ + (1 - memory) * rate;
    return std::min(beta_, most);
  }
  /// @param change what a plain sweep still changes, in any unit
  void check(double change) {
    if (++checks_ == cautious_checks) grown_ = 1;
    least_ = std::min(least_, change);
    if (!(change <= away * least_)) grown_ = std::max(cautious, grown_ - caution);
  }

 private:
  static constexpr double memory = 0.8, most = 0.98;
  static constexpr double away = 3, caution = 0.1, cautious = 0.5;
  static constexpr int cautious_checks = 10;

  double beta_ = 0.5, last_ = 0, grown_ = cautious;
  double least_ = std::numeric_limits<double>::infinity();
  int checks_ = 0;
};

/// Tells when something has stopped to shrink.
class Patience {
 public:
  /// @returns whether no value was well below the least so far for some checks; it then starts to
  ///          count anew
  bool exhausted(double value) {
    if (value < progress * least_) {
      least_ = value;
      stale_ = 0;
    } else if (++stale_ == checks) {
      stale_ = 0;
      return true;
    }
    return false;
  }

 private:
  static constexpr double progress = 0.9;
  static constexpr int checks = 8;

  double least_ = std::numeric_limits<double>::infinity();
  int stale_ = 0;
};

}  // namespace moreau::detail
