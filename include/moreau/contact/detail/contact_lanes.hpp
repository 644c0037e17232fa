// SPDX-License-Identifier: MIT
// W_cc, the turned tangents and the free velocities of several contacts, one per SIMD lane.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>

#include "moreau/contact/contact.hpp"
#include "moreau/contact/detail/operator_point.hpp"
#include "moreau/contact/relative_velocity.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/law/lane_block.hpp"
#include "moreau/law/local_block.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/simd/lane_algebra.hpp"
#include "moreau/simd/lane_rows.hpp"

namespace moreau::detail {

/// Contacts of the same step, one per lane.
template <class S>
class ContactLanes {
 public:
  using Lanes = typename LaneBlock<S>::Number;
  using Values = typename Lanes::Values;
  using Algebra = LaneAlgebra<S, Values>;
  using Vector = typename Algebra::Vector;
  static constexpr std::size_t lanes = Lanes::lanes, dim = S::dim, tangents = dim - 1;
  using T = typename S::Scalar;

  /// The data of one of the two bodies.
  struct Side {
    Vector lever;  ///< world axes [m]
    typename Algebra::template Symmetric<dim> linear;
    typename Algebra::template Symmetric<Algebra::angular> angular;
    std::array<Values, std::size_t{S::dofs}> velocity;  ///< without contacts

    /// @param masses,free of the body of each lane
    void set_bodies(const std::array<const InverseMass<S>*, lanes>& masses,
                    const std::array<const typename S::Twist*, lanes>& free) {
      static_assert(std::is_standard_layout_v<InverseMass<S>>);
      constexpr std::size_t linears = std::tuple_size_v<decltype(linear)>,
                            entries = linears + std::tuple_size_v<decltype(angular)>;
      static_assert(sizeof(InverseMass<S>) == entries * sizeof(T));
      std::array<const T*, lanes> rows;
      for (std::size_t l = 0; l < lanes; ++l) rows[l] = reinterpret_cast<const T*>(masses[l]);
      read_rows<Lanes, entries>(rows, [&](auto k) MOREAU_INLINED_LAMBDA -> Values& {
        if constexpr (k < linears)
          return linear[k];
        else
          return angular[k - linears];
      });
      for (std::size_t l = 0; l < lanes; ++l) rows[l] = free[l]->data();
      read_rows<Lanes, std::size_t{S::dofs}>(
          rows, [&](auto k) MOREAU_INLINED_LAMBDA -> Values& { return velocity[k]; });
    }
  };

  Side a, b;
  Vector compliance{};  ///< added to the diagonal of W_cc [1/kg]

  /// @param contacts of each lane
  void set_contacts(const std::array<const Contact<S>*, lanes>& contacts) {
    using C = Contact<S>;
    constexpr std::size_t begin = offsetof(C, frame) / sizeof(T), of_frame = dim * dim,
                          to_a = of_frame + dim, to_b = to_a + dim;
    static_assert(std::is_standard_layout_v<C> &&
                  offsetof(C, lever_a) == (begin + of_frame) * sizeof(T) &&
                  offsetof(C, lever_b) == (begin + to_a) * sizeof(T));
    std::array<const T*, lanes> rows;
    for (std::size_t l = 0; l < lanes; ++l)
      rows[l] = reinterpret_cast<const T*>(contacts[l]) + begin;
    read_rows<Lanes, to_b>(rows, [&](auto k) MOREAU_INLINED_LAMBDA -> Values& {
      if constexpr (k < of_frame)
        return axes_[k / dim][k % dim];
      else if constexpr (k < to_a)
        return a.lever[k - of_frame];
      else
        return b.lever[k - to_a];
    });
  }
  /// Computes the blocks, turns the tangents, and computes the free velocities.
  void assemble() {
    typename Algebra::template Symmetric<dim> w{};
    for (std::size_t d = 0; d < dim; ++d) w[Algebra::entry(d, d)] = compliance[d];
    add_inertia(a, w);
    add_inertia(b, w);
    aligned_ = aligned_block<S, Lanes>(w);
    make_regular();
    turn_tangents();
    const Vector apart =
        relative_velocity_of_lanes<Algebra>(a.velocity, a.lever, b.velocity, b.lever);
    for (std::size_t d = 0; d < dim; ++d) {
      free_[d] = axes_[d][0] * apart[0];
      for (std::size_t k = 1; k < dim; ++k) free_[d] += axes_[d][k] * apart[k];
    }
    // No impulse changes the normal velocity, as between a wall that moves along the tangent and a grain of
    // prescribed motion: the contact does not act.
    constexpr T never = std::numeric_limits<T>::infinity();
    free_[0] = w[0] == Values{} ? Lanes::broadcast(never) : free_[0];
    trace_ = aligned_.block.trace();
  }

