// SPDX-License-Identifier: MIT
// The rate of a periodic cell that moves by its stress, together with the contact problem.
//
// world/cell_control.hpp has the equation of the cell. Over a step of h, with M = m_ij V^(2/D) and the impulses r of the
// contacts, world axes,
//
//     L+ = L0 + sum over contacts of d_j r_i / (M (1 + h c)),
//     L0 = (M L + h (V sigma of the velocities - V sigma0)_ji) / (M (1 + h c)).
//
// The contact problem has the velocities F^T L+ d: the cell is one more body, that all contacts touch. With L0, its
// velocity without impulses, in the free velocities, and the response 1 / (M (1 + h c)) in the operator
// (BodyDelassus::add_cell()), the solver finds L+ with the impulses. An impulse acts on the mass M of the cell by the
// share tr(W^-1 W_cell) of some ten-thousandths with a cell of the mass of its grains.
#pragma once

#include <cmath>
#include <cstddef>

#include "moreau/contact/contact.hpp"
#include "moreau/core/compiled_once.hpp"
#include "moreau/core/small_matrix.hpp"
#include "moreau/core/twist.hpp"
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
      const Vector v = linear<S>(bodies.velocity[i]), p = bodies.grain_mass[i] * v;
      add_product_transposed(moment, p, v);
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
  /// R of the operator, BodyDelassus::add_cell() [1/(kg m^2)].
  const Matrix& response() const { return response_; }
  /// L0, with attraction between the bodies [1/s].
  /// @param moment sum of d_j r_i of the attraction [J s]
  Matrix free(const Matrix& moment) const {
    Matrix sum = free_;
    for (int i = 0; i < S::dim; ++i)
      for (int j = 0; j < S::dim; ++j) sum(i, j) += response_(i, j) * moment(j, i);
    return sum;
  }
  /// Sets L+.
  void set_rate(const Matrix& rate) { rate_ = rate; }

 private:
  Matrix rate_ = Matrix::Zero(), free_ = Matrix::Zero(), response_ = Matrix::Zero();
  bool moves_ = false;
};

}  // namespace moreau::detail
