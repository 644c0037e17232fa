// SPDX-License-Identifier: MIT
// The acceleration of coloured sweeps: Nesterov's momentum. If it stagnates, Anderson's mixing
// replaces it, and if mixing stagnates, Nesterov's momentum again. Impulses that drift, about in one direction without
// a smaller change per sweep, are left to Nesterov's momentum: they pass where the sweeps have nearly a fixed point, and
// mixing leads back to it.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "moreau/core/list.hpp"
#include "moreau/solve/detail/anderson_mixing.hpp"
#include "moreau/solve/detail/stagnation_test.hpp"
#include "moreau/solve/nesterov_momentum.hpp"
#include "moreau/solve/shared_bodies.hpp"

namespace moreau::detail {

/// Anderson's mixing of the impulses of the points that are active when it starts.
template <class Kernel>
class ImpulseMixing {
 public:
  using S = typename Kernel::S;
  using T = typename S::Scalar;
  using Lanes = typename Kernel::Lanes;

  /// @param active groups with active points
  void start(Kernel& kernel, const List<std::uint32_t>& active) {
    points_.clear();
    for (const std::uint32_t k : active) {
      const typename Kernel::Group& group = kernel.groups()[k];
      for (std::uint32_t p = 0; p < group.active; ++p) points_.push_back(group.first + p);
    }
    packed_.resize(Eigen::Index(points_.size() * Kernel::rows * std::size_t{Lanes::lanes}));
    pack(kernel);
    anderson_.start(packed_);
  }
  /// Replaces the impulses by their mix; the velocities of the kernel are then to be recomputed.
  void mix(Kernel& kernel, SharedBodies* shared) {
    pack(kernel);
    anderson_.mix(packed_, shared);
    const T* from = packed_.data();
    for (const std::uint32_t p : points_)
      for (std::size_t d = 0; d < Kernel::rows; ++d, from += Lanes::lanes)
        kernel.points()[p].impulse[d] = Lanes::load(from);
  }

 private:
  void pack(Kernel& kernel) {
    T* to = packed_.data();
    for (const std::uint32_t p : points_)
      for (std::size_t d = 0; d < Kernel::rows; ++d, to += Lanes::lanes)
        std::memcpy(to, &kernel.points()[p].impulse[d], sizeof(typename Lanes::Values));
  }

  List<std::uint32_t> points_;
  Eigen::Matrix<T, Eigen::Dynamic, 1> packed_;
  AndersonMixing<T> anderson_;
};

/// Which acceleration is in use, and its parameters.
template <class T>
class Acceleration {
 public:
  /// @param enabled false: plain sweeps
  explicit Acceleration(bool enabled = true) : enabled_(enabled) {}

  bool is_mixing() const { return mixing_; }
  T beta() const { return beta_; }  ///< of the next sweep, see NesterovMomentum

  /// Sets beta to 0 for the next sweep: the impulses before do not belong to the present
  /// velocities.
  void interrupt() { beta_ = 0; }
  /// Ends mixing and sets beta to 0.
  void restart() {
    beta_ = 0;
    mixing_ = false;
  }
  /// Sets beta from the squared change of the last sweep, which squared_change() returns.
  void update_beta(const auto& squared_change) {
    beta_ = 0;
    if (enabled_ && !mixing_) beta_ = static_cast<T>(nesterov_.next(squared_change()));
  }
  /// Tests the change of a plain sweep; ends mixing if it stagnates.
  /// @returns whether Nesterov's momentum stagnates
  bool check(double change) {
    if (!mixing_) nesterov_.check(change);
    if (!enabled_ || !stagnation_.stagnates(change)) return false;
    return !std::exchange(mixing_, false);
  }
  void start_mixing() { mixing_ = true; }  ///< in place of Nesterov's momentum
  /// Checks in a row without progress, below StagnationTest::checks.
  int stalled_checks() const { return stagnation_.count(); }

 private:
  bool enabled_, mixing_ = false;
  T beta_ = 0;
  NesterovMomentum nesterov_;
  StagnationTest stagnation_;
};

}  // namespace moreau::detail
