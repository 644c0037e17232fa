// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace moreau::detail {

/// The factor beta of an iteration x -> g(x) with Nesterov's momentum: the next step starts from
/// x + beta (x - x before) (Y. Nesterov, Soviet Math. Dokl. 27 (1983) 372; for contacts H. Mazhar,
/// T. Heyn, D. Negrut and A. Tasora, ACM Trans. Graph. 34 (2015) 32).
///
/// beta is a moving average of the rate at which the squared changes shrink, the quotient of
/// Fletcher and Reeves (as in the non-linear conjugate gradients of M. Silcowitz, S. Niebe and
/// K. Erleben, Vis. Comput. 26 (2010) 893). A change that grew enters the average as `grown_`: at
/// first 0.5, which damps beta while contacts open and close. After some checks it is 1, because
/// the damping then costs a sixth of the sweeps, and half of them where friction lets them circle.
/// It falls again whenever the iteration diverges.
class NesterovMomentum {
 public:
  /// @param change2 squared change of all unknowns in the last step
  /// @returns beta in [0, 1)
  double next(double change2) {
    double rate = last_ > 0 ? change2 / last_ : 0;
    if (!(rate <= 1)) rate = grown_;  // also if squares of impulses overflow, in single precision
    last_ = change2;
    beta_ = memory * beta_ + (1 - memory) * rate;
    return std::min(beta_, most);
  }
  /// @param change of a step with beta = 0, in any unit; it shows whether the iteration diverges
  void check(double change) {
    if (++checks_ == cautious_checks) grown_ = 1;
    least_ = std::min(least_, change);
    if (!(change <= divergence * least_)) grown_ = std::max(cautious, grown_ - caution);
  }

 private:
  static constexpr double memory = 0.8, most = 0.98;
  static constexpr double divergence = 3, caution = 0.1, cautious = 0.5;
  static constexpr int cautious_checks = 10;

  double beta_ = 0.5, last_ = 0, grown_ = cautious;
  double least_ = std::numeric_limits<double>::infinity();
  int checks_ = 0;
};

}  // namespace moreau::detail
