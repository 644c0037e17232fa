// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/effective_radius.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/law/local_block.hpp"
#include "moreau/law/rolling_block.hpp"
#include "moreau/motion/mobility.hpp"

namespace moreau::detail {

/// The data of the couple of a contact; nothing without couples.
template <class S, bool Couples>
struct CoupleArm {};
template <class S>
struct CoupleArm<S, true> {
  typename S::Inertia axes;   ///< R times the axes of rotation of the frame, world axes [m]
  typename S::Scalar radius;  ///< R [m]
};

/// D of the contacts with springs, and what their impulses have stretched; nothing without springs.
template <class Vector, bool Springs>
struct SpringRows {
  void assign(std::span<const Vector>) const {}
  void clear() const {}
  void stretch(std::size_t, const Vector&) const {}
};
template <class Vector>
struct SpringRows<Vector, true> {
  List<Vector> compliance;  ///< diagonal of D_cc [1/kg]
  List<Vector> stretches;   ///< D_cc r_c [m/s]

  /// Sets D; without stretches.
  void assign(std::span<const Vector> diagonals) {
    compliance.assign(diagonals.begin(), diagonals.end());
    clear();
  }
  void clear() { stretches.assign(compliance.size(), Vector::Zero()); }
  void stretch(std::size_t c, const Vector& impulse) {
    add_stretch(stretches[c], compliance[c], impulse);
  }

 private:
  MOREAU_COMPILED_ONCE static void add_stretch(Vector& stretch, const Vector& compliance,
                                               const Vector& impulse) {
    stretch += compliance.cwiseProduct(impulse);
  }
};

/// The data that BodyDelassus stores of a contact.
template <class S, bool Couples>
struct OperatorPoint : CoupleArm<S, Couples> {
  using Block = std::conditional_t<Couples, RollingBlock<S>, LocalBlock<S>>;  ///< W_cc
  using Vector = typename Block::Vector;
  using Matrix =
      Eigen::Matrix<typename S::Scalar, Vector::RowsAtCompileTime, Vector::RowsAtCompileTime>;

  typename S::Matrix frame;             ///< columns n, t[, s], world axes
  typename S::Vector lever_a, lever_b;  ///< from the centres to the point, world axes [m]
  Block block;                          ///< W_cc + D_cc [1/kg]
  Vector free;                          ///< b, with the offset of the law [m/s]
  std::uint32_t a, b;                   ///< the bodies

  /// The momentum that an impulse at the contact gives body b, and takes from body a, world axes.
  struct Momentum {
    typename S::Vector push;  ///< [N s]
    /// About their centres [N m s]; couple: with couples.
    typename S::Angular moment_a, moment_b, couple;

