// SPDX-License-Identifier: MIT
// A friction problem as Siconos takes it.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "moreau/core/space.hpp"
#include "moreau/solve/friction_problem.hpp"

namespace peers {

/// W in blocks of 3 x 3 by compressed rows, the storage that Siconos' own simulations have.
class SiconosProblem {
 public:
  explicit SiconosProblem(const moreau::FrictionProblem<moreau::Space<3>>& problem)
      : free_velocity_(problem.free_velocity), friction_(problem.friction) {
    using Entry = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
    first_.push_back(0);
    for (Eigen::Index c = 0; c < problem.size(); ++c) {
      std::map<Eigen::Index, Eigen::Matrix3d> row;
      row[c].setZero();
      for (int k = 0; k < 3; ++k)
        for (Entry entry(problem.delassus, 3 * c + k); entry; ++entry)
          row.try_emplace(entry.col() / 3, Eigen::Matrix3d::Zero())
              .first->second(k, entry.col() % 3) = entry.value();
      for (const auto& [column, block] : row) {
        columns_.push_back(std::size_t(column));
        blocks_.push_back(block);
      }
      first_.push_back(columns_.size());
      ends_.push_back(unsigned(3 * (c + 1)));
    }
    for (Eigen::Matrix3d& block : blocks_) pointers_.push_back(block.data());
    w_.nbblocks = unsigned(blocks_.size());
    w_.block = pointers_.data();
    w_.blocknumber0 = w_.blocknumber1 = unsigned(problem.size());
    w_.blocksize0 = w_.blocksize1 = ends_.data();
    w_.filled1 = first_.size();
    w_.filled2 = columns_.size();
    w_.index1_data = first_.data();
    w_.index2_data = columns_.data();
    const int rows = int(problem.free_velocity.size());
    matrix_ = NM_new_SBM(rows, rows, &w_);
    problem_ = {3, int(problem.size()), matrix_, free_velocity_.data(), friction_.data()};
  }
  SiconosProblem(const SiconosProblem&) = delete;
  SiconosProblem& operator=(const SiconosProblem&) = delete;
  ~SiconosProblem() {
    std::free(w_.diagonal_blocks);  // Siconos' own; the rest of W is kept here
    matrix_->matrix1 = nullptr;
    NM_clear(matrix_);
    std::free(matrix_);
  }

  /// Non-smooth Gauss-Seidel with its defaults.
  /// @param impulses in: the start, out: the result, 3 n
  /// @returns iterations, and whether Siconos takes its tolerance as met
  std::pair<int, bool> solve(Eigen::VectorXd& impulses, double tolerance, int max_iterations) {
    const std::unique_ptr<SolverOptions, void (*)(SolverOptions*)> options(
        solver_options_create(SICONOS_FRICTION_3D_NSGS), &solver_options_delete);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = max_iterations;
    Eigen::VectorXd velocity = Eigen::VectorXd::Zero(impulses.size());
    const int failed = fc3d_driver(&problem_, impulses.data(), velocity.data(), options.get());
    return {options->iparam[SICONOS_IPARAM_ITER_DONE], failed == 0};
  }

 private:
  Eigen::VectorXd free_velocity_, friction_;
  std::vector<Eigen::Matrix3d> blocks_;
  std::vector<double*> pointers_;
  std::vector<std::size_t> first_, columns_;
  std::vector<unsigned> ends_;
  SparseBlockStructuredMatrix w_{};
  NumericsMatrix* matrix_;
  FrictionContactProblem problem_;
};

}  // namespace peers
