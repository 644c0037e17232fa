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
//
// With couples a contact has A more rows, the relative spin times its effective radius R (rolling_block.hpp). With
// springs in series (law/compliant.hpp) the operator is W + D with a diagonal matrix D, the compliance of the springs
// over the square of the time step.
//
// A periodic cell that moves by its stress is one more body that all contacts touch (detail/operator_cell.hpp).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/contact_islands.hpp"
#include "moreau/contact/contact_pairs.hpp"
#include "moreau/contact/detail/operator_cell.hpp"
#include "moreau/contact/detail/operator_frames.hpp"
#include "moreau/contact/detail/operator_point.hpp"
#include "moreau/contact/detail/point_assembly.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/parallel/team.hpp"
#include "moreau/simd/prefetch.hpp"

namespace moreau {

/// The operator of a set of contacts.
/// @tparam Couples whether a contact has D + A rows, (velocity, R spin) and (impulse, couple / R), or D
/// @tparam Springs whether springs are in series with the contacts
template <class S, bool Couples = false, bool Springs = false>
class BodyDelassus {
 public:
  using Space = S;
  using Scalar = typename S::Scalar;
  /// W_cc.
  using Block = typename detail::OperatorPoint<S, Couples>::Block;
  using Vector = typename Block::Vector;  ///< the rows of a contact
  using Matrix = typename detail::OperatorPoint<S, Couples>::Matrix;
  /// Generalized velocity padded to whole SIMD lanes; the padding stays zero.
  static constexpr int width = (S::dofs + 3) / 4 * 4;
  using PaddedTwist = Eigen::Matrix<Scalar, width, 1>;

  /// Computes blocks and free relative velocities; without any impulse.
  /// @param contacts bodies, frames and levers. The operator turns the tangents of their frames so that W_cc is a
  ///                 LocalBlock; its own vectors and those of its arguments are in the turned frames, frame(c)
  /// @param roots    M^-1/2 of every body
  /// @param free     velocity of every body without contacts, (v, w) in world axes [m/s, rad/s]
  /// @param compliance of the springs in series with the contacts, the diagonal of D [1/kg]: one row per
  ///                 contact, normal first. The entries of the tangents must be equal, because the tangents
  ///                 are turned, and those of the couple / R. Empty without springs
  /// @param team     threads that share the work
  void assemble(std::span<const Contact<S>> contacts, std::span<const MobilityRoot<S>> roots,
                std::span<const typename S::Twist> free, std::span<const Vector> compliance = {},
                const Team& team = {}) {
    points_.resize(contacts.size());
    heads_.resize(contacts.size());
    frames_.resize(contacts.size());
    islands_.forget();
    masses_.resize(roots.size());
    changes_.assign(roots.size(), PaddedTwist::Zero());
    cell_.forget();
    springs_.assign(compliance);
    freedoms_.resize(roots.size());
    team.share_each(roots.size(), 128, [&](std::size_t i) {
      masses_[i] = InverseMass<S>(roots[i]);
      freedoms_[i] = masses_[i].rotates() ? 2 : masses_[i].moves();
    });
    const detail::PointAssembly<S, Couples, Springs> assembly{contacts, masses_, free,   springs_,
                                                              points_,  heads_,  frames_};
    longest_lever_ = assembly.assemble(team);
    if constexpr (Couples) assembly.assemble_couples(roots, team);
    pairs_.list(contacts.size(), [this](std::size_t c) { return heads_[c].bodies; });
  }

  /// The numbers of point(c), in their order in memory; without couples.
  using PointNumbers = detail::PointNumbers<S>;
  /// The data of a contact, for passes that read all of them.
  const detail::OperatorPoint<S, Couples>& point(std::size_t c) const { return points_[c]; }
  std::size_t size() const { return points_.size(); }        ///< contacts
  std::size_t body_count() const { return masses_.size(); }  ///< bodies, walls included

