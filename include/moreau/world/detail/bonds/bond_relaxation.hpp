// SPDX-License-Identifier: MIT
// The time H in which the errors of rigid bonds are corrected. Let d be the stretch of a bond, or R times its rotation, and w the
// velocity between its bodies that the step before has left: errors of the solver, of rounding and of the overlap
// correction, and what corrects them. In a step h the bond asks for the velocity
//
//     u = (1 - h / H) w - (h / H) rate d / H,     rate = 1/5,
//
// which is an acceleration of -(w + rate d / H) / H. In constant steps H = h, and w is gone after a step. H = h would load the bonds
// by d / h^2 in a short step that follows a long one, and d is of the long step. So H is then the length of the long step, and
// falls by a twentieth of the time that goes by. As d'' + d' / H + rate d / H^2 = 0 meanwhile, d falls as H^5.5, and the load
// as H^3.5.
//
// Positions have a rounding e. In steps so short that its correction in the time h were an acceleration rate e / h^2 of more than a
// fiftieth of a, H is the time in which it is that fiftieth, at most 10 h. a is the acceleration that the force of a bond
// gives, at least a thousandth of that by its strength, on average over the bonds: what is less breaks no bond.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <tuple>

namespace moreau::detail {

/// H of the steps: start(), then end_step() with a of the solution.
template <std::floating_point Scalar>
class BondRelaxation {
 public:
  static constexpr Scalar rate = Scalar(0.2);

  /// @param step     h [s]
  /// @param rounding e, the largest of all bonds [m]
  void start(Scalar step, Scalar rounding) {
    constexpr Scalar falls = Scalar(0.05), share = Scalar(0.02), most = 10;
    step_ = step;
    time_ = std::max(step, last_time_ - falls * step);
    if (!(last_time_ > 0)) return;  // a is not known
    const Scalar square = rate * rounding / share, longest = most * step;
    time_ = std::max(time_, square < longest * longest * last_acceleration_
                                ? Scalar(std::sqrt(square / last_acceleration_))
                                : longest);
  }
  /// h / H [-].
  Scalar share_of_step() const { return step_ / time_; }
  /// By what (d, R t) is multiplied in the velocity that a bond asks for [1/s].
  Scalar factor() const { return share_of_step() * rate / time_; }
  /// Of a, that by the strength of a bond [-].
  static constexpr Scalar least_load = Scalar(1e-3);
  /// @param acceleration a, the root of the mean square over all bonds [m/s^2]
  void bear(Scalar acceleration) { acceleration_ = acceleration; }
  /// Once in a step; start() and bear() may be called again before, in a step that is repeated.
  void end_step() {
    last_time_ = time_;
    last_acceleration_ = acceleration_;
  }

  /// Whether the numbers, read from a file, are possible.
  bool is_valid() const {
    return std::isfinite(last_time_) && last_time_ >= 0 && std::isfinite(last_acceleration_) &&
           last_acceleration_ >= 0;
  }
  auto serialized_members() {  ///< see core/serialize.hpp
    return std::tie(last_time_, last_acceleration_);
  }

 private:
  Scalar step_ = 1, time_ = 1, acceleration_ = 0;  // of the step
  Scalar last_time_ = 0, last_acceleration_ = 0;   // of the step before; 0 before the first
};

}  // namespace moreau::detail
