// SPDX-License-Identifier: MIT
// Overlaps come from rounding, from the linearization of rotations and from sweeps that did not
// converge. They are corrected by displacements outside the velocity problem, which change no kinetic energy:
// spins turn with the bodies. Find the mass-weighted smallest shift d of all bodies with
//
//     change of the gap by d >= rate (-gap - slop)   where gap < -slop
//     change of the gap by d >= -(gap + slop)        elsewhere (no new overlap)
//
// by a few projected Gauss-Seidel sweeps over the normals (detail/overlap_sweeps.hpp). The sweeps carry a shift over few
// contacts. The shifts of columns, arches and other small islands in which no more pairs touch than there are bodies are
// those of a direct method: d is a motion under frictionless impulses with the free normal velocity -rate depth
// (solve/island_newton.hpp).
//
// No body is moved by more than max_shift in a step: the gaps are linear in d for small d only, and contacts beyond the
// margin are unknown. The report has the work of the external forces along the shift.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/contact_islands.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/island_newton.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/world/detail/overlap_sweeps.hpp"
#include "moreau/world/detail/state_access.hpp"

namespace moreau {

/// Which overlaps are corrected, and how fast.
struct OverlapCorrectionOptions {
  bool enabled = true;  ///< off: overlaps stay
  double slop = 2e-4;   ///< overlap that is not corrected, relative to the grain size, >= 0 [-]
  double rate = 0.2;    ///< share of the excess that is corrected per step, in (0, 1] [-]
  int sweeps = 10;      ///< over all contacts, >= 1
  /// Largest displacement of a body in one step, of its centre and by its rotation at half a grain size
  /// from there, relative to the grain size, > 0 [-]. The default is the default margin of detection.
  double max_shift = 0.02;
  /// Whether a direct method corrects islands of up to 200 bodies in which no more pairs touch than there are bodies
  bool islands = true;
};

/// Results of the correction in one step.
struct OverlapCorrectionReport {
  std::size_t corrected = 0;  ///< contacts deeper than the slop
  double work = 0;           ///< of the external forces along the shift [J]; < 0 if it lifts bodies
  double largest_shift = 0;  ///< largest displacement of a centre of mass [m]
  std::size_t limited = 0;   ///< contacts so deep that max_shift limited their correction
};

/// Computes the shifts that correct overlaps; the head of this file has the problem it solves.
template <class S>
class OverlapCorrection {
 public:
  using Scalar = typename S::Scalar;
  using Options = OverlapCorrectionOptions;

  /// @throws std::invalid_argument for a slop that is negative or not finite, a rate outside (0,
  ///         1], fewer than one sweep, a largest shift that is not finite or not positive
  explicit OverlapCorrection(const Options& options = {}) : options_(options) {
    constexpr const char* self = "OverlapCorrection";
    require(options.slop >= 0 && std::isfinite(options.slop), self, "slop", options.slop,
            "must be finite and >= 0");
    require(options.rate > 0 && options.rate <= 1, self, "rate", options.rate,
            "must lie in (0, 1]");
    require(options.sweeps >= 1, self, "sweeps", options.sweeps, "must be at least 1");
    require_positive(options.max_shift, self, "max_shift");
  }

  /// Computes the shift of every body, (displacement [m], rotation vector [rad]) in world axes.
  /// @param op         the operator of the contacts
  /// @param contacts   with their gaps [m]; gap_change() is what the shift changes
  /// @param grain_size length that the slop is relative to [m]
  /// @param team       threads that share the work around the sweeps
  /// @param shared     bodies that other processes share; null: none
  /// @returns how many contacts of this process were deeper than the slop; if none, all shifts are
  ///          zero. Its work and largest_shift are 0: they need the forces
  template <class Operator>
  OverlapCorrectionReport solve(Operator& op, std::span<const Contact<S>> contacts,
                                Scalar grain_size, const Team& team = {},
                                SharedBodies* shared = nullptr) {
    OverlapCorrectionReport report;
    shifts_.assign(op.body_count(), S::Twist::Zero());
    shifted_.clear();
    if (!options_.enabled) return report;
    const Scalar slop = static_cast<Scalar>(options_.slop) * grain_size,
                 largest = static_cast<Scalar>(options_.max_shift) * grain_size;
    const Depths depths = find_depths(contacts, slop, largest, team);
    report.corrected = depths.corrected;
    report.limited = depths.limited;
    if (detail::sum_over(shared, double(report.corrected)) == 0) return report;
    sweeps_.start(op.body_count());
    if (options_.islands && !shared) correct_islands(op, contacts, slop, largest);
    const Scalar guess =
        5 * depths.asked / static_cast<Scalar>(std::max<std::size_t>(1, depths.corrected));
    shifted_.assign(shifts_.size(), 0);
    sweeps_.run(
        options_.sweeps, op, contacts, std::span<const Scalar>(depths_),
        std::span<const Scalar>(deepest_), guess,
        [&](Scalar depth) { return target(depth, largest); },
        [&](std::size_t i, const typename S::Twist& shift) {
          limit(i, shift, largest, grain_size / 2);
        },
        team, shared);
    return report;
  }

  /// Shifts of the last solve(), one per body: (displacement [m], rotation vector [rad]), world
  /// axes.
  std::span<const typename S::Twist> shifts() const { return shifts_; }
  /// By how much the shifts of the last solve() change the gap of one of its contacts, to first order [m].
  Scalar gap_change(const Contact<S>& contact) const {
    if (shifted_.empty() || !(shifted_[contact.a] || shifted_[contact.b])) return 0;
    return change_by_shifts(contact);
  }
  const Options& options() const { return options_; }  ///< as given

