// SPDX-License-Identifier: MIT
// The Delassus operator W = J M^-1 J^T of a set of contacts, never formed: each contact keeps its
// own rows of J M^-1/2, each body the change of its scaled velocity y = M^1/2 (V - V_free). Then
//
//     u_c = free_c + Jb y_b - Ja y_a        an impulse dr at c:  y_b += Jb^T dr,  y_a -= Ja^T dr
//     W_cc = Ja Ja^T + Jb Jb^T
//
// so that one sweep costs one pass over the contacts. A body that cannot move along some axis has a
// zero there in M^-1/2; its prescribed velocity stands in V_free.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/body/mobility.hpp"
#include "moreau/contact/contact.hpp"
#include "moreau/contact/local_block.hpp"

namespace moreau {

/// The operator for bodies that touch at points; model of what NonlinearGaussSeidel sweeps over.
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

  /// Builds the rows and blocks, and the free relative velocities; no impulse acts yet.
  /// @param contacts in: the points, frames, levers; out: the tangents turned, see LocalBlock
  /// @param roots    M^-1/2 of every body
  /// @param free     velocity every body would have without contacts, (v, w) in world axes
  ///                 [m/s, rad/s]; as many as roots
  void assemble(std::span<Contact<S>> contacts, std::span<const MobilityRoot<S>> roots,
                std::span<const typename S::Twist> free) {
    constexpr int tangents = S::dim - 1;
    rows_.resize(contacts.size());
    scaled_.assign(roots.size(), PaddedTwist::Zero());
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      Contact<S>& contact = contacts[c];
      Row& row = rows_[c];
      row.a = contact.a;
      row.b = contact.b;
      row.ja = scaled_rows(contact.frame, contact.lever_a, roots[contact.a]);
      row.jb = scaled_rows(contact.frame, contact.lever_b, roots[contact.b]);
      Eigen::Matrix<Scalar, tangents, tangents> turn;
      row.block = align_tangents<S>(gram(row), turn);
      turn_tangents(contact.frame, turn);
      turn_tangents(row.ja, turn);
      turn_tangents(row.jb, turn);
      row.free = relative_velocity(contact, free[contact.a], free[contact.b]);
    }
  }

  std::size_t size() const { return rows_.size(); }          ///< contacts
  std::size_t body_count() const { return scaled_.size(); }  ///< bodies, walls included

  /// W_cc in the contact's frame [1/kg].
  const LocalBlock<S>& block(std::size_t c) const { return rows_[c].block; }
  /// The two bodies of a contact, a and b.
  std::array<std::uint32_t, 2> bodies(std::size_t c) const { return {rows_[c].a, rows_[c].b}; }
  /// Scaled rows of a contact at its body a, (J M^-1/2)^T, width x D: a column for each axis of the
  /// frame [kg^-1/2]. What an impulse does to a is minus these times it.
  const PaddedRows& rows_a(std::size_t c) const { return rows_[c].ja; }
  /// The same of body b, to which the impulse does these times it.
  const PaddedRows& rows_b(std::size_t c) const { return rows_[c].jb; }
  /// Relative velocity without any impulse, with the law's offset, in the contact's frame [m/s].
  const Vector& free_velocity(std::size_t c) const { return rows_[c].free; }
  /// Adds to the free normal velocity of a contact, > 0 separates [m/s].
  void offset_normal(std::size_t c, Scalar offset) { rows_[c].free[0] += offset; }

  /// Relative velocity u of a contact under all impulses applied so far, in its frame; u_n > 0
  /// separates [m/s].
  Vector velocity(std::size_t c) const {
    const Row& row = rows_[c];
    return row.free + row.jb.transpose() * scaled_[row.b] - row.ja.transpose() * scaled_[row.a];
  }
  /// The normal component of velocity(c) alone [m/s].
  Scalar normal_velocity(std::size_t c) const {
    const Row& row = rows_[c];
    return row.free[0] + row.jb.col(0).dot(scaled_[row.b]) - row.ja.col(0).dot(scaled_[row.a]);
  }
  /// Applies an impulse, in the contact's frame, to b and its opposite to a [N s].
  void apply(std::size_t c, const Vector& impulse) {
    const Row& row = rows_[c];
    scaled_[row.b].noalias() += row.jb * impulse;
    scaled_[row.a].noalias() -= row.ja * impulse;
  }
  /// Adds to the scaled angular velocity of a body: what a couple does [kg^1/2 m/s].
  void add_scaled_spin(std::size_t body, const typename S::Angular& change) {
    scaled_[body].template segment<S::angular_dim>(S::dim) += change;
  }
  /// Undoes all impulses: every body back at its free velocity.
  void clear() { scaled_.assign(scaled_.size(), PaddedTwist::Zero()); }
  /// M^1/2 (V - V_free) of a body, D + A numbers, world axes [kg^1/2 m/s].
  auto scaled_velocity(std::size_t body) const { return scaled_[body].template head<S::dofs>(); }

  /// u of a contact between bodies of velocities (v, w) [m/s, rad/s], in the contact's frame [m/s].
  static Vector relative_velocity(const Contact<S>& contact, const typename S::Twist& a,
                                  const typename S::Twist& b) {
    return contact.frame.transpose() *
           (point_velocity(b, contact.lever_b) - point_velocity(a, contact.lever_a));
  }

 private:
  struct Row {
    PaddedRows ja, jb;
    LocalBlock<S> block;
    Vector free;
    std::uint32_t a, b;
  };

  static Vector point_velocity(const typename S::Twist& twist, const Vector& lever) {
    return twist.template head<S::dim>() + S::spin(twist.template tail<S::angular_dim>(), lever);
  }
  static PaddedRows scaled_rows(const typename S::Matrix& frame, const Vector& lever,
                                const MobilityRoot<S>& root) {
    PaddedRows rows = PaddedRows::Zero();
    for (int k = 0; k < S::dim; ++k) {
      const Vector axis = frame.col(k);
      const Vector push = root.linear * axis;
      const typename S::Angular turn = root.angular * S::moment(lever, axis);
      rows.col(k).template head<S::dim>() = push;
      rows.col(k).template segment<S::angular_dim>(S::dim) = turn;
    }
    return rows;
  }
  /// Ja Ja^T + Jb Jb^T.
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

  std::vector<Row> rows_;
  std::vector<PaddedTwist> scaled_;
};

}  // namespace moreau