  // Results of assemble().
  /// Takes the longest lever of a body that impulses rotate.
  /// @param longest in, out: its square in each lane [m^2]
  void find_longest_lever(Values& longest) const {
    for (const Side* side : {&a, &b}) {
      Values square = side->lever[0] * side->lever[0], turn{};
      for (std::size_t k = 1; k < dim; ++k) square += side->lever[k] * side->lever[k];
      for (std::size_t k = 0; k < Algebra::angular; ++k)
        turn += side->angular[Algebra::entry(k, k)];
      longest = ((turn > Values{}) & (square > longest)) ? square : longest;
    }
  }
  /// The largest lane.
  static T largest(const Values& values) {
    T largest = values[0];
    for (std::size_t l = 1; l < lanes; ++l) largest = values[l] > largest ? values[l] : largest;
    return largest;
  }
  /// Writes the frames, levers, blocks and free velocities.
  void write(const std::array<OperatorPoint<S, false>*, lanes>& points) const {
    using Numbers = PointNumbers<S>;
    using Member = typename Numbers::Member;
    std::array<T*, lanes> rows;
    for (std::size_t l = 0; l < lanes; ++l) rows[l] = Numbers::begin(*points[l]);
    write_rows<Lanes, Numbers::count>(rows, [&](auto k) MOREAU_INLINED_LAMBDA -> Values {
      constexpr auto place = Numbers::place(k);
      constexpr std::size_t i = place.index;
      if constexpr (place.member == Member::frame)
        return axes_[i / dim][i % dim];
      else if constexpr (place.member == Member::lever_a)
        return a.lever[i];
      else if constexpr (place.member == Member::lever_b)
        return b.lever[i];
      else if constexpr (place.member == Member::normal)
        return aligned_.block.normal;
      else if constexpr (place.member == Member::coupling)
        return aligned_.block.coupling[i];
      else if constexpr (place.member == Member::slip)
        return aligned_.block.slip[i];
      else if constexpr (place.member == Member::free)
        return free_[i];
      else {
        static_assert(place.member == Member::padding);
        return Values{};
      }
    });
  }
  void get_tangents(std::size_t lane, typename S::Matrix& frame) const {
    for (std::size_t d = 1; d < dim; ++d)
      for (std::size_t k = 0; k < dim; ++k)
        frame(Eigen::Index(k), Eigen::Index(d)) = axes_[d][k][lane];
  }
  /// By which the tangents have been turned.
  TangentTurn<S> turn(std::size_t lane) const {
    TangentTurn<S> turn;
    if constexpr (TangentTurn<S>::turns) {
      turn.cosine = aligned_.turn[0][0][lane];
      turn.sine = aligned_.turn[1][0][lane];
    }
    return turn;
  }
  LocalBlock<S> block(std::size_t lane) const { return aligned_.block[lane]; }
  typename S::Vector free_velocity(std::size_t lane) const {
    typename S::Vector free;
    for (std::size_t d = 0; d < dim; ++d) free[Eigen::Index(d)] = free_[d][lane];
    return free;
  }
  typename S::Scalar trace(std::size_t lane) const { return trace_[lane]; }

