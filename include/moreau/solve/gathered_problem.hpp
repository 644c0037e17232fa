// SPDX-License-Identifier: MIT
// The contact problem of one step as matrices, to write to a file or to pass to another solver.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "moreau/contact/contact.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/motion/mobility.hpp"
#include "moreau/solve/contact_problem.hpp"
#include "moreau/solve/detail/dense_mass.hpp"
#include "moreau/solve/detail/jacobian_rows.hpp"
#include "moreau/solve/friction_problem.hpp"

namespace moreau {

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

/// A contact of a body, in double.
template <class S>
struct TouchedBody {
  Eigen::Index contact;
  /// The impulses along the axes of the contact as forces and torques on the body, and the velocities that they cause.
  Eigen::Matrix<double, S::dofs, S::dim> forces, velocities;
};

/// Adds the blocks that the contacts of each body have in common, J M^-1 J^T. The diagonal is symmetrized.
template <class S>
void add_products(std::span<const std::vector<TouchedBody<S>>> touches,
                  std::vector<Eigen::Triplet<double>>& entries) {
  for (const std::vector<TouchedBody<S>>& body : touches)
    for (std::size_t i = 0; i < body.size(); ++i)
      for (std::size_t k = 0; k <= i; ++k) {
        Eigen::Matrix<double, S::dim, S::dim> block =
            body[i].forces.transpose() * body[k].velocities;
        if (i == k) block = (block + block.transpose()).eval() / 2;
        add_block<S::dim>(body[i].contact, body[k].contact, block, entries);
        if (i != k) add_block<S::dim>(body[k].contact, body[i].contact, block.transpose(), entries);
      }
}

}  // namespace detail

/// Forms the matrix W = J M^-1 J^T. Contacts whose free velocity is infinite, which cannot act in the step, are left out.
/// @param step   its laws have friction()
/// @param frames the contacts of the step: each row is in the frame of its contact; empty: in that of the operator, as the
///               rows that solvers of the step find
/// @returns a GatheredProblem in double
/// @throws std::invalid_argument if step.law_of has another size than the operator
template <class Operator, class Law>
auto gather_problem(const ContactProblem<Operator, Law>& step,
                    std::span<const Contact<typename Operator::Space>> frames = {}) {
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
  using Touch = detail::TouchedBody<S>;
  std::vector<std::vector<Touch>> touches(op.body_count());
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::size_t c = contacts[std::size_t(k)];
    problem.friction[k] = double(step.law(c).friction());
    typename Operator::Space::Vector free = op.free_velocity(c).template head<rows>();
    if (!frames.empty()) free = op.turned_back(c, free);
    problem.free_velocity.template segment<rows>(rows * k) = free.template cast<double>();
    const auto& frame = frames.empty() ? op.frame(c) : frames[c].frame;
    const auto [a, b] = op.bodies(c);
    const auto touch = [&](std::uint32_t body, const typename S::Vector& lever, double sign) {
      const InverseMass<S>& mass = op.inverse_mass(body);
      if (!mass.moves()) return;
      Touch one{k, {}, {}};
      one.forces = detail::jacobian_rows<S>(frame, lever, sign).transpose();
      one.velocities = detail::dense<S>(mass) * one.forces;
      touches[body].push_back(one);
    };
    touch(a, op.lever_a(c), -1);
    touch(b, op.lever_b(c), 1);
  }
  std::vector<Eigen::Triplet<double>> entries;
  if constexpr (requires { op.compliance(0); })
    for (Eigen::Index k = 0; k < count; ++k)
      for (int d = 0; d < rows; ++d)
        entries.emplace_back(int(rows * k) + d, int(rows * k) + d,
                             double(op.compliance(contacts[std::size_t(k)])[d]));
  detail::add_products<S>(touches, entries);
  problem.delassus.resize(rows * count, rows * count);
  problem.delassus.setFromTriplets(entries.begin(), entries.end());
  return gathered;
}

}  // namespace moreau
