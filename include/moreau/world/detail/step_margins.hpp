// SPDX-License-Identifier: MIT
// The margin of each pair in a step, under laws that are ActsWhereGapsClose (law/concepts.hpp); others get all contacts up
// to the whole margin. A contact with the gap g > 0 takes part in a step of h only if
//
//     g + h u_n < 0                                                                                   (1)
//
// u_n being its normal relative velocity at the end of the step without it: else zero impulse solves its law.
// So a pair needs its contacts up to the gap that it can close in the step. The velocities at the end are known
// only after the contact problem is solved. Therefore
//
//   1. before detection the velocities before the step give each pair a margin m, at most the whole margin M
//      (fit());
//   2. after the contact problem is solved, suffice() finds out whether any pair can approach by more than its
//      m in the step. If none can, (1) holds for no contact that was left out: the solution is one of the
//      problem with all contacts up to M. Otherwise the step is solved again with M for all pairs.
//
// Results are those of M; the guess of step 1 affects the CPU time only. The guess: let s_p be a bound
// on how far the bodies of pair p approach in the step, and s_i the largest s_p of the pairs of body i. A body that
// is hit moves with the one that hits it, so that
//
//     m = M / 10 + 2 max(s_i, s_j)
//
// covers the pairs of a body that is hit, and M / 10 small motions. After some steps in which M / 100 would have been enough
// for them in all pairs, it takes the place of M / 10, until a step needs more. suffice() finds out both.
//
// The bound: points of both bodies at most R from the centre of a have relative velocities of at most
// |u| + R |w|, u being the relative velocity of the two rigid motions at this centre and w that of their rotations.
// Bodies that move together, such as grains and a turning cylinder wall, do not approach.
// The contacts of bonds (law/bonded.hpp) do not come from detection, which leaves these pairs out.
// Near walls that turn, the contact problem adds the chord of the motion to u_n (chord_velocities.hpp). Where it is
// negative it is at most the approach velocity before the step, which is then added to the bound of 2.
#pragma once

#include <algorithm>
#include <atomic>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/ids.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/detect/broad_phase.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// A bound on the relative velocity of two bodies near the centre of the first one [m/s].
/// @param twist_a,twist_b of the bodies, or their displacements and rotations in a step [m]
/// @param to_a   from the centre of b to that of a, world axes [m]
/// @param radius of the points around the centre of a [m]
template <class S>
typename S::Scalar relative_speed(const typename S::Twist& twist_a,
                                  const typename S::Twist& twist_b, const typename S::Vector& to_a,
                                  typename S::Scalar radius) {
  const typename S::Angular of_b = angular<S>(twist_b), turn = of_b - angular<S>(twist_a);
  typename S::Vector slide = linear<S>(twist_b) + S::spin(of_b, to_a);
  slide -= linear<S>(twist_a);
  return slide.norm() + radius * turn.norm();
}

/// The motions of all bodies in a step.
template <class S>
struct StepMotion {
  std::span<const typename S::Twist> velocities;  ///< one per body, world axes [m/s, rad/s]
  /// One per body: displacement and rotation beside the velocities [m, rad]; empty: none.
  std::span<const typename S::Twist> shifts;
  typename S::Scalar step;  ///< h [s]
  /// One per body: velocities before the step, if chords are added to the relative velocities; else empty.
  std::span<const typename S::Twist> before = {};

  /// A bound on the distance by which two bodies can approach [m].
  /// @param a,b indices of the bodies
  typename S::Scalar approach(std::size_t a, std::size_t b, const typename S::Vector& to_a,
                              typename S::Scalar radius) const {
    auto sum = step * relative_speed<S>(velocities[a], velocities[b], to_a, radius);
    if (!shifts.empty()) sum += relative_speed<S>(shifts[a], shifts[b], to_a, radius);
    if (!before.empty()) sum += step * relative_speed<S>(before[a], before[b], to_a, radius);
    return sum;
  }
  /// A bound on the distance by which points of a body move that are at most a length from its centre [m].
  typename S::Scalar reach(std::size_t i, typename S::Scalar length) const {
    const auto speed = [&](const typename S::Twist& twist) {
      const auto turn = angular<S>(twist).norm();
      return linear<S>(twist).norm() + (turn > 0 ? length * turn : 0);
    };
    auto sum = step * speed(velocities[i]);
    if (!shifts.empty()) sum += speed(shifts[i]);
    if (!before.empty()) sum += step * speed(before[i]);
    return sum;
  }
};

/// Whether margins are chosen in a step, by how often steps had to be repeated: after a repeated step the whole
/// margin is used for some steps, for more of them if the next attempt fails as well. A function of the past steps, and
/// so part of a snapshot.
struct MarginAttempts {
  std::uint32_t waiting = 0;  ///< steps until the next attempt
  std::uint32_t pause = 1;    ///< steps to wait after the next failure
  std::uint32_t calm =
      0;  ///< steps in a row for which the least margins were enough, counted up to eight

  /// The share of the whole margin that each pair gets at least [-].
  double share() const { return calm < 8 ? usual_share : least_share; }
  static constexpr double usual_share = 0.1, least_share = 0.01;

  /// Whether to choose margins in this step.
  bool begin() {
    if (waiting == 0) return true;
    --waiting;
    return false;
  }
  /// After an attempt.
  /// @param is_calm whether the least margins were or would have been enough
  void end(bool repeated, bool is_calm) {
    constexpr std::uint32_t longest = 64;
    calm = is_calm ? std::min(8U, calm + 1) : 0;
    if (repeated) waiting = pause;
    pause = repeated ? std::min(longest, 2 * pause) : std::max(1U, pause / 2);
  }
};

