// SPDX-License-Identifier: MIT
// An order of points along a space-filling curve.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/space.hpp"
#include "moreau/core/z_curve.hpp"

namespace moreau {

/// The order of points along a Z-order curve (Morton, 1966): points that follow one another are
/// near each other. If grains are added to a simulation in this order, neighbours in space lie near
/// each other in memory.
/// @tparam S     the space, e.g. Space<3>
/// @param points positions, world axes [m]
/// @returns the indices of the points in this order
/// @throws std::invalid_argument if a point is not finite
template <class S>
std::vector<std::size_t> spatial_order(std::span<const typename S::Vector> points) {
  using Vector = typename S::Vector;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (points.empty()) return order;
  Vector low = points[0], high = points[0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!all_finite(points[i]))
      throw_invalid("spatial_order", "points[" + std::to_string(i) + "]", points[i],
                    "must be finite");
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  const double edge = double((high - low).maxCoeff());
  std::vector<std::uint64_t> codes;
  codes.reserve(points.size());
  for (const Vector& point : points)
    codes.push_back(detail::z_code<S, 60 / S::dim>(point, low, edge));
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return codes[i] != codes[j] ? codes[i] < codes[j] : i < j;
  });
  return order;
}

}  // namespace moreau
