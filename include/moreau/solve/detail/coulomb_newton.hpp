// SPDX-License-Identifier: MIT
// Newton's method on the non-smooth equations of P. Alart and A. Curnier (Comput. Methods Appl.
// Mech. Engrg. 92 (1991) 353): with x = r - rho u of a contact, normal first,
//
//     F_n = r_n - max(0, x_n),
//     F_t = r_t - (projection of x_t onto the disk of radius mu max(0, x_n)).
//
// Each contact is open (x_n <= 0, F = r), sticks (F = rho u) or slips, which selects the derivative
// of F. Open contacts are not in the linear system.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "moreau/solve/detail/block_system.hpp"

namespace moreau::detail {

/// Newton's method for a BlockSystem; the head of this file has its equations.
template <class S>
class CoulombNewton {
 public:
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  static constexpr int dim = S::dim, tangents = dim - 1;

  explicit CoulombNewton(const BlockSystem<S>& system) : system_(system) {}

  /// Number of linear systems solved so far.
  int steps() const { return steps_; }

  /// Makes at most `iterations` steps while they reduce F; r gets the best result.
  /// @param is_late function: whether no further step shall begin
  /// @returns the residual of r
  double improve(Eigen::VectorXd& r, double tolerance, int iterations, const auto& is_late) {
    double best = system_.residual(r);
    recent_.clear();
    Eigen::VectorXd x = r;
    for (int k = 0; k < iterations && best > tolerance && !is_late(); ++k) {
      if (!step(x)) break;
      const double residual = system_.residual(x);
      if (residual < best) {
        best = residual;
        r = x;
      }
    }
    return best;
  }

 private:
  using Tangent = Eigen::Matrix<double, tangents, 1>;
  using Square = Eigen::Matrix<double, tangents, tangents>;
  using Sparse = Eigen::SparseMatrix<double>;

  /// F of one contact and its derivatives by r and by u.
  struct Piece {
    Vector f;
    Matrix by_r = Matrix::Zero(), by_u = Matrix::Zero();
    bool open = false;
  };
  Piece piece(Eigen::Index c, const Vector& r, const Vector& u) const {
    const double rho = dim / system_.diagonal(c).trace(), mu = system_.friction(c);
    const Vector x = r - rho * u;
    const auto x_t = x.template tail<tangents>();
    const double length = x_t.norm();
    Piece p;
    if (!(x[0] > 0)) {
      p.open = true;
      p.f = r;
      p.by_r.setIdentity();
    } else if (length <= mu * x[0]) {
      p.f = rho * u;
      p.by_u.diagonal().setConstant(rho);
    } else {
      const Tangent t = x_t / length;
      const Square turn = (Square::Identity() - t * t.transpose()) * (mu * x[0] / length);
      p.f[0] = rho * u[0];
      p.f.template tail<tangents>() = r.template tail<tangents>() - mu * x[0] * t;
      p.by_r.template bottomRightCorner<tangents, tangents>() = Square::Identity() - turn;
      p.by_r.template bottomLeftCorner<tangents, 1>() = -mu * t;
      p.by_u(0, 0) = rho;
      p.by_u.template bottomRightCorner<tangents, tangents>() = rho * turn;
      p.by_u.template bottomLeftCorner<tangents, 1>() = rho * mu * t;
    }
    return p;
  }
  double norm(const Eigen::VectorXd& r) const {
    const Eigen::VectorXd u = system_.velocity(r);
    double sum = 0;
    for (Eigen::Index c = 0; c < system_.size(); ++c)
      sum += piece(c, r.template segment<dim>(dim * c), u.template segment<dim>(dim * c))
                 .f.squaredNorm();
    return std::sqrt(sum);
  }