/// The margins of the pairs of grains, and of grains and walls; the head of this file says how they are chosen.
template <class S>
class StepMargins {
 public:
  using Scalar = typename S::Scalar;

  void use_whole() { fitted_ = false; }  ///< gives all pairs the whole margin
  /// Chooses the margins of a step.
  /// @param bounds ApproachBounds by the velocities before the step
  /// @param share  MarginAttempts::share()
  MOREAU_INLINED void fit(const Team& team, const auto& bounds, double share) {
    fitted_ = true;
    share_ = Scalar(share);
    near_.resize(bounds.pairs.size());
    of_grain_.resize(bounds.grains.size());
    team.share_each(of_grain_.size(), 256,
                    [&](std::size_t k) { of_grain_[k] = bounds.of_walls(k); });
    team.share_each(near_.size(), 512, [&](std::size_t p) { near_[p] = bounds.of_pair(p); });
    for (std::size_t p = 0; p < near_.size(); ++p) {
      const Scalar approach = near_[p];
      Scalar &first = of_grain_[bounds.pairs[p].first], &second = of_grain_[bounds.pairs[p].second];
      first = std::max(first, approach);
      second = std::max(second, approach);
    }
    // Impacts do not move a grain of prescribed motion: only the bound of the other grain counts.
    for (std::size_t k = 0; k < of_grain_.size(); ++k)
      if (bounds.is_prescribed(k)) of_grain_[k] = 0;
  }
  bool are_fitted() const { return fitted_; }  ///< not so after use_whole()
  /// Leaves pairs out of detection, until take_all().
  /// @param pairs  of grains, sorted by their bodies
  /// @param bonds  of bodies, sorted likewise
  void leave_out(std::span<const IndexPair> pairs, const auto& grains, const auto& bonds) {
    left_out_.assign(bonds.empty() ? 0 : pairs.size(), 0);
    std::size_t p = 0;
    for (const auto& bond : bonds) {
      const auto compare = [&] {
        const BodyId a = grains[pairs[p].first].body;
        return a == bond.a ? grains[pairs[p].second].body <=> bond.b : a <=> bond.a;
      };
      while (p < pairs.size() && compare() < 0) ++p;
      if (p < pairs.size() && compare() == 0) left_out_[p] = 1;
    }
  }
  void take_all() { left_out_.clear(); }  ///< leaves no pair out
  /// Whether the boxes of pair p are closer than the whole margin; true if that is not known. Not of a pair that is left
  /// out.
  bool is_near(std::size_t p) const { return (!fitted_ || near_[p] >= 0) && !is_left_out(p); }
  /// The margin of a pair of grains [m].
  /// @param whole the largest margin [m]
  Scalar of_pair(std::size_t first, std::size_t second, Scalar whole) const {
    return fitted_ ? margin(approach_of(first, second), whole, share_) : whole;
  }
  /// The margin of grain k and any wall [m].
  Scalar of_walls(std::size_t k, Scalar whole) const {
    return fitted_ ? margin(of_grain_[k], whole, share_) : whole;
  }

  /// What suffice() finds out.
  struct Sufficiency {
    bool
        is_enough;  ///< whether no pair can approach by more than its margin, unless that is the whole one
    bool is_calm;  ///< the same of the margins with MarginAttempts::least_share
  };
  /// @param bounds ApproachBounds of the motion that has been found
  Sufficiency suffice(const Team& team, const auto& bounds) {
    std::atomic<bool> enough{true}, calm{true};
    const auto check = [&](Scalar approach, Scalar reach, const auto& bound) {
      const Scalar least = margin(approach, bounds.margin, Scalar(MarginAttempts::least_share)),
                   chosen = margin(approach, bounds.margin, share_);
      if (reach <= (calm.load(std::memory_order_relaxed) ? least : chosen) ||
          !(least < bounds.margin))
        return;
      const Scalar most = bound();
      if (most > least) calm.store(false, std::memory_order_relaxed);
      if (most > chosen && chosen < bounds.margin) enough.store(false, std::memory_order_relaxed);
    };
    const Scalar widest = bounds.widest(), reach_of_walls = bounds.reach_of_walls();
    reach_.resize(of_grain_.size());
    team.share_each(of_grain_.size(), 256, [&](std::size_t k) {
      reach_[k] = bounds.reach(k, widest);
      check(of_grain_[k], reach_[k] + reach_of_walls, [&] { return bounds.of_walls(k); });
    });
    team.share_each(near_.size(), 512, [&](std::size_t p) {
      if (is_left_out(p)) return;
      const auto [first, second] = bounds.pairs[p];
      check(approach_of(first, second), reach_[first] + reach_[second],
            [&] { return bounds.of_pair(p); });
    });
    return {enough, calm};
  }

 private:
  bool is_left_out(std::size_t p) const { return !left_out_.empty() && left_out_[p] != 0; }
  Scalar approach_of(std::size_t first, std::size_t second) const {
    return std::max(of_grain_[first], of_grain_[second]);
  }
  static Scalar margin(Scalar approach, Scalar whole, Scalar share) {
    return std::min(whole, share * whole + 2 * approach);
  }

  List<Scalar> near_;             // bound of each pair [m]; < 0: its boxes are far apart
  List<Scalar> of_grain_;         // largest of the bounds of its pairs [m]
  List<Scalar> reach_;            // of each grain, see ApproachBounds [m]
  List<unsigned char> left_out_;  // of each pair: whether detection leaves it out; empty: none
  Scalar share_ = 0;              // of the whole margin, at least
  bool fitted_ = false;
};

}  // namespace moreau::detail
