// SPDX-License-Identifier: MIT
// The effect of the overlap correction on the bodies in a step (stage 5 of impulse_dynamics.hpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "moreau/core/list.hpp"
#include "moreau/core/pose.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/world/overlap_correction.hpp"

namespace moreau::detail {

/// Moves the bodies by the shifts of an OverlapCorrection.
template <class S>
class BodyShifts {
 public:
  using Vector = typename S::Vector;
  using Twist = typename S::Twist;

  /// Before the first step with as many bodies.
  void resize(std::size_t bodies) { unshifted_.reserve(bodies); }
  void clear() { unshifted_.clear(); }              ///< no body is shifted in this step
  bool any() const { return !unshifted_.empty(); }  ///< whether bodies are shifted in this step
  /// Moves the bodies.
  /// @param shifts displacements and rotations, one per body, world axes [m, rad]
  /// @param gravity world axes [m/s^2]
  /// @param report adds the work of the external forces and the largest shift
  void apply(std::span<const Twist> shifts, Bodies<S>& bodies, const Vector& gravity,
             const Team& team, const SharedBodies* shared, OverlapCorrectionReport& report) {
    clear();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (shifts[i].isZero(0)) continue;
      unshifted_.push_back({i, bodies.pose[i]});
      const Vector move = linear<S>(shifts[i]);
      const Vector force = along(Vector(linear<S>(bodies.force[i])), bodies.grain_mass[i], gravity);
      if (!shared || shared->owns(i)) report.work += double(force.dot(move));
      report.largest_shift = std::max(report.largest_shift, double(move.norm()));
    }
    team.share_each(unshifted_.size(), 64, [&](std::size_t k) {
      const std::size_t i = unshifted_[k].body;
      Pose<S>& pose = bodies.pose[i];
      pose.position += linear<S>(shifts[i]);
      pose.rotation = S::normalized(S::exp(angular<S>(shifts[i])) * pose.rotation);
    });
  }
  /// Moves the bodies back.
  void undo(Bodies<S>& bodies) const {
    for (const Unshifted& old : unshifted_) bodies.pose[old.body] = old.pose;
  }
  /// Turns spins as the bodies were turned: with their inertia, so that the kinetic energy stays.
  /// @param shifts     those of apply()
  /// @param velocities in, out: one per body, world axes [m/s, rad/s]
  void turn_spins(std::span<const Twist> shifts, std::span<Twist> velocities,
                  const Team& team) const {
    team.share_each(unshifted_.size(), 256, [&](std::size_t k) {
      const std::size_t i = unshifted_[k].body;
      const typename S::Angular turn = angular<S>(shifts[i]);
      const typename S::Angular spin = angular<S>(velocities[i]);
      if (!turn.isZero(0)) angular<S>(velocities[i]) = S::adjoint(S::exp(turn)) * spin;
    });
  }

 private:
  struct Unshifted {
    std::size_t body;
    Pose<S> pose;  // before apply()
  };
  List<Unshifted> unshifted_;  // the bodies whose shift is not zero
};

}  // namespace moreau::detail
