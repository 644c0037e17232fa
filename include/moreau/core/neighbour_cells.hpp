// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace moreau::detail {

/// Cells of a grid in D dimensions that touch a cell, with the cell itself: 3^D.
template <int D>
constexpr int neighbour_cells() {
  int count = 1;
  for (int axis = 0; axis < D; ++axis) count *= 3;
  return count;
}

/// Where neighbour k < 3^D of a cell lies: -1, 0 or 1 cell along each axis. Neighbours k and 3^D - 1 - k are opposite; the
/// middle one is the cell itself.
template <class Vector>
Vector neighbour_cell(int k) {
  Vector steps;
  for (Eigen::Index axis = 0; axis < steps.size(); ++axis, k /= 3)
    steps[axis] = static_cast<typename Vector::Scalar>(k % 3 - 1);
  return steps;
}

}  // namespace moreau::detail
