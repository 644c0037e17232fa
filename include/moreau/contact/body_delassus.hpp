// SPDX-License-Identifier: MIT
// The Delassus operator W = J M^-1 J^T of a set of contacts. The matrix is not formed. A contact c has
// its frame F and the levers l_a, l_b; each body has the change v, w of its velocity by impulses. Then
//
//     u_c = b_c + F^T (v_b + w_b x l_b - v_a - w_a x l_a),
//     an impulse dr at c, p = F dr:   v_b += p / m_b,   w_b += I_b^-1 (l_b x p),   v_a, w_a with -p,
//     W_cc = sum over both bodies of F^T (1/m + lever(l) I^-1 lever(l)^T) F,
//
// so that one sweep is one pass over the contacts. An axis along which a body cannot move has a zero in
// M^-1; the prescribed velocity is in the free velocity.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/body/mobility.hpp"
#include "moreau/contact/contact.hpp"
#include "moreau/contact/detail/contact_lanes.hpp"
#include "moreau/contact/local_block.hpp"
#include "moreau/core/detail/compiled_once.hpp"
#include "moreau/core/detail/prefetch.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/team.hpp"
#include "moreau/core/twist.hpp"

namespace moreau {

namespace detail {

/// In place of a function that returns the compliance of a contact: all contacts are rigid.
struct RigidContacts {};

}  // namespace detail

/// The operator of contacts at points, without couples.
template <class S>
class BodyDelassus {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  /// Generalized velocity padded to whole SIMD lanes; the padding stays zero.
  static constexpr int width = (S::dofs + 3) / 4 * 4;
  using PaddedTwist = Eigen::Matrix<Scalar, width, 1>;

