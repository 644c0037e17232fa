// SPDX-License-Identifier: MIT
// Functions shared by the readers of contact problems. The dimension of a problem is known only
// after its file has been read.
#pragma once

#include <Eigen/SparseCore>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/solve/friction_problem.hpp"

namespace moreau {

/// A contact problem in the plane or in space.
using AnyFrictionProblem = std::variant<FrictionProblem<Space<2>>, FrictionProblem<Space<3>>>;

namespace detail {

using Triplets = std::vector<Eigen::Triplet<double>>;

using RowSparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The content of a file, before its dimension is checked.
struct RawFrictionProblem {
  int rows_per_contact = 0;
  RowSparse delassus;
  std::vector<double> free_velocity, friction;
};

/// Builds a matrix from its entries.
/// @throws std::invalid_argument if an entry lies outside of the matrix
inline RowSparse checked_matrix(int rows, int columns, const Triplets& entries,
                                std::string_view function, const std::string& name) {
  for (const auto& entry : entries) {
    require(entry.row() >= 0 && entry.row() < rows, function, "row of an entry of " + name,
            entry.row(), "must lie in the matrix");
    require(entry.col() >= 0 && entry.col() < columns, function, "column of an entry of " + name,
            entry.col(), "must lie in the matrix");
  }
  RowSparse matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <class S>
FrictionProblem<S> checked_problem(const RawFrictionProblem& raw, std::string_view function) {
  FrictionProblem<S> problem;
  problem.delassus = raw.delassus;
  using Map = Eigen::Map<const Eigen::VectorXd>;
  problem.free_velocity = Map(raw.free_velocity.data(), Eigen::Index(raw.free_velocity.size()));
  problem.friction = Map(raw.friction.data(), Eigen::Index(raw.friction.size()));
  require_valid(problem, function);
  return problem;
}

inline AnyFrictionProblem checked_problem(const RawFrictionProblem& raw,
                                          std::string_view function) {
  switch (raw.rows_per_contact) {
    case Space<2>::dim:
      return checked_problem<Space<2>>(raw, function);
    case Space<3>::dim:
      return checked_problem<Space<3>>(raw, function);
    default:
      throw_invalid(function, "dimension", raw.rows_per_contact, "must be 2 or 3");
  }
}

}  // namespace detail

}  // namespace moreau
