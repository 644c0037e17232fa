// SPDX-License-Identifier: MIT
// The Delassus operator of contacts that resist rolling and twisting: BodyDelassus with A further
// rows per contact, R (w_b - w_a) in the contact's frame, where R is the effective radius of the
// contact, 1/R = 1/R_a + 1/R_b with the distances of the point from the centres of mass; a wall
// has no curvature.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/body_delassus.hpp"
#include "moreau/contact/effective_radius.hpp"
#include "moreau/contact/rolling_block.hpp"

namespace moreau {

/// The operator for bodies that touch at points and resist rolling; model of what
/// NonlinearGaussSeidel sweeps over.
template <class S>
class RollingDelassus {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename RollingBlock<S>::Vector;

  /// As BodyDelassus::assemble.
  void assemble(std::span<Contact<S>> contacts, std::span<const MobilityRoot<S>> roots,
                std::span<const typename S::Twist> free) {
    points_.assemble(contacts, roots, free);
    rows_.resize(contacts.size());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts[c];
      const MobilityRoot<S>&a = roots[contact.a], &b = roots[contact.b];
      Row& row = rows_[c];
      row.radius = effective_radius(contact, !a.angular.isZero(0), !b.angular.isZero(0));
      const typename S::Inertia axes = row.radius * S::angular_frame(contact.frame);
      row.ka = a.angular * axes;
      row.kb = b.angular * axes;
      row.free = axes.transpose() * (free[contact.b].template tail<S::angular_dim>() -
                                     free[contact.a].template tail<S::angular_dim>());
      row.block.point = points_.block(c);
      row.block.spin = row.ka.transpose() * row.ka + row.kb.transpose() * row.kb;
      row.block.coupling =
          points_.rows_a(c).template middleRows<S::angular_dim>(S::dim).transpose() * row.ka +
          points_.rows_b(c).template middleRows<S::angular_dim>(S::dim).transpose() * row.kb;
    }
  }

  std::size_t size() const { return rows_.size(); }                ///< contacts
  std::size_t body_count() const { return points_.body_count(); }  ///< bodies, walls included
  /// The operator of the points alone.
  const BodyDelassus<S>& points() const { return points_; }
  /// What a couple / R is to be multiplied by [m].
  Scalar radius(std::size_t c) const { return rows_[c].radius; }

  /// W of contact c in its frame [1/kg].
  const RollingBlock<S>& block(std::size_t c) const { return rows_[c].block; }
  /// The two bodies of a contact, a and b.
  std::array<std::uint32_t, 2> bodies(std::size_t c) const { return points_.bodies(c); }
  /// (Velocity, R spin) of b against a at contact c without impulses, with the law's offset, in the
  /// frame [m/s].
  Vector free_velocity(std::size_t c) const {
    return joined(points_.free_velocity(c), rows_[c].free);
  }
  /// As BodyDelassus::offset_normal.
  void offset_normal(std::size_t c, Scalar offset) { points_.offset_normal(c, offset); }
  /// (Velocity, R spin) of b against a at contact c under the impulses applied, in the frame [m/s].
  Vector velocity(std::size_t c) const {
    const Row& row = rows_[c];
    const auto [a, b] = points_.bodies(c);
    return joined(points_.velocity(c),
                  row.free + row.kb.transpose() * spin_of(b) - row.ka.transpose() * spin_of(a));
  }
  /// The first component of velocity(c) [m/s].
  Scalar normal_velocity(std::size_t c) const { return points_.normal_velocity(c); }
  /// Adds (impulse, couple / R) on b and its opposite on a, in the frame [N s].
  void apply(std::size_t c, const Vector& impulse) {
    const Row& row = rows_[c];
    const auto [a, b] = points_.bodies(c);
    const typename S::Angular couple = impulse.template tail<S::angular_dim>();
    points_.apply(c, impulse.template head<S::dim>());
    points_.add_scaled_spin(b, row.kb * couple);
    points_.add_scaled_spin(a, -(row.ka * couple));
  }
  /// Takes back all impulses.
  void clear() { points_.clear(); }
  /// As BodyDelassus::scaled_velocity.
  auto scaled_velocity(std::size_t body) const { return points_.scaled_velocity(body); }

 private:
  struct Row {
    typename S::Inertia ka, kb;
    typename S::Angular free;
    RollingBlock<S> block;
    Scalar radius;
  };
  static Vector joined(const typename S::Vector& point, const typename S::Angular& spin) {
    Vector u;
    u << point, spin;
    return u;
  }
  typename S::Angular spin_of(std::size_t body) const {
    return points_.scaled_velocity(body).template tail<S::angular_dim>();
  }

  BodyDelassus<S> points_;
  std::vector<Row> rows_;
};

}  // namespace moreau
