// SPDX-License-Identifier: MIT
// The Delassus operator of contacts with rolling and twisting resistance: BodyDelassus with A more
// rows per contact, R (w_b - w_a) in the frame of the contact, where R is its effective_radius().
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/detail/effective_radius.hpp"
#include "moreau/contact/rolling_block.hpp"
#include "moreau/core/detail/compiled_once.hpp"
#include "moreau/core/twist.hpp"

namespace moreau {

/// The operator of contacts with couples.
template <class S>
class RollingDelassus {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename RollingBlock<S>::Vector;

  /// As BodyDelassus::assemble, but compliance(c) has D + A entries [1/kg]. The last A entries are
  /// those of the couple / R and must be equal.
  template <class Compliance = detail::RigidContacts>
  void assemble(std::span<Contact<S>> contacts, std::span<const MobilityRoot<S>> roots,
                std::span<const typename S::Twist> free, const Compliance& compliance = {},
                const Team& team = {}) {
    constexpr bool rigid = std::same_as<Compliance, detail::RigidContacts>;
    if constexpr (rigid)
      points_.assemble(contacts, roots, free, compliance, team);
    else
      points_.assemble(
          contacts, roots, free,
          [&](std::size_t c) { return typename S::Vector(linear<S>(compliance(c))); }, team);
    rows_.resize(contacts.size());
    team.share_each(contacts.size(), 64, [&](std::size_t c) {
      const Contact<S>& contact = contacts[c];
      const InverseMass<S>&a = points_.inverse_mass(contact.a),
            &b = points_.inverse_mass(contact.b);
      Row& row = rows_[c];
      row.radius =
          effective_radius(contact, is_round(roots[contact.a]), is_round(roots[contact.b]));
      row.axes = row.radius * S::angular_frame(contact.frame);
      row.free = row.axes.transpose() * (angular<S>(free[contact.b]) - angular<S>(free[contact.a]));
      row.block.point = points_.block(c);
      for (int k = 0; k < S::angular_dim; ++k) {
        const typename S::Angular spin_a = a.spin_of(row.axes.col(k)),
                                  spin_b = b.spin_of(row.axes.col(k));
        row.block.spin.col(k) = row.axes.transpose() * (spin_a + spin_b);
        row.block.coupling.col(k) = contact.frame.transpose() * (S::spin(spin_a, contact.lever_a) +
                                                                 S::spin(spin_b, contact.lever_b));
      }
      if constexpr (!rigid) row.block.spin.diagonal() += angular<S>(compliance(c));
      // Two bodies whose rotation is prescribed: any positive value will do, see ContactLanes.
      if (row.block.spin.isZero(0)) row.block.spin.diagonal().setConstant(row.block.point.normal);
    });
  }

  std::size_t size() const { return rows_.size(); }                ///< contacts
  std::size_t body_count() const { return points_.body_count(); }  ///< bodies, walls included
  /// The operator without the rows of rolling.
  const BodyDelassus<S>& points() const { return points_; }
  /// R of a contact [m].
  Scalar radius(std::size_t c) const { return rows_[c].radius; }

  /// W of contact c in its frame [1/kg].
  const RollingBlock<S>& block(std::size_t c) const { return rows_[c].block; }
  /// The two bodies of a contact, a and b.
  std::array<std::uint32_t, 2> bodies(std::size_t c) const { return points_.bodies(c); }
  /// Relative (velocity, R spin) without any impulse, with the offset of the law, in the frame of
  /// the contact [m/s].
  Vector free_velocity(std::size_t c) const {
    return joined(points_.free_velocity(c), rows_[c].free);
  }
  /// As BodyDelassus::offset_normal.
  void offset_normal(std::size_t c, Scalar offset) { points_.offset_normal(c, offset); }
  /// As BodyDelassus::offset, D + A entries.
  void offset(std::size_t c, const Vector& offset) {
    points_.offset(c, linear<S>(offset));
    rows_[c].free += angular<S>(offset);
  }
  /// Relative (velocity, R spin) under the impulses applied so far, in the frame of the contact
  /// [m/s].
  Vector velocity(std::size_t c) const {
    const Row& row = rows_[c];
    const auto [a, b] = points_.bodies(c);
    return joined(points_.velocity(c), row.free + row.axes.transpose() * (spin_of(b) - spin_of(a)));
  }
  /// The first component of velocity(c) [m/s].
  Scalar normal_velocity(std::size_t c) const { return points_.normal_velocity(c); }
  /// Applies (impulse, couple / R), in the frame of the contact, to b and its opposite to a [N s].
  void apply(std::size_t c, const Vector& impulse) {
    points_.apply(c, linear<S>(impulse));
    const auto [a, b] = points_.bodies(c);
    const typename S::Angular couple = couple_of(c, impulse);
    points_.apply_spin(b, couple);
    points_.apply_spin(a, -couple);
  }
  /// Removes all impulses.
  void clear() { points_.clear(); }
  /// As BodyDelassus::push.
  void push(std::size_t c, const Vector& impulse) {
    points_.push(c, linear<S>(impulse));
    const auto [a, b] = points_.bodies(c);
    const typename S::Angular couple = couple_of(c, impulse);
    points_.push_spin(b, couple);
    points_.push_spin(a, -couple);
  }
  /// As BodyDelassus::push_a.
  void push_a(std::size_t c, const Vector& impulse) {
    points_.push_a(c, linear<S>(impulse));
    points_.push_spin(points_.bodies(c)[0], -couple_of(c, impulse));
  }
  /// As BodyDelassus::push_b.
  void push_b(std::size_t c, const Vector& impulse) {
    points_.push_b(c, linear<S>(impulse));
    points_.push_spin(points_.bodies(c)[1], couple_of(c, impulse));
  }
  /// As BodyDelassus::move.
  void move(const Team& team = {}) { points_.move(team); }
  /// As BodyDelassus::velocity_change.
  auto velocity_change(std::size_t body) const { return points_.velocity_change(body); }
  static constexpr int width = BodyDelassus<S>::width;  ///< as BodyDelassus::width
  /// As BodyDelassus::velocity_changes.
  std::span<Scalar> velocity_changes() { return points_.velocity_changes(); }

 private:
  struct Row {
    typename S::Inertia axes;  // R times the axes of rotation of the frame, world axes [m]
    typename S::Angular free;
    RollingBlock<S> block;
    Scalar radius;
  };
  static bool is_round(const MobilityRoot<S>& body) {
    return body.grain || !body.angular.isZero(0);
  }
  static Vector joined(const typename S::Vector& point, const typename S::Angular& spin) {
    Vector u;
    linear<S>(u) = point;
    angular<S>(u) = spin;
    return u;
  }
  typename S::Angular spin_of(std::size_t body) const {
    return angular<S>(points_.velocity_change(body));
  }
  /// The couple of an impulse on b, world axes [N m s].
  MOREAU_COMPILED_ONCE typename S::Angular couple_of(std::size_t c, const Vector& impulse) const {
    return rows_[c].axes * angular<S>(impulse);
  }

  BodyDelassus<S> points_;
  std::vector<Row> rows_;
};

}  // namespace moreau