  /// W_cc + D_cc in frame(c) [1/kg].
  const Block& block(std::size_t c) const { return points_[c].block; }
  /// w_nn of a contact, with the compliance of its normal spring [1/kg].
  Scalar normal(std::size_t c) const {
    if constexpr (Couples)
      return points_[c].block.point.normal;
    else
      return points_[c].block.normal;
  }
  /// Diagonal of D of a contact [1/kg].
  const Vector& compliance(std::size_t c) const requires Springs { return springs_.compliance[c]; }
  /// R of a contact [m].
  Scalar radius(std::size_t c) const requires Couples { return points_[c].radius; }
  /// The two bodies of a contact, a and b.
  std::array<std::uint32_t, 2> bodies(std::size_t c) const { return heads_[c].bodies; }
  /// Frame of a contact in the operator, columns n, t[, s], world axes. In the plane that of the Contact; in space
  /// the tangents are turned, see LocalBlock.
  const typename S::Matrix& frame(std::size_t c) const { return points_[c].frame; }
  /// From the centre of body a to the contact point, world axes [m].
  const typename S::Vector& lever_a(std::size_t c) const { return points_[c].lever_a; }
  /// From the centre of body b to the contact point, world axes [m].
  const typename S::Vector& lever_b(std::size_t c) const { return points_[c].lever_b; }
  /// The pairs of bodies of the contacts.
  const detail::ContactPairs& pairs() const { return pairs_; }
  /// The small islands of the contacts. The first call after assemble() finds them.
  const detail::ContactIslands& islands() {
    islands_.find_once(*this);
    return islands_;
  }
  /// M^-1 of a body.
  const InverseMass<S>& inverse_mass(std::size_t body) const { return masses_[body]; }
  /// For each body: 0 if no impulse moves it, 1 if impulses move it, 2 if they rotate it as well.
  std::span<const unsigned char> freedoms() const { return freedoms_; }
  /// The longest lever of a body that impulses rotate [m].
  Scalar longest_lever() const { return longest_lever_; }
  /// M^-1 of all bodies.
  std::span<const InverseMass<S>> inverse_masses() const { return masses_; }
  /// Trace of W_cc + D_cc [1/kg].
  Scalar trace(std::size_t c) const { return heads_[c].trace; }
  /// The part of W_cc that belongs to body a: the change of the velocity of a at c by the impulse at c [1/kg].
  Matrix block_of_a(std::size_t c) const {
    return points_[c].block_of(points_[c].lever_a, masses_[points_[c].a]);
  }
  /// The part of W_cc that belongs to body b.
  Matrix block_of_b(std::size_t c) const {
    return points_[c].block_of(points_[c].lever_b, masses_[points_[c].b]);
  }
  /// Relative velocity b without any impulse, with all offsets, in frame(c) [m/s].
  const Vector& free_velocity(std::size_t c) const { return points_[c].free; }
  /// Adds to the free normal velocity of a contact, > 0 separates [m/s].
  void offset_normal(std::size_t c, Scalar offset) { points_[c].free[0] += offset; }
  /// Adds to the free velocity of a contact, in frame(c) [m/s].
  void offset(std::size_t c, const Vector& offset) { points_[c].free += offset; }

  /// Relative velocity u under the impulses applied so far, in frame(c) [m/s]; u_n > 0 separates. With springs it has
  /// D_cc r_c.
  Vector velocity(std::size_t c) const {
    Vector u = velocity_of_bodies(c);
    if constexpr (Springs) u += springs_.stretches[c];
    return u;
  }
  /// The same without D_cc r_c.
  Vector velocity_of_bodies(std::size_t c) const {
    const Point& point = points_[c];
    const typename S::Vector change =
        detail::inlined_transposed_product(point.frame, change_between(point));
    Vector u;
    for (int k = 0; k < S::dim; ++k) u[k] = point.free[k] + change[k];
    if constexpr (Couples) {
      const typename S::Angular free = angular<S>(point.free),
                                spin = angular<S>(velocity_change(point.b)) -
                                       angular<S>(velocity_change(point.a));
      angular<S>(u) = free + point.axes.transpose() * spin;
    }
    return u;
  }
  /// The normal component of velocity(c) alone [m/s].
  Scalar normal_velocity(std::size_t c) const {
    const Scalar u = points_[c].free[0] + points_[c].frame.col(0).dot(change_between(points_[c]));
    if constexpr (Springs)
      return u + springs_.stretches[c][0];
    else
      return u;
  }
  /// Applies an impulse, in frame(c), to b, its opposite to a, and to the springs [N s].
  void apply(std::size_t c, const Vector& impulse) {
    apply_to_bodies(c, impulse);
    springs_.stretch(c, impulse);
    if (cell_.exists()) cell_.push(points_[c], impulse);
  }
  /// The same without the springs.
  void apply_to_bodies(std::size_t c, const Vector& impulse) {
    const Point& point = points_[c];
    const typename S::Vector push = point.push_of(impulse), opposite = -push;
    masses_[point.b].add_change(changes_[point.b], push, S::moment(point.lever_b, push));
    masses_[point.a].add_change(changes_[point.a], opposite, S::moment(point.lever_a, opposite));
    if constexpr (Couples) {
      const typename S::Angular couple = point.couple_of(impulse);
      angular<S>(changes_[point.b]) += masses_[point.b].spin_of(couple);
      angular<S>(changes_[point.a]) += masses_[point.a].spin_of(-couple);
    }
  }

  /// @name Frames of the contacts and rows of the operator
  /// The tangents of frame(c) are turned against those of the Contact. The row of a couple is couple / R.
  /// @{