  /// One step of Newton's method with a line search: |F| below the largest of the last few (L. Grippo,
  /// F. Lampariello and S. Lucidi, SIAM J. Numer. Anal. 23 (1986) 707).
  /// @param r in, out: impulses [N s]; unchanged if the function returns false
  /// @returns false if the derivative is singular or no step reduces |F|
  bool step(Eigen::VectorXd& r) {
    constexpr int halvings = 12;
    constexpr double decrease = 1e-4;
    constexpr std::size_t memory = 10;
    Eigen::VectorXd direction;
    double before = 0;
    ++steps_;
    if (!newton_direction(r, direction, before)) return false;
    recent_.push_back(before);
    if (recent_.size() > memory) recent_.erase(recent_.begin());
    const double bound = *std::max_element(recent_.begin(), recent_.end());
    double length = 1;
    for (int k = 0; k < halvings; ++k, length /= 2) {
      const Eigen::VectorXd next = r + length * direction;
      if (!(norm(next) < (1 - decrease * length) * bound)) continue;
      r = next;
      return true;
    }
    return false;
  }

  bool newton_direction(const Eigen::VectorXd& r, Eigen::VectorXd& direction, double& norm_f) {
    const Eigen::VectorXd u = system_.velocity(r);
    pieces_.clear();
    number_.clear();
    direction.setZero(r.size());
    Eigen::Index active = 0;
    double sum = 0;
    for (Eigen::Index c = 0; c < system_.size(); ++c) {
      pieces_.push_back(
          piece(c, r.template segment<dim>(dim * c), u.template segment<dim>(dim * c)));
      const Piece& p = pieces_.back();
      sum += p.f.squaredNorm();
      number_.push_back(p.open ? -1 : active++);
      if (p.open) direction.template segment<dim>(dim * c) = -p.f;
    }
    norm_f = std::sqrt(sum);
    if (active == 0) return norm_f > 0;
    Eigen::VectorXd right(dim * active);
    assemble(direction, right, active);
    lu_.compute(jacobian_);
    if (lu_.info() != Eigen::Success) return false;
    const Eigen::VectorXd solution = lu_.solve(right);
    for (Eigen::Index c = 0; c < system_.size(); ++c)
      if (number_[std::size_t(c)] >= 0)
        direction.template segment<dim>(dim * c) =
            solution.template segment<dim>(dim * number_[std::size_t(c)]);
    return direction.allFinite();
  }

  /// Assembles the rows of the contacts that are not open; `direction` has the steps of open
  /// contacts.
  void assemble(const Eigen::VectorXd& direction, Eigen::VectorXd& right, Eigen::Index active) {
    entries_.clear();
    for (Eigen::Index c = 0; c < system_.size(); ++c) {
      const Eigen::Index row = number_[std::size_t(c)];
      if (row < 0) continue;
      const Piece& p = pieces_[std::size_t(c)];
      right.template segment<dim>(dim * row) = -p.f - p.by_u * system_.product(c, direction);
      bool on_diagonal = true;
      system_.for_each_block(c, [&](Eigen::Index column, const Matrix& w) {
        Matrix value = p.by_u * w;
        if (on_diagonal) value += p.by_r + system_.epsilon() * p.by_u;
        on_diagonal = false;
        const Eigen::Index target = number_[std::size_t(column)];
        if (target < 0) return;
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            if (value(i, j) != 0)
              entries_.emplace_back(int(dim * row + i), int(dim * target + j), value(i, j));
      });
    }
    jacobian_.resize(dim * active, dim * active);
    jacobian_.setFromTriplets(entries_.begin(), entries_.end());
    jacobian_.makeCompressed();
  }

  const BlockSystem<S>& system_;
  int steps_ = 0;
  std::vector<double> recent_;  ///< |F| of the last iterates
  std::vector<Piece> pieces_;
  std::vector<Eigen::Index> number_;
  std::vector<Eigen::Triplet<double>> entries_;
  Sparse jacobian_;
  Eigen::SparseLU<Sparse> lu_;
};

}  // namespace moreau::detail
