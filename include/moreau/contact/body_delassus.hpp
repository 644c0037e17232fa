// SPDX-License-Identifier: MIT
// The Delassus operator W = J M^-1 J^T of a set of contacts. The matrix is not formed. Each contact
// c keeps its scaled rows J_a M_a^-1/2 and J_b M_b^-1/2, written Ja and Jb; each body the change of
// its scaled velocity y = M^1/2 (V - V_free). Then
//
//     u_c = b_c + Jb y_b - Ja y_a,      an impulse dr at c:  y_b += Jb^T dr,  y_a -= Ja^T dr,
//     W_cc = Ja Ja^T + Jb Jb^T,
//
// so that one sweep is one pass over the contacts. An axis along which a body cannot move has a
// zero in M^-1/2; the prescribed velocity is in V_free.
#pragma once

#include <Eigen/Core>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "moreau/body/mobility.hpp"
#include "moreau/contact/contact.hpp"
#include "moreau/contact/local_block.hpp"
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
  /// Generalized velocity padded to whole SIMD lanes; the padding stays zero.
  static constexpr int width = (S::dofs + 3) / 4 * 4;
  using PaddedTwist = Eigen::Matrix<Scalar, width, 1>;
  using PaddedRows = Eigen::Matrix<Scalar, width, S::dim>;

  /// Computes rows, blocks and free relative velocities; without any impulse.
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
    rows_.resize(contacts.size());
    heads_.resize(contacts.size());
    scaled_.assign(roots.size(), PaddedTwist::Zero());
    contacts_ = contacts;
    roots_ = roots;
    team.share(contacts.size(), 64, [&](std::size_t begin, std::size_t end) {
      assemble_some(begin, end, contacts, roots, free, compliance);
    });
  }

  std::size_t size() const { return rows_.size(); }          ///< contacts
  std::size_t body_count() const { return scaled_.size(); }  ///< bodies, walls included

  /// W_cc in the contact's frame [1/kg].
  const LocalBlock<S>& block(std::size_t c) const { return rows_[c].block; }
  /// The two bodies of a contact, a and b.
  std::array<std::uint32_t, 2> bodies(std::size_t c) const { return heads_[c].bodies; }
  /// A contact as assemble() left it: in the array that assemble() was given, which must still exist.
  const Contact<S>& contact(std::size_t c) const { return contacts_[c]; }
  /// M^-1/2 of a body: in the array that assemble() was given, which must still exist.
  const MobilityRoot<S>& root(std::size_t body) const { return roots_[body]; }
  /// Trace of W_cc [1/kg].
  Scalar trace(std::size_t c) const { return heads_[c].trace; }
  /// Ja^T, padded: width x D, one column for each axis of the frame [kg^-1/2]. An impulse dr
  /// changes y_a by -Ja^T dr.
  const PaddedRows& rows_a(std::size_t c) const { return rows_[c].ja; }
  /// Jb^T, padded: an impulse dr changes y_b by Jb^T dr.
  const PaddedRows& rows_b(std::size_t c) const { return rows_[c].jb; }
  /// Relative velocity b without any impulse, with the offset of the law, in the contact's frame
  /// [m/s].
  const Vector& free_velocity(std::size_t c) const { return rows_[c].free; }
  /// Adds to the free normal velocity of a contact, > 0 separates [m/s].
  void offset_normal(std::size_t c, Scalar offset) { rows_[c].free[0] += offset; }
  /// Adds to the free velocity of a contact, in its frame [m/s].
  void offset(std::size_t c, const Vector& offset) { rows_[c].free += offset; }

  /// Relative velocity u under the impulses applied so far, in the contact's frame [m/s]; u_n > 0
  /// separates.
  Vector velocity(std::size_t c) const {
    const Row& row = rows_[c];
    Vector change = row.jb.transpose() * scaled_[row.b];
    const Vector opposite = row.ja.transpose() * scaled_[row.a];
    for (int k = 0; k < S::dim; ++k) change[k] = row.free[k] + change[k] - opposite[k];
    return change;
  }
  /// The normal component of velocity(c) alone [m/s].
  Scalar normal_velocity(std::size_t c) const {
    const Row& row = rows_[c];
    return row.free[0] + row.jb.col(0).dot(scaled_[row.b]) - row.ja.col(0).dot(scaled_[row.a]);
  }
  /// Applies an impulse, in the contact's frame, to b and its opposite to a [N s].
  void apply(std::size_t c, const Vector& impulse) {
    apply_to_b(c, impulse);
    apply_to_a(c, impulse);
  }
  /// Applies the part of apply() that concerns body a.
  void apply_to_a(std::size_t c, const Vector& impulse) {
    const Row& row = rows_[c];
    scaled_[row.a].noalias() -= row.ja * impulse;
  }
  /// Applies the part of apply() that concerns body b.
  void apply_to_b(std::size_t c, const Vector& impulse) {
    const Row& row = rows_[c];
    scaled_[row.b].noalias() += row.jb * impulse;
  }
  /// Adds the effect of a couple to the scaled angular velocity of a body [kg^1/2 m/s].
  void add_scaled_spin(std::size_t body, const typename S::Angular& change) {
    angular<S>(scaled_[body]) += change;
  }
  /// Removes all impulses: every body has its free velocity.
  void clear() { scaled_.assign(scaled_.size(), PaddedTwist::Zero()); }
  /// y = M^1/2 (V - V_free) of a body, D + A entries, world axes [kg^1/2 m/s].
  auto scaled_velocity(std::size_t body) const { return scaled_[body].template head<S::dofs>(); }
  /// The scaled velocities of all bodies, `width` numbers each; they may be changed, if every contact
  /// sees the same body move.
  std::span<Scalar> scaled_velocities() {
    return {scaled_.empty() ? nullptr : scaled_[0].data(), scaled_.size() * std::size_t(width)};
  }

  /// Begins to load the rows of some contacts into the cache.
  void prefetch(std::size_t first, std::size_t count) const {
    detail::prefetch(rows_.data() + first, count * sizeof(Row));
  }

  /// u of a contact whose bodies have the velocities (v, w) [m/s, rad/s], in its frame [m/s].
  static Vector relative_velocity(const Contact<S>& contact, const typename S::Twist& a,
                                  const typename S::Twist& b) {
    Vector difference = point_velocity(b, contact.lever_b);
    difference -= point_velocity(a, contact.lever_a);
    return transposed_product(contact.frame, difference);
  }

 private:
  struct Row {
    PaddedRows ja, jb;
    LocalBlock<S> block;
    Vector free;
    std::uint32_t a, b;
  };
  /// What passes over all contacts need that do not need the rows: less memory to read.
  struct Head {
    std::array<std::uint32_t, 2> bodies;
    Scalar trace;
  };

  template <class Compliance>
  void assemble_some(std::size_t begin, std::size_t end, std::span<Contact<S>> contacts,
                     std::span<const MobilityRoot<S>> roots,
                     std::span<const typename S::Twist> free, const Compliance& compliance) {
    constexpr int tangents = S::dim - 1;
    for (std::size_t c = begin; c < end; ++c) {
      Contact<S>& contact = contacts[c];
      Row& row = rows_[c];
      row.a = contact.a;
      row.b = contact.b;
      row.ja = scaled_rows(contact.frame, contact.lever_a, roots[contact.a]);
      row.jb = scaled_rows(contact.frame, contact.lever_b, roots[contact.b]);
      typename S::Matrix w = gram(row);
      if constexpr (!std::same_as<Compliance, detail::RigidContacts>) w.diagonal() += compliance(c);
      Eigen::Matrix<Scalar, tangents, tangents> turn;
      row.block = align_tangents<S>(w, turn);
      make_regular(row.block);
      turn_tangents(contact.frame, turn);
      turn_tangents(row.ja, turn);
      turn_tangents(row.jb, turn);
      row.free = relative_velocity(contact, free[contact.a], free[contact.b]);
      heads_[c] = {{row.a, row.b}, row.block.trace()};
    }
  }

  /// No impulse changes the tangential velocity of a wall with a mass and a grain of prescribed motion:
  /// the slip of W_cc is zero. The local solution divides by it. Any positive value leaves the solution
  /// of the contact problem as it is, because each visit of a contact subtracts W_cc r before it solves
  /// with the same W_cc. Of other contacts the slip is of the order of w_nn.
  static void make_regular(LocalBlock<S>& block) {
    constexpr Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon();
    for (auto& slip : block.slip)
      if (slip <= rounding * block.normal) slip = block.normal;
  }
  static Vector point_velocity(const typename S::Twist& twist, const Vector& lever) {
    Vector velocity = S::spin(angular<S>(twist), lever);
    for (int k = 0; k < S::dim; ++k) velocity[k] = twist[k] + velocity[k];
    return velocity;
  }
  static PaddedRows scaled_rows(const typename S::Matrix& frame, const Vector& lever,
                                const MobilityRoot<S>& root) {
    PaddedRows rows = PaddedRows::Zero();
    for (int k = 0; k < S::dim; ++k) {
      const Vector axis = frame.col(k);
      const Vector push = product(root.linear, axis);
      const typename S::Angular turn = product(root.angular, S::moment(lever, axis));
      auto row = rows.col(k);
      linear<S>(row) = push;
      angular<S>(row) = turn;
    }
    return rows;
  }
  /// W_cc = Ja Ja^T + Jb Jb^T.
  static typename S::Matrix gram(const Row& row) {
    typename S::Matrix w;
    for (int i = 0; i < S::dim; ++i)
      for (int k = 0; k <= i; ++k)
        w(i, k) = w(k, i) = row.ja.col(i).dot(row.ja.col(k)) + row.jb.col(i).dot(row.jb.col(k));
    return w;
  }
  /// Columns 1.. of m times a rotation.
  template <class Matrix, class Turn>
  static void turn_tangents(Matrix& m, const Turn& turn) {
    constexpr int tangents = Turn::RowsAtCompileTime;
    for (int k = 0; k < Matrix::RowsAtCompileTime; ++k) {
      Eigen::Matrix<Scalar, tangents, 1> turned = Eigen::Matrix<Scalar, tangents, 1>::Zero();
      for (int t = 0; t < tangents; ++t)
        for (int s = 0; s < tangents; ++s) turned[t] += m(k, 1 + s) * turn(s, t);
      for (int t = 0; t < tangents; ++t) m(k, 1 + t) = turned[t];
    }
  }

  std::span<const Contact<S>> contacts_;  // of the caller
  std::span<const MobilityRoot<S>> roots_;
  std::vector<Row> rows_;
  std::vector<Head> heads_;
  std::vector<PaddedTwist> scaled_;
};

}  // namespace moreau
