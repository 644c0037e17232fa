// SPDX-License-Identifier: MIT
// Overlaps that rounding, the linearization of rotations and unfinished sweeps leave are taken back
// here, by a displacement outside the velocity problem, so that no velocity and no kinetic energy
// come of it: find the mass-weighted smallest shift d with
//
//     n . (change of the gap by d) >= rate (-gap - slop)   where gap < -slop
//     n . (change of the gap by d) >= -(gap + slop)        elsewhere (no new overlap)
//
// by a few projected Gauss-Seidel sweeps over the normals. What the shift does against the external
// forces (work) is in the report; what it does to a driven wall (travel) is the body's shift.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"

namespace moreau {

/// Which overlaps are taken back, and how fast.
struct OverlapCorrectionOptions {
  bool enabled = true;  ///< off: overlaps stay
  double slop = 2e-4;   ///< overlap left alone, relative to the grain size, >= 0 [-]
  double rate = 0.2;    ///< share of the excess taken back per step, in (0, 1] [-]
  int sweeps = 10;      ///< over all contacts, >= 1
};

/// What the correction did in one step.
struct OverlapCorrectionReport {
  std::size_t corrected = 0;  ///< contacts deeper than the slop
  double work = 0;            ///< of the external forces along the shift [J]; < 0 where it lifts
  double largest_shift = 0;   ///< length, of any centre of mass [m]
};

/// Finds the shifts that take overlaps back; the header says which.
template <class S>
class OverlapCorrection {
 public:
  using Scalar = typename S::Scalar;
  using Options = OverlapCorrectionOptions;

  /// @throws std::invalid_argument for a slop that is negative or not finite, a rate outside (0,
  ///         1], less than one sweep
  explicit OverlapCorrection(const Options& options = {}) : options_(options) {
    constexpr const char* self = "OverlapCorrection";
    require(options.slop >= 0 && std::isfinite(options.slop), self, "slop", options.slop,
            "must be finite and >= 0");
    require(options.rate > 0 && options.rate <= 1, self, "rate", options.rate,
            "must lie in (0, 1]");
    require(options.sweeps >= 1, self, "sweeps", options.sweeps, "must be at least 1");
  }

  /// Finds the shift of every body, (displacement [m], rotation vector [rad]) in world axes.
  /// @param op         rows of the contacts; not changed
  /// @param contacts   those of op; in: gaps; out: gaps after the shift, to first order [m]
  /// @param roots      M^-1/2 of every body, those that op was made with
  /// @param grain_size length that the slop is relative to [m]
  /// @param report     filled but for work and largest_shift, which need the forces
  /// @returns whether any overlap was deep enough; if not, the shifts are all zero
  bool solve(const BodyDelassus<S>& op, std::span<Contact<S>> contacts,
             std::span<const MobilityRoot<S>> roots, Scalar grain_size,
             OverlapCorrectionReport& report) {
    report = {};
    shifts_.assign(roots.size(), S::Twist::Zero());
    if (!options_.enabled) return false;
    const Scalar slop = static_cast<Scalar>(options_.slop) * grain_size;
    for (const Contact<S>& contact : contacts) report.corrected += contact.gap < -slop;
    if (report.corrected == 0) return false;
    sweep(op, contacts, roots.size(), slop);
    for (std::size_t i = 0; i < roots.size(); ++i) {
      shifts_[i].template head<S::dim>() = roots[i].linear * scaled_[i].template head<S::dim>();
      shifts_[i].template tail<S::angular_dim>() =
          roots[i].angular * scaled_[i].template segment<S::angular_dim>(S::dim);
    }
    for (std::size_t c = 0; c < contacts.size(); ++c)
      contacts[c].gap += closing(op, c, contacts[c]);
    return true;
  }

  /// Of the last solve(), one per body: (displacement [m], rotation vector [rad]), world axes.
  std::span<const typename S::Twist> shifts() const { return shifts_; }
  const Options& options() const { return options_; }  ///< as given

 private:
  friend struct SerializationAccess;
  auto serialized_members() { return std::tie(options_, shifts_); }

  /// First-order change of the gap of a contact under the present shifts [m].
  Scalar closing(const BodyDelassus<S>& op, std::size_t c, const Contact<S>& contact) const {
    return op.rows_b(c).col(0).dot(scaled_[contact.b]) -
           op.rows_a(c).col(0).dot(scaled_[contact.a]);
  }

  void sweep(const BodyDelassus<S>& op, std::span<const Contact<S>> contacts,
             std::size_t body_count, Scalar slop) {
    scaled_.assign(body_count, BodyDelassus<S>::Wide::Zero());
    pushes_.assign(contacts.size(), Scalar(0));
    for (int k = 0; k < options_.sweeps; ++k) {
      for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Contact<S>& contact = contacts[c];
        const Scalar depth = -(contact.gap + slop);
        const Scalar target = depth > 0 ? static_cast<Scalar>(options_.rate) * depth : depth;
        const Scalar missing = target - closing(op, c, contact);
        const Scalar push = std::max(Scalar(0), pushes_[c] + missing / op.block(c).normal);
        const Scalar change = push - pushes_[c];
        if (change == Scalar(0)) continue;
        pushes_[c] = push;
        scaled_[contact.b] += change * op.rows_b(c).col(0);
        scaled_[contact.a] -= change * op.rows_a(c).col(0);
      }
    }
  }

  Options options_;
  std::vector<typename BodyDelassus<S>::Wide> scaled_;
  std::vector<Scalar> pushes_;
  std::vector<typename S::Twist> shifts_;
};

}  // namespace moreau
