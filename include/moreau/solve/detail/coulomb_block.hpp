// SPDX-License-Identifier: MIT
// Signorini's condition and Coulomb's law for one contact whose block of W is any matrix. A matrix
// that is not symmetric cannot be a LocalBlock, whatever the tangents.
//
// Eliminating r_n from u_n = 0 leaves, with u_t = -alpha r_t,
//
//     (S + alpha I) r_t = -c,     S = W_tt - w_tn w_nt / w_nn,     c = b_t - w_tn b_n / w_nn,
//     r_n = -(b_n + w_nt r_t) / w_nn.
//
// alpha = 0 sticks. If that impulse is outside of the cone, alpha > 0 is the root of
// phi = |r_t| - mu r_n as in coulomb_lanes.hpp. If W is positive definite, phi is positive at 0
// and negative at infinity.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace moreau::detail {

/// The local problem of one contact.
/// @tparam Matrix D x D, normal first
template <class Matrix>
class CoulombBlock {
 public:
  static constexpr int size = Matrix::RowsAtCompileTime, tangents = size - 1;
  using Vector = Eigen::Matrix<double, size, 1>;

  /// @param w the block; a normal entry that is not positive makes a contact without impulse
  explicit CoulombBlock(const Matrix& w) : w_(w), movable_(w(0, 0) > 0), floor_(floor * w.trace()) {
    if (!movable_) return;
    schur_ = w.template bottomRightCorner<tangents, tangents>() -
             (w.template bottomLeftCorner<tangents, 1>() / w(0, 0)) *
                 w.template topRightCorner<1, tangents>();
  }

  const Matrix& matrix() const { return w_; }

  /// The impulse that solves the law with u = W r + b.
  /// @param friction mu >= 0 [-]
  Vector solve(const Vector& b, double friction) const {
    if (!(b[0] < 0) || !movable_) return Vector::Zero();
    const Tangent c = b.template tail<tangents>() -
                      w_.template bottomLeftCorner<tangents, 1>() * (b[0] / w_(0, 0));
    Trial trial = at(floor_, b[0], c, friction);
    if (friction > 0 && trial.excess <= 0) return trial.impulse;
    if (friction == 0) return Vector::Unit(0) * (-b[0] / w_(0, 0));
    double lower = floor_, upper = std::max(schur_.trace(), floor_);
    for (int k = 0; k < 200 && !(at(upper, b[0], c, friction).excess < 0); ++k)
      lower = upper, upper *= 4;
    double alpha = 0.5 * (lower + upper);
    for (int k = 0; k < 100; ++k) {
      trial = at(alpha, b[0], c, friction);
      (trial.excess > 0 ? lower : upper) = alpha;
      const double next = alpha - trial.excess / trial.slope;
      if (std::abs(next - alpha) <= close * alpha || upper - lower <= close * upper) break;
      alpha = next > lower && next < upper ? next : 0.5 * (lower + upper);
    }
    return trial.impulse;
  }

 private:
  using Tangent = Eigen::Matrix<double, tangents, 1>;
  static constexpr double floor = 1e-14, close = 1e-15;

  struct Trial {
    Vector impulse;
    double excess, slope;  ///< phi and d phi / d alpha
  };
  Trial at(double alpha, double b_n, const Tangent& c, double friction) const {
    Eigen::Matrix<double, tangents, tangents> shifted = schur_;
    shifted.diagonal().array() += alpha;
    const Eigen::Matrix<double, tangents, tangents> inverse = shifted.inverse();
    const auto w_nt = w_.template topRightCorner<1, tangents>();
    const Tangent r_t = -(inverse * c), change = -(inverse * r_t);
    const double length = r_t.norm();
    Trial trial;
    trial.impulse[0] = -(b_n + w_nt.dot(r_t)) / w_(0, 0);
    trial.impulse.template tail<tangents>() = r_t;
    trial.excess = length - friction * trial.impulse[0];
    trial.slope =
        (length > 0 ? r_t.dot(change) / length : 0.) + friction * w_nt.dot(change) / w_(0, 0);
    return trial;
  }

  Matrix w_;
  bool movable_;
  double floor_;
  Eigen::Matrix<double, tangents, tangents> schur_;
};

}  // namespace moreau::detail
