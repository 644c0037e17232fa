// SPDX-License-Identifier: MIT
// The contact problem of one step as matrices, to write to a file or to pass to another solver.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/law/concepts.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/friction_problem.hpp"

namespace moreau {

/// A law whose local problem is Coulomb's law with the coefficient friction(), so that matrices and
/// coefficients of friction define the contact problem.
template <class L, class S>
concept CoulombLaw = PointLaw<L, S> && requires(const L law) {
  { law.friction() } -> std::convertible_to<double>;
};

/// The contact problem of a step as matrices.
template <class S>
struct GatheredProblem {
  FrictionProblem<S> problem;         ///< in double
  std::vector<std::size_t> contacts;  ///< of each contact of the problem, its index in the step
};

namespace detail {

/// Adds the entries of one block of W.
template <int rows, class Block>
void add_block(Eigen::Index row, Eigen::Index column, const Block& product,
               std::vector<Eigen::Triplet<double>>& entries) {
  const Eigen::Matrix<double, rows, rows> block = product;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j)
      if (block(i, j) != 0)
        entries.emplace_back(int(rows * row) + i, int(rows * column) + j, block(i, j));
}

}  // namespace detail

/// Forms the matrix W = J M^-1 J^T, each contact in its own frame. Contacts whose free velocity is
/// infinite, which cannot act in the step, are left out.
/// @param step its laws have friction()
/// @returns a GatheredProblem in double
/// @throws std::invalid_argument if step.law_of has another size than the operator
template <class Operator, class Law>
auto gather_problem(const ContactProblem<Operator, Law>& step) {
  constexpr int rows = Operator::Space::dim;
  using S = Space<rows>;  // in double for every scalar of the step
  const Operator& op = step.delassus;
  require(step.law_of.size() == op.size(), "gather_problem", "law_of.size()", step.law_of.size(),
          "must be the number of contacts");
  GatheredProblem<S> gathered;
  for (std::size_t c = 0; c < op.size(); ++c)
    if (op.free_velocity(c).allFinite()) gathered.contacts.push_back(c);
  const std::vector<std::size_t>& contacts = gathered.contacts;
  const auto count = static_cast<Eigen::Index>(contacts.size());
  FrictionProblem<S>& problem = gathered.problem;
  problem.free_velocity.resize(rows * count);
  problem.friction.resize(count);
  struct Touch {
    Eigen::Index contact;
    bool is_b;  // whether the body is the second body of the contact
  };
  std::vector<std::vector<Touch>> touches(op.body_count());
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::size_t c = contacts[std::size_t(k)];
    problem.friction[k] = double(step.law(c).friction());
    problem.free_velocity.template segment<rows>(rows * k) =
        op.free_velocity(c).template cast<double>();
    touches[op.bodies(c)[0]].push_back({k, false});
    touches[op.bodies(c)[1]].push_back({k, true});
  }
  std::vector<Eigen::Triplet<double>> entries;
  if constexpr (requires { op.compliance(0); })
    for (Eigen::Index k = 0; k < count; ++k)
      for (int d = 0; d < rows; ++d)
        entries.emplace_back(int(rows * k) + d, int(rows * k) + d,
                             double(op.compliance(contacts[std::size_t(k)])[d]));
  const auto contact = [&](const Touch& touch) { return contacts[std::size_t(touch.contact)]; };
  const auto lever = [&](const Touch& touch) {
    return touch.is_b ? op.lever_b(contact(touch)) : op.lever_a(contact(touch));
  };
  for (std::size_t body = 0; body < touches.size(); ++body)
    for (const Touch& one : touches[body])
      for (const Touch& other : touches[body]) {
        const typename S::Matrix block =
            Operator::block_between(op.frame(contact(one)), lever(one), op.frame(contact(other)),
                                    lever(other), op.inverse_mass(body));
        const double sign = one.is_b == other.is_b ? 1 : -1;
        detail::add_block<rows>(one.contact, other.contact, sign * block.template cast<double>(),
                                entries);
      }
  problem.delassus.resize(rows * count, rows * count);
  problem.delassus.setFromTriplets(entries.begin(), entries.end());
  return gathered;
}

}  // namespace moreau
