// SPDX-License-Identifier: MIT
// An order of points along a space-filling curve.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"

namespace moreau {

/// The order of points along a Z-order curve (Morton, 1966): points that follow one another are
/// near each other. Add grains to a simulation in this order: neighbours then lie near each other
/// in memory, if grains are added in this order.
/// @tparam S     the space, e.g. Space<3>
/// @param points positions, world axes [m]
/// @returns the indices of the points in this order
/// @throws std::invalid_argument if a point is not finite
template <class S>
std::vector<std::size_t> spatial_order(std::span<const typename S::Vector> points) {
  using Vector = typename S::Vector;
  constexpr int bits = 60 / S::dim;  // of the code along each axis
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (points.empty()) return order;
  Vector low = points[0], high = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    require(all_finite(points[i]), "spatial_order", "points[" + std::to_string(i) + "]", points[i],
            "must be finite");
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  // The same scale along all axes, so that the curve visits cubes.
  const double extent = std::max(double((high - low).maxCoeff()), 1e-300);
  const double scale = (std::ldexp(1.0, bits) - 1) / extent;
  std::vector<std::uint64_t> codes;
  codes.reserve(points.size());
  for (const Vector& point : points) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < S::dim; ++axis) {
      const auto cell = static_cast<std::uint64_t>(double(point[axis] - low[axis]) * scale);
      for (int bit = 0; bit < bits; ++bit) code |= (cell >> bit & 1) << (S::dim * bit + axis);
    }
    codes.push_back(code);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return codes[i] != codes[j] ? codes[i] < codes[j] : i < j;
  });
  return order;
}

}  // namespace moreau
