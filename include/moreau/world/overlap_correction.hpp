// SPDX-License-Identifier: MIT
// Overlaps come from rounding, from the linearization of rotations and from sweeps that did not
// converge. They are corrected by displacements outside the velocity problem, which change no kinetic energy:
// spins turn with the bodies. Find the mass-weighted smallest shift d of all bodies with
//
//     change of the gap by d >= rate (-gap - slop)   where gap < -slop
//     change of the gap by d >= -(gap + slop)        elsewhere (no new overlap)
//
// by a few projected Gauss-Seidel sweeps over the normals. The sweeps carry a shift over few contacts. The shifts of
// columns, arches and other small islands in which no more pairs touch than there are bodies are those of a direct
// method: d is a motion under frictionless impulses with the free normal velocity -rate depth
// (solve/island_newton.hpp).
//
// No body is moved by more than max_shift in a step: the gaps are linear in d, and contacts beyond the margin
// are not known, only for small d. The report has the work of the external forces along the shift.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/serialize.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/solve/contact_islands.hpp"
#include "moreau/solve/island_newton.hpp"
#include "moreau/solve/shared_bodies.hpp"
#include "moreau/world/detail/point_geometry.hpp"

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
    require(options.max_shift > 0 && std::isfinite(options.max_shift), self, "max_shift",
            options.max_shift, "must be finite and > 0");
  }

  /// Computes the shift of every body, (displacement [m], rotation vector [rad]) in world axes.
  /// @param op         the operator of the contacts
  /// @param contacts   in: gaps; out: gaps after the shift, to first order [m]
  /// @param grain_size length that the slop is relative to [m]
  /// @param team       threads that share the work around the sweeps
  /// @param shared     bodies that other processes share; null: none
  /// @returns how many contacts of this process were deeper than the slop; if none, all shifts are
  ///          zero. Its work and largest_shift are 0: they need the forces
  template <class Operator>
  OverlapCorrectionReport solve(const Operator& op, std::span<Contact<S>> contacts,
                                Scalar grain_size, const Team& team = {},
                                SharedBodies* shared = nullptr) {
    OverlapCorrectionReport report;
    shifts_.assign(op.body_count(), S::Twist::Zero());
    if (!options_.enabled) return report;
    const Scalar slop = static_cast<Scalar>(options_.slop) * grain_size;
    rows_.resize(contacts.size());
    team.share_each(contacts.size(), 512, [&](std::size_t c) {
      const Contact<S>& contact = contacts[c];
      rows_[c] = {-(contact.gap + slop), 0, contact.a, contact.b, false};
    });
    const Scalar rate = static_cast<Scalar>(options_.rate);
    const Scalar largest = static_cast<Scalar>(options_.max_shift) * grain_size;
    for (const Row& row : rows_) {
      report.corrected += row.depth > 0;
      report.limited += rate * row.depth > largest;
    }
    if (detail::sum_over(shared, double(report.corrected)) == 0) return report;
    sweep(op, contacts, largest, shared);
    limit(largest, grain_size / 2);
    team.share_each(contacts.size(), 512, [&](std::size_t c) {
      const Row& row = rows_[c];
      if (moved_[row.a] || moved_[row.b]) contacts[c].gap += closing(contacts[c]);
    });
    return report;
  }

  /// Shifts of the last solve(), one per body: (displacement [m], rotation vector [rad]), world
  /// axes.
  std::span<const typename S::Twist> shifts() const { return shifts_; }
  const Options& options() const { return options_; }  ///< as given

 private:
  friend struct SerializationAccess;
  friend struct detail::StateAccess;
  auto serialized_members() { return std::tie(options_, shifts_); }

  /// A contact in the sweeps.
  struct Row {
    Scalar depth;        // overlap beyond the slop, < 0 if there is none [m]
    Scalar push;         // multiplier, >= 0
    std::uint32_t a, b;  // its bodies
    bool done = false;   // by the direct method
  };

  /// First-order change of the gap of a contact by the present shifts [m].
  Scalar closing(const Contact<S>& contact) const {
    return BodyDelassus<S>::relative_velocity(contact, shifts_[contact.a], shifts_[contact.b])[0];
  }
  /// Pushes a body at a point.
  /// @param push  mass times displacement, world axes [kg m]
  /// @param lever from the centre of the body to the point [m]
  template <class Operator>
  void shift(const Operator& op, std::uint32_t body, const typename S::Vector& push,
             const typename S::Vector& lever) {
    const InverseMass<S>& mass = op.inverse_mass(body);
    linear<S>(shifts_[body]) += mass.velocity_of(push);
    angular<S>(shifts_[body]) += mass.spin_of(S::moment(lever, push));
    moved_[body] = !shifts_[body].isZero(0);
  }

  /// What the change of a gap must not be below [m].
  /// @param largest displacement that one contact asks for at most [m]
  Scalar target(const Row& row, Scalar largest) const {
    return row.depth > 0 ? std::min(largest, static_cast<Scalar>(options_.rate) * row.depth)
                         : row.depth;
  }

  /// Corrects the small islands by the direct method, as far as it succeeds.
  template <class Operator>
  void correct_islands(const Operator& op, std::span<const Contact<S>> contacts, Scalar largest) {
    constexpr std::size_t most_bodies = 200;
    constexpr double first_epsilon = 1e-4;
    constexpr typename Newton::Precision precision{1e-3, first_epsilon, 12};
    const detail::PointGeometry<S> points{contacts, op.inverse_masses()};
    islands_.find(points);
    pushes_.assign(contacts.size(), S::Vector::Zero());
    const auto is_deep = [&](std::uint32_t c) { return rows_[c].depth > 0; };
    const auto free = [&](std::size_t c) {
      return typename S::Vector(-target(rows_[c], largest) * S::Vector::Unit(0));
    };
    const auto frictionless = [](std::size_t) { return 0.0; };
    for (std::size_t k = 0; k < islands_.size(); ++k) {
      const auto own = islands_.contacts(k);
      if (own.size() < 2 || islands_.bodies(k) > most_bodies ||
          std::none_of(own.begin(), own.end(), is_deep))
        continue;
      newton_.assign(
          points, own, [&](std::size_t body) { return islands_.moves(body); }, free, frictionless);
      if (!newton_.is_chain()) continue;
      newton_.start(pushes_);
      if (!(newton_.solve(first_epsilon, precision) <= precision.tolerance)) continue;
      newton_.finish(pushes_);
      for (const std::uint32_t c : own) {
        rows_[c].done = true;
        if (pushes_[c][0] == 0) continue;
        const typename S::Vector along_normal = pushes_[c][0] * contacts[c].frame.col(0);
        shift(op, contacts[c].b, along_normal, contacts[c].lever_b);
        shift(op, contacts[c].a, -along_normal, contacts[c].lever_a);
      }
    }
  }

  /// @param largest displacement that one contact asks for at most [m]
  template <class Operator>
  void sweep(const Operator& op, std::span<const Contact<S>> contacts, Scalar largest,
             SharedBodies* shared) {
    moved_.assign(op.body_count(), 0);
    if (options_.islands && !shared) correct_islands(op, contacts, largest);
    for (int k = 0; k < options_.sweeps; ++k) {
      for (std::size_t c = 0; c < rows_.size(); ++c) {
        Row& row = rows_[c];
        // Most contacts are not too deep and between bodies that do not move: nothing to do.
        if (row.done || (!(row.depth > 0) && !moved_[row.a] && !moved_[row.b])) continue;
        const Contact<S>& contact = contacts[c];
        const Scalar missing = target(row, largest) - closing(contact);
        const Scalar push = std::max(Scalar(0), row.push + missing / op.normal(c));
        const Scalar change = push - row.push;
        if (change == Scalar(0)) continue;
        row.push = push;
        const typename S::Vector along_normal = change * contact.frame.col(0);
        shift(op, row.b, along_normal, contact.lever_b);
        shift(op, row.a, -along_normal, contact.lever_a);
      }
      if (shared) average(*shared);
    }
  }

  /// Shortens shifts by which a body would move farther than `largest` [m].
  /// @param radius distance from the centre at which rotations are measured [m]
  void limit(Scalar largest, Scalar radius) {
    for (typename S::Twist& shift : shifts_) {
      const Scalar length = std::max(linear<S>(shift).norm(), radius * angular<S>(shift).norm());
      if (length > largest) shift *= largest / length;
    }
  }

  void average(SharedBodies& shared) {
    shared.average(
        std::span(shifts_.empty() ? nullptr : shifts_[0].data(), shifts_.size() * S::dofs),
        S::dofs);
    for (std::size_t i = 0; i < shifts_.size(); ++i) moved_[i] = !shifts_[i].isZero(0);
  }

  using Newton = detail::IslandNewton<S>;

  Options options_;
  detail::ContactIslands islands_;
  Newton newton_;
  std::vector<typename S::Vector> pushes_;  // one per contact, in its frame [kg m]
  std::vector<unsigned char> moved_;        // bodies with a contact that pushed
  std::vector<Row> rows_;
  std::vector<typename S::Twist> shifts_;
};

}  // namespace moreau