  /// Computes blocks and free relative velocities; without any impulse.
  /// @param contacts in: bodies, frames, levers; out: frames with turned tangents, see LocalBlock
  /// @param roots    M^-1/2 of every body
  /// @param free     velocity of every body without contacts, (v, w) in world axes [m/s, rad/s]
  /// @param compliance function: contact c -> compliance of the springs in series with it, which is
  ///                 added to the diagonal of W_cc: D entries, normal first [1/kg]. The entries of
  ///                 the tangents must be equal, because the tangents are turned. Without this
  ///                 argument the contacts are rigid.
  /// @param team     threads that share the work
  template <class Compliance = detail::RigidContacts>
  void assemble(std::span<Contact<S>> contacts, std::span<const MobilityRoot<S>> roots,
                std::span<const typename S::Twist> free, const Compliance& compliance = {},
                const Team& team = {}) {
    points_.resize(contacts.size());
    heads_.resize(contacts.size());
    masses_.resize(roots.size());
    changes_.assign(roots.size(), PaddedTwist::Zero());
    team.share_each(roots.size(), 128,
                    [&](std::size_t i) { masses_[i] = InverseMass<S>(roots[i]); });
    team.share(contacts.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; c += Lanes::lanes)
        assemble_some(c, std::min(end, c + Lanes::lanes), contacts, free, compliance);
    });
  }

  std::size_t size() const { return points_.size(); }        ///< contacts
  std::size_t body_count() const { return masses_.size(); }  ///< bodies, walls included

  /// W_cc in the contact's frame [1/kg].
  const LocalBlock<S>& block(std::size_t c) const { return points_[c].block; }
  /// The two bodies of a contact, a and b.
  std::array<std::uint32_t, 2> bodies(std::size_t c) const { return heads_[c].bodies; }
  /// Frame of a contact as assemble() left it, columns n, t[, s], world axes.
  const Matrix& frame(std::size_t c) const { return points_[c].frame; }
  /// From the centre of body a to the contact point, world axes [m].
  const Vector& lever_a(std::size_t c) const { return points_[c].lever_a; }
  /// From the centre of body b to the contact point, world axes [m].
  const Vector& lever_b(std::size_t c) const { return points_[c].lever_b; }
  /// M^-1 of a body.
  const InverseMass<S>& inverse_mass(std::size_t body) const { return masses_[body]; }
  /// Trace of W_cc [1/kg].
  Scalar trace(std::size_t c) const { return heads_[c].trace; }
  /// The part of W_cc that belongs to body a: what the impulse at c does to the velocity of a, D x D
  /// [1/kg].
  Matrix block_of_a(std::size_t c) const {
    const Point& point = points_[c];
    return block_of(point.frame, point.lever_a, masses_[point.a]);
  }
  /// The part of W_cc that belongs to body b.
  Matrix block_of_b(std::size_t c) const {
    const Point& point = points_[c];
    return block_of(point.frame, point.lever_b, masses_[point.b]);
  }
  /// Relative velocity b without any impulse, with the offset of the law, in the contact's frame
  /// [m/s].
  const Vector& free_velocity(std::size_t c) const { return points_[c].free; }
  /// Adds to the free normal velocity of a contact, > 0 separates [m/s].
  void offset_normal(std::size_t c, Scalar offset) { points_[c].free[0] += offset; }
  /// Adds to the free velocity of a contact, in its frame [m/s].
  void offset(std::size_t c, const Vector& offset) { points_[c].free += offset; }

  /// Relative velocity u under the impulses applied so far, in the contact's frame [m/s]; u_n > 0
  /// separates.
  Vector velocity(std::size_t c) const {
    const Point& point = points_[c];
    Vector u = transposed_product(point.frame, change_between(point));
    for (int k = 0; k < S::dim; ++k) u[k] = point.free[k] + u[k];
    return u;
  }
  /// The normal component of velocity(c) alone [m/s].
  Scalar normal_velocity(std::size_t c) const {
    return points_[c].free[0] + points_[c].frame.col(0).dot(change_between(points_[c]));
  }
  /// Applies an impulse, in the contact's frame, to b and its opposite to a [N s].
  void apply(std::size_t c, const Vector& impulse) {
    const Point& point = points_[c];
    const Vector push = product(point.frame, impulse), opposite = -push;
    add_change(point.b, push, S::moment(point.lever_b, push));
    add_change(point.a, opposite, S::moment(point.lever_a, opposite));
  }
  /// Applies an angular impulse to a body [N m s], world axes.
  void apply_spin(std::size_t body, const typename S::Angular& impulse) {
    angular<S>(changes_[body]) += masses_[body].spin_of(impulse);
  }

  /// @name All impulses at once
  /// Momenta are added up for each body, and then divided by its mass, which takes less time than
  /// apply() for every contact. Between clear() and move() only these functions may be called.
  /// @{

  /// Removes all impulses: every body has its free velocity.
  void clear() { changes_.assign(changes_.size(), PaddedTwist::Zero()); }
  /// Gives both bodies the momentum of an impulse at contact c, in its frame [N s].
  void push(std::size_t c, const Vector& impulse) {
    const Momentum momentum = momentum_of(c, impulse);
    take(points_[c].b, momentum);
    give(points_[c].a, momentum);
  }
  /// Gives body a the momentum of an impulse, with the bits of push().
  void push_a(std::size_t c, const Vector& impulse) { give(points_[c].a, momentum_of(c, impulse)); }
  /// Gives body b the momentum of an impulse, with the bits of push().
  void push_b(std::size_t c, const Vector& impulse) { take(points_[c].b, momentum_of(c, impulse)); }
  /// Gives a body an angular momentum, world axes [N m s].
  void push_spin(std::size_t body, const typename S::Angular& impulse) {
    angular<S>(changes_[body]) += impulse;
  }
  /// Makes velocities of the momenta.
  void move(const Team& team = {}) {
    team.share_each(changes_.size(), 256, [&](std::size_t i) {
      const Vector momentum = linear<S>(changes_[i]);
      const typename S::Angular spin = angular<S>(changes_[i]);
      linear<S>(changes_[i]) = masses_[i].velocity_of(momentum);
      angular<S>(changes_[i]) = masses_[i].spin_of(spin);
    });
  }
  /// @}

  /// Change of the velocity of a body by the impulses, (v, w) in world axes [m/s, rad/s].
  auto velocity_change(std::size_t body) const { return changes_[body].template head<S::dofs>(); }
  /// The changes of all bodies, `width` numbers each; they may be changed, if every contact sees the
  /// same body move.
  std::span<Scalar> velocity_changes() {
    return {changes_.empty() ? nullptr : changes_[0].data(), changes_.size() * std::size_t(width)};
  }

  /// Begins to load some contacts into the cache.
  void prefetch(std::size_t first, std::size_t count) const {
    detail::prefetch(points_.data() + first, count * sizeof(Point));
  }

  /// u of a contact whose bodies have the velocities (v, w) [m/s, rad/s], in its frame [m/s].
  static Vector relative_velocity(const Contact<S>& contact, const typename S::Twist& a,
                                  const typename S::Twist& b) {
    Vector difference = point_velocity(b, contact.lever_b);
    difference -= point_velocity(a, contact.lever_a);
    return transposed_product(contact.frame, difference);
  }

 private:
  using Lanes = detail::ContactLanes<S>;
  struct Point {
    Matrix frame;
    Vector lever_a, lever_b;
    LocalBlock<S> block;
    Vector free;
    std::uint32_t a, b;
  };
  /// What passes over all contacts need that do not need the points: less memory to read.
  struct Head {
    std::array<std::uint32_t, 2> bodies;
    Scalar trace;
  };

  /// What an impulse at a contact gives body b, and takes from body a, world axes.
  struct Momentum {
    Vector push;                             // [N s]
    typename S::Angular moment_a, moment_b;  // about their centres [N m s]
  };
  /// One thread adds the momenta up contact by contact, several body by body.
  MOREAU_COMPILED_ONCE Momentum momentum_of(std::size_t c, const Vector& impulse) const {
    const Point& point = points_[c];
    const Vector push = product(point.frame, impulse);
    return {push, S::moment(point.lever_a, push), S::moment(point.lever_b, push)};
  }
  void give(std::uint32_t a, const Momentum& momentum) {
    linear<S>(changes_[a]) -= momentum.push;
    angular<S>(changes_[a]) -= momentum.moment_a;
  }
  void take(std::uint32_t b, const Momentum& momentum) {
    linear<S>(changes_[b]) += momentum.push;
    angular<S>(changes_[b]) += momentum.moment_b;
  }

  /// @param end at most as many contacts as there are lanes
  template <class Compliance>
  MOREAU_COMPILED_ONCE void assemble_some(std::size_t begin, std::size_t end,
                                          std::span<Contact<S>> contacts,
                                          std::span<const typename S::Twist> free,
                                          const Compliance& compliance) {
    Lanes some;
    for (std::size_t lane = 0; lane < Lanes::lanes; ++lane) {
      const std::size_t c = std::min(begin + lane, end - 1);
      const Contact<S>& contact = contacts[c];
      some.set_frame(lane, contact.frame);
      some.a.set(lane, contact.lever_a, masses_[contact.a], free[contact.a]);
      some.b.set(lane, contact.lever_b, masses_[contact.b], free[contact.b]);
      if constexpr (!std::same_as<Compliance, detail::RigidContacts>)
        for (std::size_t d = 0; d < S::dim; ++d)
          some.compliance[d][lane] = compliance(c)[Eigen::Index(d)];
    }
    some.assemble();
    for (std::size_t c = begin; c < end; ++c) {
      const std::size_t lane = c - begin;
      Contact<S>& contact = contacts[c];
      some.get_frame(lane, contact.frame);
      points_[c] = {contact.frame,    contact.lever_a,          contact.lever_b,
                    some.block(lane), some.free_velocity(lane), contact.a,
                    contact.b};
      heads_[c] = {{contact.a, contact.b}, some.trace(lane)};
    }
  }

  /// Velocity of a point of a body by unit impulses at the point along the axes of a frame, in the frame.
  static Matrix block_of(const Matrix& frame, const Vector& lever, const InverseMass<S>& mass) {
    Matrix block;
    for (int k = 0; k < S::dim; ++k) {
      const Vector push = frame.col(k);
      const Vector velocity =
          mass.velocity_of(push) + S::spin(mass.spin_of(S::moment(lever, push)), lever);
      block.col(k) = transposed_product(frame, velocity);
    }
    return block;
  }
  /// @param twist (v, w), or a longer vector that begins with it
  static Vector point_velocity(const auto& twist, const Vector& lever) {
    Vector velocity = S::spin(angular<S>(twist), lever);
    for (int k = 0; k < S::dim; ++k) velocity[k] = twist[k] + velocity[k];
    return velocity;
  }
  /// Change of the relative velocity by the impulses, world axes [m/s].
  Vector change_between(const Point& point) const {
    Vector difference = point_velocity(changes_[point.b], point.lever_b);
    difference -= point_velocity(changes_[point.a], point.lever_a);
    return difference;
  }
  void add_change(std::size_t body, const Vector& push, const typename S::Angular& moment) {
    linear<S>(changes_[body]) += masses_[body].velocity_of(push);
    angular<S>(changes_[body]) += masses_[body].spin_of(moment);
  }

  std::vector<Point> points_;
  std::vector<Head> heads_;
  std::vector<InverseMass<S>> masses_;
  std::vector<PaddedTwist> changes_;
};

}  // namespace moreau
