// SPDX-License-Identifier: MIT
// The operator of contacts with springs in series, u = (W + D) r + b: W and b of another operator,
// and one diagonal matrix per contact, its compliance over the square of the time step
// (law/compliant.hpp derives it).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/core/detail/compiled_once.hpp"

namespace moreau {

/// The operator of compliant contacts. block(c) is W_cc + D_cc; bodies and their velocities are those
/// of the rigid operator.
/// @tparam Rigid BodyDelassus or RollingDelassus
template <class Rigid>
class CompliantDelassus : public Rigid {
 public:
  using Space = typename Rigid::Space;
  using typename Rigid::Scalar;
  using typename Rigid::Vector;

  /// As BodyDelassus::assemble.
  /// @param compliance diagonal of D, one entry per row of a contact, normal first, equal for all
  ///                   tangents [1/kg]; one per contact
  void assemble(std::span<Contact<Space>> contacts, std::span<const MobilityRoot<Space>> roots,
                std::span<const typename Space::Twist> free, std::span<const Vector> compliance,
                const Team& team = {}) {
    compliance_.assign(compliance.begin(), compliance.end());
    stretch_.assign(compliance.size(), Vector::Zero());
    Rigid::assemble(
        contacts, roots, free, [&](std::size_t c) -> const Vector& { return compliance_[c]; },
        team);
  }

  /// Diagonal of D of a contact [1/kg].
  const Vector& compliance(std::size_t c) const { return compliance_[c]; }

  /// u = (W r)_c + D_cc r_c + b_c under the impulses applied so far [m/s].
  Vector velocity(std::size_t c) const { return Rigid::velocity(c) + stretch_[c]; }
  /// The normal component of velocity(c) alone [m/s].
  Scalar normal_velocity(std::size_t c) const { return Rigid::normal_velocity(c) + stretch_[c][0]; }
  /// Applies an impulse to the bodies and the spring of a contact, in its frame [N s].
  void apply(std::size_t c, const Vector& impulse) {
    Rigid::apply(c, impulse);
    stretch(c, impulse);
  }
  /// As BodyDelassus::push, and stretches the spring.
  void push(std::size_t c, const Vector& impulse) {
    Rigid::push(c, impulse);
    stretch(c, impulse);
  }
  /// As BodyDelassus::push_b, and stretches the spring.
  void push_b(std::size_t c, const Vector& impulse) {
    Rigid::push_b(c, impulse);
    stretch(c, impulse);
  }
  /// Removes all impulses.
  void clear() {
    Rigid::clear();
    stretch_.assign(stretch_.size(), Vector::Zero());
  }

 private:
  MOREAU_COMPILED_ONCE void stretch(std::size_t c, const Vector& impulse) {
    stretch_[c] += compliance_[c].cwiseProduct(impulse);
  }

  std::vector<Vector> compliance_, stretch_;  // D_cc and D_cc r_c [m/s]
};

}  // namespace moreau
