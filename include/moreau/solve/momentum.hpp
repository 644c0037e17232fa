// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace moreau::detail {

/// How far the next sweep starts ahead of the last result, along the last change: a moving average
/// of the rate at which the changes shrink. Fletcher and Reeves' quotient is that rate for the
/// non-linear conjugate gradients of M. Silcowitz, S. Niebe and K. Erleben (Vis. Comput. 26 (2010)
/// 893); a change that grew counts as one half, which draws the average down. Where the law keeps
/// switching, momentum can keep an iteration from settling that settles without: when it gains
/// nothing over some checks it rests for as many.
class Momentum {
 public:
  explicit Momentum(bool enabled = true) : enabled_(enabled) {}

  /// @param change what a plain sweep still changes, in any unit
  void check(double change) {
    if (change < 0.9 * best_) {
      best_ = change;
      stale_ = 0;
    } else if (++stale_ == patience) {
      resting_ = !resting_;
      stale_ = 0;
    }
  }

  /// @param change2 squared change of all impulses by the last sweep
  /// @returns beta in [0, 1)
  double next(double change2) {
    if (!enabled_ || resting_) return 0;
    double rate = last_ > 0 ? change2 / last_ : 0;
    if (rate > 1) rate = grown;
    last_ = change2;
    beta_ = memory * beta_ + (1 - memory) * rate;
    return std::min(beta_, most);
  }

 private:
  static constexpr double memory = 0.8, grown = 0.5, most = 0.98;
  static constexpr int patience = 10;

  bool enabled_, resting_ = false;
  int stale_ = 0;
  double best_ = std::numeric_limits<double>::infinity();
  double beta_ = 0.5, last_ = 0;
};

}  // namespace moreau::detail
