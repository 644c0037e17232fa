// SPDX-License-Identifier: MIT
// A periodic cell that moves by its stress, in the Delassus operator: one more body, with D x D velocities Lambda, that
// all contacts touch. For a contact with the frame F, the levers l_a, l_b and an impulse p in world axes
//
//     u_c contains F^T Lambda d,     Lambda_ij += R_ij p_i d_j,       d = l_a - l_b,
//
// with the response R of the cell (world/detail/cell/cell_servo.hpp).
#pragma once

#include <cstddef>
#include <span>

#include "moreau/core/compiled_once.hpp"
#include "moreau/core/list.hpp"
#include "moreau/core/small_matrix.hpp"

namespace moreau::detail {

/// The cell of a BodyDelassus, which has functions with the same meaning.
template <class S>
class OperatorCell {
 public:
  using Scalar = typename S::Scalar;
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;

  void forget() { exists_ = false; }       ///< removes the cell together with the points
  bool exists() const { return exists_; }  ///< whether there is a cell
  const Matrix& response() const { return response_; }  ///< R [1/(kg m^2)]
  const Matrix& change() const { return change_; }      ///< Lambda [1/s]

  /// Sets R and Lambda = 0; enlarges the blocks of the points.
  template <class Point>
  void start(const Matrix& response, std::span<Point> points) {
    response_ = response;
    change_.setZero();
    if (!exists_) scale_blocks(points, true);
    exists_ = true;
  }
  /// Removes the cell; gives the points back their blocks.
  template <class Point>
  void stop(std::span<Point> points) {
    scale_blocks(points, false);
    exists_ = false;
  }
  /// Changes Lambda by an impulse, in the frame of a point [N s].
  template <class Point>
  [[gnu::always_inline]] void push(const Point& point, const typename Point::Vector& impulse) {
    const Vector push = point.push_of(impulse), d = branch(point);
    for (int j = 0; j < S::dim; ++j)
      for (int i = 0; i < S::dim; ++i) change_(i, j) += response_(i, j) * push[i] * d[j];
  }
  /// Sets Lambda by all impulses, one per point.
  template <class Point>
  [[gnu::always_inline]] void push_all(std::span<const Point> points, const auto& impulses) {
    change_.setZero();
    for (std::size_t c = 0; c < impulses.size(); ++c)
      if (!impulses[c].isZero(0)) push(points[c], impulses[c]);
  }
  /// Adds Lambda d of a point to a relative velocity, world axes [m/s].
  template <class Point>
  MOREAU_COLD void add_velocity(const Point& point, Vector& velocity) const {
    velocity += product(change_, branch(point));
  }

 private:
  /// d, from the centre of body a to that of the image of b, world axes [m].
  static Vector branch(const auto& point) { return point.lever_a - point.lever_b; }
  /// Multiplies the blocks by 1 + tr(W^-1 W_cell), W_cell = max R |d| sum of |d|: by the inequality of Cauchy and
  /// Schwarz the sum of these blocks is at least the operator of the cell. Or divides by it.
  template <class Point>
  MOREAU_COMPILED_ONCE void scale_blocks(std::span<Point> points, bool up) {
    Scalar sum = 0;
    for (const Point& point : points) sum += branch(point).norm();
    if (up) factors_.resize(points.size());
    for (std::size_t c = 0; c < points.size(); ++c) {
      Scalar& factor = factors_[c];
      if (up) {
        const typename Point::Matrix inverse = inverse_of(points[c].block.matrix());
        Scalar trace = 0;
        for (int k = 0; k < S::dim; ++k) trace += inverse(k, k);
        factor = 1 + response_.maxCoeff() * branch(points[c]).norm() * sum * trace;
        if (!(factor >= 1)) factor = 1;  // between bodies that cannot move
      }
      points[c].block *= up ? factor : 1 / factor;
    }
  }

  bool exists_ = false;
  Matrix response_ = Matrix::Zero(), change_ = Matrix::Zero();
  List<Scalar> factors_;  // of the blocks [-]
};

}  // namespace moreau::detail
