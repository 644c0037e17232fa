// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>

#include "moreau/motion/mobility.hpp"
#include "moreau/simd/lane_algebra.hpp"

namespace moreau::detail {

/// M^-1 of a body as a matrix, D + A rows.
template <class Exact, class S>
Eigen::Matrix<double, Exact::dofs, Exact::dofs> dense(const InverseMass<S>& mass) {
  using Algebra = LaneAlgebra<S, typename S::Scalar>;
  Eigen::Matrix<double, Exact::dofs, Exact::dofs> m;
  m.setZero();
  for (int i = 0; i < S::dofs; ++i)
    for (int k = 0; k < S::dofs; ++k) {
      const bool turns = i >= S::dim;
      if (turns != (k >= S::dim)) continue;
      const int first = turns ? S::dim : 0;
      const std::size_t entry = Algebra::entry(std::size_t(i - first), std::size_t(k - first));
      m(i, k) = double(turns ? mass.angular()[entry] : mass.linear()[entry]);
    }
  return m;
}

}  // namespace moreau::detail