 private:
  friend struct SerializationAccess;
  friend struct detail::StateAccess;
  auto serialized_members() { return std::tie(options_, shifts_); }

  // By itself: most contacts are not shifted, and gap_change() then takes few instructions.
  MOREAU_COMPILED_ONCE Scalar change_by_shifts(const Contact<S>& contact) const {
    return relative_velocity(contact, shifts_[contact.a], shifts_[contact.b])[0];
  }
  /// Of all contacts.
  struct Depths {
    std::size_t corrected = 0, limited = 0;  // as in the report
    Scalar asked = 0;  // sum of the changes of gaps that deep contacts ask for [m]
  };
  /// Fills depths_ and deepest_.
  Depths find_depths(std::span<const Contact<S>> contacts, Scalar slop, Scalar largest,
                     const Team& team) {
    constexpr std::size_t block = detail::OverlapSweeps<S>::block;
    depths_.resize(contacts.size());
    deepest_.resize((contacts.size() + block - 1) / block);
    const auto end_of = [&](std::size_t k) { return std::min((k + 1) * block, contacts.size()); };
    team.share(deepest_.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        Scalar deepest = -std::numeric_limits<Scalar>::infinity();
        for (std::size_t c = k * block; c < end_of(k); ++c)
          deepest = std::max(deepest, depths_[c] = -(contacts[c].gap + slop));
        deepest_[k] = deepest;
      }
    });
    Depths depths;
    for (std::size_t k = 0; k < deepest_.size(); ++k) {
      if (!(deepest_[k] > 0)) continue;
      for (std::size_t c = k * block; c < end_of(k); ++c) {
        if (!(depths_[c] > 0)) continue;
        ++depths.corrected;
        depths.limited += static_cast<Scalar>(options_.rate) * depths_[c] > largest;
        depths.asked += target(depths_[c], largest);
      }
    }
    return depths;
  }

  /// Least change of a gap [m].
  /// @param largest displacement that one contact asks for at most [m]
  Scalar target(Scalar depth, Scalar largest) const {
    return depth > 0 ? std::min(largest, static_cast<Scalar>(options_.rate) * depth) : depth;
  }

  /// Corrects the small islands by the direct method, as far as it succeeds. What is left of overlaps that were
  /// corrected before is small against the slop, and left to the sweeps.
  template <class Operator>
  void correct_islands(Operator& op, std::span<const Contact<S>> contacts, Scalar slop,
                       Scalar largest) {
    constexpr double first_epsilon = 1e-4;
    constexpr typename Newton::Precision precision{1e-3, first_epsilon, 12};
    const detail::ContactIslands& islands = op.islands();
    pushes_.resize(contacts.size());  // here, so that a later step need not allocate
    const auto is_deep = [&](std::uint32_t c) { return depths_[c] > slop / 100; };
    const auto free = [&](std::size_t c) {
      typename S::Vector offset = S::Vector::Zero();
      offset[0] = -target(depths_[c], largest);
      return offset;
    };
    const auto closed = [](std::size_t) { return 0.0; };
    const auto frictionless = [](std::size_t) { return std::array<double, 2>{}; };
    for (std::size_t k = 0; k < islands.size(); ++k) {
      const auto own = islands.contacts(k);
      // The bodies touch like those of a column, an arch or a tree if no more pairs do than there are bodies.
      if (own.size() < 2 || islands.pairs(k) > islands.bodies(k) ||
          std::none_of(own.begin(), own.end(), is_deep))
        continue;
      for (const std::uint32_t c : own) pushes_[c].setZero();
      newton_.assign(op, own, free, closed, frictionless);
      newton_.start(pushes_, [&](std::uint32_t) { return double(slop) / 100; });
      if (!(newton_.solve(first_epsilon, precision) <= precision.tolerance)) continue;
      newton_.finish(pushes_);
      for (const std::uint32_t c : own) {
        depths_[c] = -std::numeric_limits<Scalar>::infinity();  // never taken
        if (pushes_[c][0] == 0) continue;
        typename S::Vector along_normal = contacts[c].frame.col(0);
        along_normal *= pushes_[c][0];
        const std::uint32_t a = contacts[c].a, b = contacts[c].b;
        sweeps_.push(op.inverse_mass(b), b, along_normal, contacts[c].lever_b);
        sweeps_.push(op.inverse_mass(a), a, -along_normal, contacts[c].lever_a);
      }
    }
  }

  /// Shortens the shift of a body that would move farther than `largest` [m].
  /// @param radius distance from the centre at which rotations are measured [m]
  void limit(std::size_t body, const typename S::Twist& shift, Scalar largest, Scalar radius) {
    const Scalar length = std::max(linear<S>(shift).norm(), radius * angular<S>(shift).norm());
    shifts_[body] = length > largest ? typename S::Twist(largest / length * shift) : shift;
    shifted_[body] = 1;
  }

  using Newton = detail::IslandNewton<S>;

  Options options_;
  Newton newton_;
  List<typename S::Vector> pushes_;  // one per contact, in its frame [kg m]
  List<Scalar> depths_;              // of contacts: overlap beyond the slop [m]
  List<Scalar> deepest_;             // of blocks of contacts, OverlapSweeps::block: the largest [m]
  detail::OverlapSweeps<S> sweeps_;
  List<typename S::Twist> shifts_;
  List<unsigned char> shifted_;  // bodies whose shift is not zero; empty: none
};

}  // namespace moreau