    /// Adds it to that of body b.
    void give(auto& momentum_b) const {
      linear<S>(momentum_b) += push;
      angular<S>(momentum_b) += moment_b;
      if constexpr (Couples) angular<S>(momentum_b) += couple;
    }
    /// Subtracts it from that of body a.
    void take_from(auto& momentum_a) const {
      linear<S>(momentum_a) -= push;
      angular<S>(momentum_a) -= moment_a;
      if constexpr (Couples) angular<S>(momentum_a) -= couple;
    }
  };
  /// One thread adds the momenta up contact by contact, several body by body.
  MOREAU_COMPILED_ONCE Momentum momentum_of(const Vector& impulse) const {
    Momentum momentum;
    momentum.push = push_of(impulse);
    momentum.moment_a = S::moment(lever_a, momentum.push);
    momentum.moment_b = S::moment(lever_b, momentum.push);
    if constexpr (Couples) momentum.couple = couple_of(impulse);
    return momentum;
  }
  /// The impulse on b at the point, world axes [N s].
  typename S::Vector push_of(const Vector& impulse) const {
    if constexpr (Couples)
      return inlined_product(frame, typename S::Vector(linear<S>(impulse)));
    else
      return inlined_product(frame, impulse);
  }
  /// The couple of an impulse on b, world axes [N m s].
  typename S::Angular couple_of(const Vector& impulse) const requires Couples {
    return this->axes * angular<S>(impulse);
  }
  /// Computes the rows of the couple, after those of the point.
  void assemble_couple(const Contact<S>& contact, std::span<const MobilityRoot<S>> roots,
                       const InverseMass<S>& mass_a, const InverseMass<S>& mass_b,
                       std::span<const typename S::Twist> velocities) requires Couples {
    const auto is_round = [&](std::uint32_t body) {
      return roots[body].grain || !roots[body].angular.isZero(0);
    };
    this->radius = effective_radius(contact, is_round(contact.a), is_round(contact.b));
    this->axes = this->radius * S::angular_frame(frame);
    angular<S>(free) = this->axes.transpose() *
                       (angular<S>(velocities[contact.b]) - angular<S>(velocities[contact.a]));
    for (int k = 0; k < S::angular_dim; ++k) {
      const typename S::Angular spin_a = mass_a.spin_of(this->axes.col(k)),
                                spin_b = mass_b.spin_of(this->axes.col(k));
      block.spin.col(k) = this->axes.transpose() * (spin_a + spin_b);
      block.cross.col(k) =
          frame.transpose() * (S::spin(spin_a, lever_a) + S::spin(spin_b, lever_b));
    }
  }
  /// The part of W_cc that belongs to a body: its rows by unit impulses at the point along the axes of the frame, and
  /// by unit couples / R.
  /// @param lever lever_a or lever_b
  /// @param mass  of that body
  Matrix block_of(const typename S::Vector& lever, const InverseMass<S>& mass) const {
    Matrix part;
    const auto set_column = [&](int k, const typename S::Vector& centre,
                                const typename S::Angular& spin) {
      const typename S::Vector velocity = centre + S::spin(spin, lever);
      part.col(k).template head<S::dim>() = transposed_product(frame, velocity);
      if constexpr (Couples)
        part.col(k).template tail<S::angular_dim>() = this->axes.transpose() * spin;
    };
    for (int k = 0; k < S::dim; ++k) {
      const typename S::Vector push = frame.col(k);
      set_column(k, mass.velocity_of(push), mass.spin_of(S::moment(lever, push)));
    }
    if constexpr (Couples)
      for (int k = 0; k < S::angular_dim; ++k)
        set_column(S::dim + k, S::Vector::Zero(), mass.spin_of(this->axes.col(k)));
    return part;
  }
};

/// Bodies and trace of the block of a contact. They are stored separately: passes that need only these read less memory than
/// if they read OperatorPoint.
template <class T>
struct OperatorHead {
  std::array<std::uint32_t, 2> bodies;
  T trace;  ///< of W_cc + D_cc [1/kg]
};

/// The numbers of an OperatorPoint without couples, from the first to those of `free`, as they lie in memory: for SIMD
/// code that reads or writes all of them.
template <class S>
struct PointNumbers {
  using Point = OperatorPoint<S, false>;
  using T = typename S::Scalar;
  enum class Member { frame, lever_a, lever_b, normal, coupling, slip, free, padding };
  /// The frame is stored column after column.
  struct Place {
    Member member;
    std::size_t index;  ///< in the member
  };
  static_assert(std::is_standard_layout_v<Point>);
  /// How many, padding included.
  static constexpr std::size_t count =
      (offsetof(Point, free) + sizeof(typename Point::Vector)) / sizeof(T);

  static const T* begin(const Point& point) { return reinterpret_cast<const T*>(&point); }
  static T* begin(Point& point) { return reinterpret_cast<T*>(&point); }
  /// Where number k belongs.
  static constexpr Place place(std::size_t k) {
    using Block = typename Point::Block;
    constexpr std::size_t dim = S::dim, block = offsetof(Point, block);
    struct Range {
      Member member;
      std::size_t first, entries;
    };
    constexpr Range ranges[] = {
        {Member::frame, offsetof(Point, frame), dim * dim},
        {Member::lever_a, offsetof(Point, lever_a), dim},
        {Member::lever_b, offsetof(Point, lever_b), dim},
        {Member::normal, block + offsetof(Block, normal), 1},
        {Member::coupling, block + offsetof(Block, coupling), dim - 1},
        {Member::slip, block + offsetof(Block, slip), dim - 1},
        {Member::free, offsetof(Point, free), dim},
    };
    for (const Range& range : ranges)
      if (k * sizeof(T) >= range.first && k * sizeof(T) < range.first + range.entries * sizeof(T))
        return {range.member, k - range.first / sizeof(T)};
    return {Member::padding, 0};
  }
};

}  // namespace moreau::detail
