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

/// The operator of contacts with couples: the functions of BodyDelassus with D + A rows per contact.
template <class S>
class RollingDelassus : private BodyDelassus<S> {
  using Points = BodyDelassus<S>;

 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename RollingBlock<S>::Vector;
  using Matrix = typename RollingBlock<S>::Matrix;
  using Points::bodies, Points::frame, Points::lever_a, Points::lever_b, Points::prefetch;
  using Points::body_count, Points::inverse_mass, Points::velocity_change, Points::velocity_changes;
  using Points::offset_normal, Points::normal_velocity, Points::clear, Points::move, Points::width;
  using Points::size;

  /// As BodyDelassus::assemble, but compliance(c) has D + A entries [1/kg]. The last A entries are
  /// those of the couple / R and must be equal.
  template <class Compliance = detail::RigidContacts>
  void assemble(std::span<Contact<S>> contacts, std::span<const MobilityRoot<S>> roots,
                std::span<const typename S::Twist> free, const Compliance& compliance = {},
                const Team& team = {}) {
    constexpr bool rigid = std::same_as<Compliance, detail::RigidContacts>;
    if constexpr (rigid)
      Points::assemble(contacts, roots, free, compliance, team);
    else
      Points::assemble(
          contacts, roots, free,
          [&](std::size_t c) { return typename S::Vector(linear<S>(compliance(c))); }, team);
    rows_.resize(contacts.size());
    team.share_each(contacts.size(), 64, [&](std::size_t c) {
      const Contact<S>& contact = contacts[c];
      Row& row = rows_[c];
      row.radius =
          effective_radius(contact, is_round(roots[contact.a]), is_round(roots[contact.b]));
      row.axes = row.radius * S::angular_frame(contact.frame);
      row.free = row.axes.transpose() * (angular<S>(free[contact.b]) - angular<S>(free[contact.a]));
      assemble_block(c, row);
      if constexpr (!rigid) row.block.spin.diagonal() += angular<S>(compliance(c));
      // Two bodies whose rotation is prescribed: any positive value will do, see ContactLanes.
      if (row.block.spin.isZero(0)) row.block.spin.diagonal().setConstant(row.block.point.normal);
    });
  }

  /// The operator without the rows of rolling.
  const BodyDelassus<S>& points() const { return *this; }
  /// R of a contact [m].
  Scalar radius(std::size_t c) const { return rows_[c].radius; }
  /// W of contact c in its frame [1/kg].
  const RollingBlock<S>& block(std::size_t c) const { return rows_[c].block; }
  /// The part of W_cc that belongs to body a, D + A x D + A [1/kg].
  Matrix block_of_a(std::size_t c) const {
    return block_of(c, this->lever_a(c), this->inverse_mass(this->bodies(c)[0]));
  }
  /// The part of W_cc that belongs to body b.
  Matrix block_of_b(std::size_t c) const {
    return block_of(c, this->lever_b(c), this->inverse_mass(this->bodies(c)[1]));
  }
  /// Relative (velocity, R spin) without any impulse, with the offset of the law, in the frame of
  /// the contact [m/s].
  Vector free_velocity(std::size_t c) const {
    return joined(Points::free_velocity(c), rows_[c].free);
  }
  /// As BodyDelassus::offset, D + A entries.
  void offset(std::size_t c, const Vector& offset) {
    Points::offset(c, linear<S>(offset));
    rows_[c].free += angular<S>(offset);
  }
  /// Relative (velocity, R spin) under the impulses applied so far, in the frame of the contact
  /// [m/s].
  Vector velocity(std::size_t c) const {
    const Row& row = rows_[c];
    const auto [a, b] = this->bodies(c);
    return joined(Points::velocity(c), row.free + row.axes.transpose() * (spin_of(b) - spin_of(a)));
  }
  /// Applies (impulse, couple / R), in the frame of the contact, to b and its opposite to a [N s].
  void apply(std::size_t c, const Vector& impulse) {
    Points::apply(c, linear<S>(impulse));
    const auto [a, b] = this->bodies(c);
    const typename S::Angular couple = couple_of(c, impulse);
    this->apply_spin(b, couple);
    this->apply_spin(a, -couple);
  }
  /// As BodyDelassus::push.
  void push(std::size_t c, const Vector& impulse) {
    Points::push(c, linear<S>(impulse));
    const auto [a, b] = this->bodies(c);
    const typename S::Angular couple = couple_of(c, impulse);
    this->push_spin(b, couple);
    this->push_spin(a, -couple);
  }
  /// As BodyDelassus::push_a.
  void push_a(std::size_t c, const Vector& impulse) {
    Points::push_a(c, linear<S>(impulse));
    this->push_spin(this->bodies(c)[0], -couple_of(c, impulse));
  }
  /// As BodyDelassus::push_b.
  void push_b(std::size_t c, const Vector& impulse) {
    Points::push_b(c, linear<S>(impulse));
    this->push_spin(this->bodies(c)[1], couple_of(c, impulse));
  }

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
  /// W of a contact without compliance.
  void assemble_block(std::size_t c, Row& row) const {
    const auto [a, b] = this->bodies(c);
    row.block.point = Points::block(c);
    for (int k = 0; k < S::angular_dim; ++k) {
      const typename S::Angular spin_a = this->inverse_mass(a).spin_of(row.axes.col(k)),
                                spin_b = this->inverse_mass(b).spin_of(row.axes.col(k));
      row.block.spin.col(k) = row.axes.transpose() * (spin_a + spin_b);
      row.block.coupling.col(k) = this->frame(c).transpose() * (S::spin(spin_a, this->lever_a(c)) +
                                                                S::spin(spin_b, this->lever_b(c)));
    }
  }
  /// (velocity, R spin) of a point of a body by unit impulses and couples / R at the point, in the frame.
  Matrix block_of(std::size_t c, const typename S::Vector& lever,
                  const InverseMass<S>& mass) const {
    const typename S::Matrix& turn = this->frame(c);
    const typename S::Inertia& axes = rows_[c].axes;
    Matrix block;
    for (int k = 0; k < S::dofs; ++k) {
      const bool is_push = k < S::dim;
      const typename S::Vector push = is_push ? typename S::Vector(turn.col(is_push ? k : 0))
                                              : typename S::Vector(S::Vector::Zero());
      const typename S::Angular spin =
          mass.spin_of(is_push ? S::moment(lever, push)
                               : typename S::Angular(axes.col(is_push ? 0 : k - S::dim)));
      const typename S::Vector velocity = mass.velocity_of(push) + S::spin(spin, lever);
      block.col(k) = joined(turn.transpose() * velocity, axes.transpose() * spin);
    }
    return block;
  }
  typename S::Angular spin_of(std::size_t body) const {
    return angular<S>(this->velocity_change(body));
  }
  /// The couple of an impulse on b, world axes [N m s].
  MOREAU_COMPILED_ONCE typename S::Angular couple_of(std::size_t c, const Vector& impulse) const {
    return rows_[c].axes * angular<S>(impulse);
  }

  std::vector<Row> rows_;
};

}  // namespace moreau
