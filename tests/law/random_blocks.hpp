// SPDX-License-Identifier: MIT
// Random local problems.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <random>

#include "moreau/core/space.hpp"
#include "moreau/law/local_block.hpp"
#include "moreau/law/rolling_block.hpp"

namespace law_oracle {

using moreau::LocalBlock;
using moreau::RollingBlock;

/// A random block with a condition number of at most about 1e4, and a random velocity.
template <class S>
struct LocalProblem {
  LocalBlock<S> block;
  typename S::Vector velocity;
};

template <class S>
LocalProblem<S> random_problem(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  LocalProblem<S> problem;
  typename S::Matrix a;
  for (auto& x : a.reshaped()) x = static_cast<typename S::Scalar>(normal(random));
  for (auto& x : problem.velocity) x = static_cast<typename S::Scalar>(normal(random));
  typename S::Matrix w = a * a.transpose() + typename S::Scalar(1e-3) * S::Matrix::Identity();
  w /= w.trace();
  Eigen::Matrix<typename S::Scalar, S::dim - 1, S::dim - 1> turn;
  problem.block = moreau::align_tangents<S>(w, turn);
  return problem;
}

/// W of two balls, or of a ball and a wall, that touch on the line of their centres. The mass lies
/// anywhere between the centre and the surface.
template <class Space>
RollingBlock<Space> round_block(std::mt19937_64& random) {
  using T = typename Space::Scalar;
  using Vector = typename Space::Vector;
  std::uniform_real_distribution<double> part(0, 1);
  const double radii[] = {0.2 + part(random), 0.2 + part(random)};
  const bool wall = part(random) < 0.3;
  const double radius = wall ? radii[0] : 1 / (1 / radii[0] + 1 / radii[1]);
  double normal = 0, slip = 0, cross = 0, spin = 0;
  for (const int sign : {1, -1}) {
    if (wall && sign < 0) continue;
    const double r = radii[sign < 0], mass = std::pow(r, Space::dim);
    const double turn = 1 / (mass * r * r * (0.1 + 0.9 * part(random)));
    normal += 1 / mass;
    slip += 1 / mass + r * r * turn;
    cross += sign * radius * r * turn;
    spin += radius * radius * turn;
  }
  RollingBlock<Space> block;
  block.point.normal = T(normal);
  block.point.coupling.setZero();
  block.point.slip.setConstant(T(slip));
  block.cross = T(cross) * Space::lever(Vector(Vector::Unit(0)));
  block.spin = T(spin) * Space::Inertia::Identity();
  return block;
}

}  // namespace law_oracle
