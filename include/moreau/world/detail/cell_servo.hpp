// SPDX-License-Identifier: MIT
// The rate of a periodic cell that moves by its stress, together with the contact problem.
//
// world/cell_control.hpp has the equation of the cell. Over a step of h, with M = m_ij V^(2/D) and the impulses r of the
// contacts, world axes,
//
//     L+ = L0 + sum over contacts of d_j r_i / (M (1 + h c)),
//     L0 = (M L + h (V sigma of the velocities - V sigma0)_ji) / (M (1 + h c)).
//
// The contact problem has the velocities F^T L+ d. Its operator does not know the cell. Therefore:
//
//   1. a few sweeps of the solver with the velocities of the present L+
//   2. L+ from their impulses, and again, until the residual of all together meets the tolerance of the solver.
//
// An impulse changes the velocity of its own contact by W_cc r, and that of all contacts by the cell. By the inequality
// of Cauchy and Schwarz the second change is at most g W_cc r, with the mean over the contacts
//
//     g = < |d|_1 sum of |d|_1 / (M (1 + h c) W_nn) >.
//
// In jammed grains, whose impulses do not change where a uniform stress does, k sweeps add up k impulses. The iteration
// is stable below k g = 2; k is the largest number with k g <= 1, at least 1 and at most 50. A cell with the mass of its
// grains has g of some hundredths. Of a lighter cell with g > 1 only a share 1/g of the change of L+ is applied.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/motion/bodies.hpp"
#include "moreau/world/cell_motion.hpp"

namespace moreau::detail {

/// The equation of the rate over a step; the head of this file has it.
template <class S>
class CellServo {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;

  /// Begins a step with the rate before it.
  MOREAU_COLD void start(const CellMotion<S>& cell, const Bodies<S>& bodies, Scalar step) {
    const CellControl<S>& control = cell.control();
    rate_ = free_ = cell.rate();
    response_.setZero();
    moves_ = !control.mass.isZero(0);
    if (!moves_) return;
    Matrix moment = Matrix::Zero();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (bodies.is_prescribed(i)) continue;
      const Vector p = bodies.velocity[i].template head<S::dim>();
      moment += bodies.grain_mass[i] * p * p.transpose();
    }
    const Scalar square = std::pow(cell.volume(), Scalar(2) / S::dim);
    for (int i = 0; i < S::dim; ++i)
      for (int j = 0; j < S::dim; ++j) {
        const Scalar mass = control.mass(i, j) * square;
        if (!(mass > 0)) continue;
        response_(i, j) = 1 / (mass * (1 + step * control.damping));
        const Scalar push = moment(j, i) - cell.volume() * control.stress(i, j);
        free_(i, j) = response_(i, j) * (mass * rate_(i, j) + step * push);
      }
  }
  bool moves() const { return moves_; }  ///< whether the stress moves the cell
  const Matrix& rate() const {
    return rate_;
  }  ///< L+, or L if the stress does not move the cell [1/s]
  /// How many sweeps of the solver one value of L+ has; sets the share of its changes that is applied.
  /// @param op operator of the contacts
  int sweeps(const auto& contacts, const auto& op) {
    Scalar sum = 0, gain = 0;
    for (const Contact<S>& contact : contacts.points) sum += length(contact);
    for (std::size_t c = 0; c < contacts.size(); ++c)
      gain += length(contacts.points[c]) / op.normal(c) / Scalar(contacts.size());
    gain *= sum * response_.maxCoeff();
    share_ = gain > 1 ? 1 / gain : Scalar(1);
    return gain > Scalar(0.02) ? std::max(1, int(1 / gain)) : 50;
  }
  /// Sets L+ by impulses.
  /// @param moment V sigma of the contacts times h [J s]
  void move(const Matrix& moment) {
    const Matrix next = free_ + response_.cwiseProduct(moment.transpose());
    rate_ += share_ * (next - rate_);
  }

 private:
  static Scalar length(const Contact<S>& contact) {
    return (contact.lever_a - contact.lever_b).template lpNorm<1>();
  }

  Matrix rate_ = Matrix::Zero(), free_ = Matrix::Zero(), response_ = Matrix::Zero();
  Scalar share_ = 1;
  bool moves_ = false;
};

}  // namespace moreau::detail
