// SPDX-License-Identifier: MIT
// A friction problem with W in D x D blocks, scaled so that the mean of diag W is 1, and shifted:
//
//     u = (W + epsilon I) r + b - epsilon centre
//
// With the last result as the centre, the solutions are the steps of the proximal point method
// (R. T. Rockafellar, SIAM J. Control Optim. 14 (1976) 877).
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <limits>
#include <vector>

#include "moreau/solve/detail/coulomb_block.hpp"
#include "moreau/solve/friction_problem.hpp"

namespace moreau::detail {

/// The shifted problem; the head of this file has its equation.
template <class S>
class BlockSystem {
 public:
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  static constexpr int dim = S::dim;

  /// One block of a row of W.
  struct Block {
    Eigen::Index column;
    Matrix value;
  };

  /// @param guard factor on the residual of the velocities alone
  BlockSystem(const FrictionProblem<S>& problem, double guard)
      : guard_(guard),
        free_(problem.free_velocity),
        friction_(problem.friction),
        shifted_free_(free_) {
    const double scale = delassus_scale(problem);
    std::vector<std::size_t> block_of(static_cast<std::size_t>(size()), none);
    first_.push_back(0);
    for (Eigen::Index c = 0; c < size(); ++c) {
      const std::size_t start = blocks_.size();
      add_entry(block_of, c, 0, 0, 0.);
      for (int k = 0; k < dim; ++k)
        for (Row entry(problem.delassus, dim * c + k); entry; ++entry)
          add_entry(block_of, entry.col() / dim, k, int(entry.col() % dim), entry.value() / scale);
      for (std::size_t b = start; b < blocks_.size(); ++b)
        block_of[std::size_t(blocks_[b].column)] = none;
      first_.push_back(blocks_.size());
    }
    shift(0, Eigen::VectorXd::Zero(free_.size()));
  }

  /// Number of contacts.
  Eigen::Index size() const { return friction_.size(); }
  double friction(Eigen::Index c) const { return friction_[c]; }
  double epsilon() const { return epsilon_; }

  /// Sets epsilon and the centre.
  void shift(double epsilon, const Eigen::VectorXd& centre) {
    epsilon_ = epsilon;
    shifted_free_ = free_ - epsilon * centre;
    local_.clear();
    for (Eigen::Index c = 0; c < size(); ++c) {
      Matrix w = blocks_[first_[std::size_t(c)]].value;
      w.diagonal().array() += epsilon;
      local_.emplace_back(w);
    }
  }

  /// Calls f(column, block) for the blocks of row c without the shift, the diagonal block first.
  template <class F>
  void for_each_block(Eigen::Index c, F&& f) const {
    for (std::size_t b = first_[std::size_t(c)]; b < first_[std::size_t(c) + 1]; ++b)
      f(blocks_[b].column, blocks_[b].value);
  }
  /// W_cc with the shift.
  const Matrix& diagonal(Eigen::Index c) const { return local_[std::size_t(c)].matrix(); }

  /// (W + epsilon I) r of one contact.
  Vector product(Eigen::Index c, const Eigen::VectorXd& r) const {
    Vector u = epsilon_ * r.template segment<dim>(dim * c);
    for (std::size_t b = first_[std::size_t(c)]; b < first_[std::size_t(c) + 1]; ++b)
      u.noalias() += blocks_[b].value * r.template segment<dim>(dim * blocks_[b].column);
    return u;
  }
  /// u of all contacts.
  Eigen::VectorXd velocity(const Eigen::VectorXd& r) const {
    Eigen::VectorXd u = shifted_free_;
    for (Eigen::Index c = 0; c < size(); ++c) u.template segment<dim>(dim * c) += product(c, r);
    return u;
  }
  /// See MapError::guarded.
  double residual(const Eigen::VectorXd& r) const {
    return map_error<S>(velocity(r), r, shifted_free_, friction_).guarded(guard_);
  }

  /// One pass of non-linear Gauss-Seidel.
  void sweep(Eigen::VectorXd& r) const {
    for (Eigen::Index c = 0; c < size(); ++c) {
      auto r_c = r.template segment<dim>(dim * c);
      const CoulombBlock<Matrix>& local = local_[std::size_t(c)];
      const Vector b =
          shifted_free_.template segment<dim>(dim * c) + product(c, r) - local.matrix() * r_c;
      r_c = local.solve(b, friction_[c]);
    }
  }

 private:
  using Row = typename Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void add_entry(std::vector<std::size_t>& block_of, Eigen::Index column, int row, int inner,
                 double value) {
    std::size_t& b = block_of[std::size_t(column)];
    if (b == none) {
      b = blocks_.size();
      blocks_.push_back({column, Matrix::Zero()});
    }
    blocks_[b].value(row, inner) += value;
  }

  double guard_;
  Eigen::VectorXd free_, friction_, shifted_free_;
  std::vector<Block> blocks_;
  std::vector<std::size_t> first_;
  std::vector<CoulombBlock<Matrix>> local_;
  double epsilon_ = 0;
};

}  // namespace moreau::detail