 private:
  /// Adds the part of W_cc that belongs to one body.
  void add_inertia(const Side& side, typename Algebra::template Symmetric<dim>& w) const {
    using Angular = std::array<Values, Algebra::angular>;
    std::array<Angular, dim> moments;
    for (std::size_t i = 0; i < dim; ++i) moments[i] = Algebra::moment(side.lever, axes_[i]);
    for (std::size_t i = 0; i < dim; ++i) {
      const Angular turn = Algebra::template product<Algebra::angular>(side.angular, moments[i]);
      for (std::size_t k = 0; k <= i; ++k)
        for (std::size_t d = 0; d < Algebra::angular; ++d)
          w[Algebra::entry(i, k)] += turn[d] * moments[k][d];
    }
    // F^T (1/m) F = 1/m, unless the mass differs along the axes. Each lane by itself: which contacts are in the other lanes
    // depends on the threads.
    const typename Lanes::Indices varies = varying(side.linear);
    for (std::size_t i = 0; i < dim; ++i)
      w[Algebra::entry(i, i)] += varies ? Values{} : side.linear[0];
    if (!Lanes::any(varies)) return;
    add_uneven_mass(side.linear, varies, w);
  }
  /// Adds F^T (1/m) F in some lanes. If the body cannot move along an axis of the frame, the entries of this axis are rounding
  /// errors, and are set to zero.
  void add_uneven_mass(const typename Algebra::template Symmetric<dim>& linear,
                       const typename Lanes::Indices& varies,
                       typename Algebra::template Symmetric<dim>& w) const {
    constexpr T rounding = 64 * std::numeric_limits<T>::epsilon();
    typename Algebra::template Symmetric<dim> turned{};
    Values least = linear[0];
    for (std::size_t i = 0; i < dim; ++i) {
      const Vector push = Algebra::template product<dim>(linear, axes_[i]);
      for (std::size_t k = 0; k <= i; ++k)
        for (std::size_t d = 0; d < dim; ++d) turned[Algebra::entry(i, k)] += push[d] * axes_[k][d];
      const Values& mass = linear[Algebra::entry(i, i)];
      least = mass > least ? mass : least;
    }
    least *= rounding;
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t k = 0; k <= i; ++k) {
        const typename Lanes::Indices counts = varies & (turned[Algebra::entry(i, i)] > least) &
                                               (turned[Algebra::entry(k, k)] > least);
        w[Algebra::entry(i, k)] += counts ? turned[Algebra::entry(i, k)] : Values{};
      }
  }
  /// Lanes in which a mass is not the same along all axes, as that of a wall that moves along its normal.
  static typename Lanes::Indices varying(const typename Algebra::template Symmetric<dim>& linear) {
    typename Lanes::Indices differs{};
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t k = 0; k <= i; ++k)
        differs |= linear[Algebra::entry(i, k)] != (i == k ? linear[0] : Values{});
    return differs;
  }
  /// No impulse changes the tangential velocity of a wall with a mass and a grain of prescribed motion:
  /// the slip of W_cc is zero. The local solution divides by it. Any positive value leaves the solution
  /// of the contact problem as it is, because each visit of a contact subtracts W_cc r before it solves
  /// with the same W_cc. The slip of other contacts is of the order of w_nn.
  void make_regular() {
    constexpr T rounding = 64 * std::numeric_limits<T>::epsilon();
    const Values& normal = aligned_.block.normal;
    for (Values& slip : aligned_.block.slip) slip = slip <= rounding * normal ? normal : slip;
  }
  void turn_tangents() {
    std::array<Vector, tangents> turned{};
    for (std::size_t t = 0; t < tangents; ++t)
      for (std::size_t s = 0; s < tangents; ++s)
        for (std::size_t k = 0; k < dim; ++k) turned[t][k] += axes_[1 + s][k] * aligned_.turn[s][t];
    for (std::size_t t = 0; t < tangents; ++t) axes_[1 + t] = turned[t];
  }

  std::array<Vector, dim> axes_;  // of the frame, in world axes
  AlignedBlock<S, Lanes> aligned_;
  Vector free_;
  Values trace_;
};

}  // namespace moreau::detail