  /// Makes rows of vectors in the frames of the contacts, such as Contacts::impulses.
  /// @param rows in: in the frames of the contacts, with couples; out: rows
  void to_rows(std::span<Vector> rows, const Team& team = {}) const {
    frames_.to_rows(rows, points_, team);
  }
  /// Makes vectors in the frames of the contacts of rows.
  /// @param impulses out: in the frames of the contacts, with couples
  void from_rows(std::span<const Vector> rows, std::span<Vector> impulses,
                 const Team& team = {}) const {
    frames_.from_rows(rows, impulses, points_, team);
  }
  /// A vector in the frame of a Contact, in frame(c).
  typename S::Vector turned(std::size_t c, const typename S::Vector& vector) const {
    return frames_.turned(c, vector, false);
  }
  /// A vector in frame(c), in the frame of the Contact.
  typename S::Vector turned_back(std::size_t c, const typename S::Vector& vector) const {
    return frames_.turned(c, vector, true);
  }
  /// The row of contact c of relative velocities of its bodies.
  /// @param velocity of the point, in the frame of the Contact [m/s]
  /// @param spin     w_b - w_a, world axes; without couples it does not count [rad/s]
  MOREAU_INLINED Vector row(std::size_t c, const typename S::Vector& velocity,
                            [[maybe_unused]] const typename S::Angular& spin) const {
    const typename S::Vector along = turned(c, velocity);
    Vector row;
    for (int k = 0; k < S::dim; ++k) row[k] = along[k];
    if constexpr (Couples)
      angular<S>(row) = radius(c) * (S::angular_frame(frame(c)).transpose() * spin);
    return row;
  }
  /// @}

  /// @name All impulses at once
  /// Momenta are added up for each body, and then divided by its mass, which takes less time than
  /// apply() for every contact. Between clear() and move() only these functions may be called.
  /// @{

  /// Removes all impulses: every body has its free velocity.
  void clear() {
    changes_.assign(changes_.size(), PaddedTwist::Zero());
    springs_.clear();
  }
  /// Gives both bodies the momentum of an impulse at contact c, in frame(c) [N s], and stretches its springs.
  void push(std::size_t c, const Vector& impulse) {
    const auto momentum = points_[c].momentum_of(impulse);
    momentum.give(changes_[points_[c].b]);
    momentum.take_from(changes_[points_[c].a]);
    springs_.stretch(c, impulse);
  }
  /// Makes velocities of the momenta.
  void move(const Team& team = {}) {
    team.share_each(changes_.size(), 256, [&](std::size_t i) {
      const typename S::Vector momentum = linear<S>(changes_[i]);
      const typename S::Angular spin = angular<S>(changes_[i]);
      linear<S>(changes_[i]) = masses_[i].velocity_of(momentum);
      angular<S>(changes_[i]) = masses_[i].spin_of(spin);
    });
  }
  /// @}

  /// @name A periodic cell that moves by its stress
  /// @{

  /// Adds the cell, with Lambda = 0. W_cc becomes the block of a contact that is solved together with all others: as
  /// if it had a share |d| / sum of |d| of the mass of the cell. With this block, sweeps converge that change Lambda
  /// after all contacts.
  /// @param response R [1/(kg m^2)]
  void add_cell(const typename S::Matrix& response) { cell_.start(response, std::span(points_)); }
  /// Removes the cell, with its velocities.
  void remove_cell() { cell_.stop(std::span(points_)); }
  bool has_cell() const { return cell_.exists(); }  ///< whether add_cell() has been called
  /// R of the cell [1/(kg m^2)].
  const typename S::Matrix& cell_response() const { return cell_.response(); }
  /// Lambda, by the impulses applied so far [1/s].
  const typename S::Matrix& cell_change() const { return cell_.change(); }
  /// Sets Lambda by all impulses, after move(); nothing without a cell.
  MOREAU_COMPILED_ONCE void move_cell(std::span<const Vector> impulses) {
    if (cell_.exists()) cell_.push_all(std::span<const Point>(points_), impulses);
  }
  /// @}

  /// Sets the velocities of all bodies by impulses that the caller has added up, and those of springs and cell.
  /// @param change_of function: body -> change of its velocity by the impulses, entries (v, w) in world axes [m/s, rad/s]
  void set_changes(std::span<const Vector> impulses, const auto& change_of, const Team& team) {
    team.share_each(changes_.size(), 256, [&](std::size_t i) {
      const auto& change = change_of(i);
      for (int k = 0; k < S::dofs; ++k) changes_[i][k] = change[std::size_t(k)];
    });
    if constexpr (Springs) {
      springs_.clear();
      team.share_each(impulses.size(), 256,
                      [&](std::size_t c) { springs_.stretch(c, impulses[c]); });
    }
    move_cell(impulses);
  }
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

 private:
  using Point = detail::OperatorPoint<S, Couples>;
  /// Change of the relative velocity by the impulses, world axes [m/s].
  typename S::Vector change_between(const Point& point) const {
    typename S::Vector difference = detail::relative_velocity_at<S>(
        changes_[point.a], point.lever_a, changes_[point.b], point.lever_b);
    if (cell_.exists()) cell_.add_velocity(point, difference);
    return difference;
  }

  List<Point> points_;
  List<detail::OperatorHead<Scalar>> heads_;
  detail::OperatorFrames<S, Couples> frames_;
  detail::ContactPairs pairs_;
  detail::ContactIslands islands_;
  List<InverseMass<S>> masses_;
  List<unsigned char> freedoms_;
  Scalar longest_lever_ = 0;
  List<PaddedTwist> changes_;
  detail::OperatorCell<S> cell_;
  [[no_unique_address]] detail::SpringRows<Vector, Springs> springs_;
};

}  // namespace moreau
