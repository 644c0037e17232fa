// SPDX-License-Identifier: MIT
// The terms that a periodic cell that deforms adds to a step; world/cell_control.hpp has the equations.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/parallel/team.hpp"

namespace moreau::detail {

/// The velocities of a deforming cell at the contacts of a step, and its work.
template <class S>
class CellJumps {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  using Twist = typename S::Twist;
  using Sum = Eigen::Matrix<double, S::dim, S::dim>;  ///< of many terms

  /// Adds -h L p to the free velocities of all bodies whose motion is not prescribed.
  /// @param rate L [1/s]
  /// @param step h [s]
  /// @param free in, out: one per body [m/s, rad/s]
  static void turn_velocities(const Bodies<S>& bodies, const Matrix& rate, Scalar step,
                              std::span<Twist> free, const Team& team) {
    team.share_each(free.size(), 256, [&](std::size_t i) {
      if (!bodies.is_prescribed(i)) turn_velocity(bodies.velocity[i], rate, step, free[i]);
    });
  }
  /// Computes the velocities of the cell at the contacts, F^T L d, and adds them to the free velocities of
  /// the operator.
  void add(const Matrix& rate, const DetectedContacts<S>& contacts, auto& op, const Team& team) {
    using Row = typename std::decay_t<decltype(op)>::Vector;
    jumps_.resize(contacts.size());
    team.share_each(contacts.size(), 256, [&](std::size_t c) {
      jumps_[c] = jump_at(contacts.points[c], rate);
      op.offset(c, row_of<Row>(op, c, jumps_[c]));
    });
  }
  /// Replaces the velocities of the cell by those of another rate.
  MOREAU_COLD void change(const Matrix& rate, const auto& contacts, auto& op) {
    using Row = typename std::decay_t<decltype(op)>::Vector;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Vector jump = jump_at(contacts.points[c], rate), change = jump - jumps_[c];
      op.offset(c, row_of<Row>(op, c, change));
      jumps_[c] = jump;
    }
  }
  /// Velocity of the cell at contact c, contact frame [m/s].
  const Vector& operator[](std::size_t c) const { return jumps_[c]; }

  /// The work of the cell in a step [J], by its velocities, not by the stress.
  /// @param bodies with the velocities before the step
  /// @param after  velocities after it, one per body
  /// @param rate   L before the step [1/s]
  /// @param next   L after it [1/s]
  static double work(const Bodies<S>& bodies, const auto& contacts, std::span<const Twist> after,
                     const Matrix& rate, const Matrix& next, Scalar step) {
    double sum = 0;
    Matrix between = rate;
    between += next;
    between /= 2;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      sum -= double(contacts.impulse(c).dot(jump_at(contacts.points[c], between)));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies.is_prescribed(i)) continue;
      const Vector p = linear<S>(bodies.velocity[i]), mean = (p + linear<S>(after[i])) / 2;
      sum -= double(step * bodies.grain_mass[i]) * double(mean.dot(product(rate, p)));
    }
    return sum;
  }
  /// V sigma of the contacts of a step [J], from impulses that may still be those of the solver. In double precision: the
  /// cell has many contacts.
  /// @param impulse function: contact -> impulse on b, contact frame [N s]
  static Sum moment_of_contacts(const auto& contacts, const auto& impulse, Scalar step) {
    Sum sum = Sum::Zero();
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const Contact<S>& contact = contacts.points[c];
      const Vector between = contact.lever_a - contact.lever_b,
                   force = product(contact.frame, Vector(impulse(c))) / step;
      add_product_transposed(sum, in_double(between), in_double(force));
    }
    return sum;
  }
  /// V sigma of a step [J].
  static Matrix moment(const Bodies<S>& bodies, const auto& contacts, std::span<const Twist> after,
                       Scalar step) {
    Sum sum = moment_of_contacts(
        contacts, [&](std::size_t c) { return contacts.impulse(c); }, step);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies.is_prescribed(i)) continue;
      const Vector p = linear<S>(bodies.velocity[i]), mean = (p + linear<S>(after[i])) / 2;
      add_product_transposed(sum, in_double(bodies.grain_mass[i] * p), in_double(mean));
    }
    return sum.template cast<Scalar>();
  }

 private:
  static Eigen::Matrix<double, S::dim, 1> in_double(const Vector& x) {
    return x.template cast<double>();
  }
  /// A velocity at a contact, in its frame, in the rows of the operator.
  template <class Row>
  static Row row_of(const auto& op, std::size_t c, const Vector& velocity) {
    const Vector turned = op.turned(c, velocity);
    Row row = Row::Zero();
    for (int k = 0; k < S::dim; ++k) row[k] = turned[k];
    return row;
  }
  MOREAU_INLINED static void turn_velocity(const Twist& velocity, const Matrix& rate, Scalar step,
                                           Twist& free) {
    const Vector p = linear<S>(velocity);
    linear<S>(free) -= step * product(rate, p);
  }
  MOREAU_COMPILED_ONCE static Vector jump_at(const Contact<S>& contact, const Matrix& rate) {
    const Vector between = contact.lever_a - contact.lever_b;
    return transposed_product(contact.frame, product(rate, between));
  }

  List<Vector> jumps_;  // one per contact
};

}  // namespace moreau::detail
