// SPDX-License-Identifier: MIT
// Measures of a heap: its free surface, and the slope of the surface, whose angle is the angle of repose. The same
// functions measure a heap of two slopes in the plane and a cone in space. The last axis points up.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "moreau/core/components.hpp"
#include "moreau/core/error.hpp"
#include "moreau/core/small_matrix.hpp"

namespace moreau {

/// The free surface of the grains: one point for each vertical column that contains the centre of a grain.
/// Obstacles, the grains whose motion is prescribed, do not count.
/// @param width of a column along each horizontal axis [m], > 0; two to three grain diameters are a good choice
/// @returns points in the order of the columns, world axes [m]: the middle of the column, at the height of the highest
///          point of the grains in it
/// @throws std::invalid_argument for a width that is not finite or not positive
template <class Simulation>
std::vector<typename Simulation::Vector> free_surface(const Simulation& simulation,
                                                      typename Simulation::Scalar width) {
  using Vector = typename Simulation::Vector;
  using Scalar = typename Simulation::Scalar;
  constexpr int up = Simulation::S::dim - 1;
  require_positive(width, "free_surface", "width");
  // By their whole numbers, which for a lost grain can be larger than an integer holds.
  std::map<std::array<Scalar, std::size_t(up)>, Vector> columns;
  for (std::size_t k = 0; k < simulation.grain_count(); ++k) {
    const std::size_t i = simulation.grain(k).index();
    if (simulation.bodies().is_prescribed(i)) continue;
    const auto& pose = simulation.bodies().pose[i];
    const Vector center = simulation.cell().wrap(pose.position);
    std::array<Scalar, std::size_t(up)> column{};
    Vector top;
    for (int axis = 0; axis < up; ++axis) {
      const Scalar number = std::floor(center[axis] / width);
      column[std::size_t(axis)] = number;
      top[axis] = (number + Scalar(0.5)) * width;
    }
    top[up] = simulation.shape_of_grain(k).bounding_box(pose).upper[up];
    const auto [place, is_new] = columns.try_emplace(column, top);
    if (!is_new) place->second[up] = std::max(place->second[up], top[up]);
  }
  std::vector<Vector> surface;
  for (const auto& [column, top] : columns) surface.push_back(top);
  return surface;
}

/// A straight line through the free surface: height = apex - tan(angle) distance.
struct HeapSlope {
  double angle = 0;  ///< between the surface and the horizontal [rad], > 0 if it falls outwards
  double apex = 0;   ///< height of the line at distance 0 [m]
  double error = 0;  ///< root mean square of height - line [m]
  std::size_t points = 0;  ///< of the surface that were used
};

/// Fits a line to the height of a surface over the horizontal distance from a vertical axis (least squares).
/// Choose the distances so that neither the rounded top nor the foot of the heap is among them.
/// @param surface  of free_surface()
/// @param axis     any point of the vertical axis through the middle of the heap, world axes [m]
/// @param from,to  distances of the points that are used [m]
/// @throws std::invalid_argument if a distance is not a number, or if fewer than two points, or points at one distance
///         only, are used
template <class Vector>
HeapSlope heap_slope(const std::vector<Vector>& surface, const Vector& axis, double from,
                     double to) {
  require(!std::isnan(from), "heap_slope", "from", from, "m must be a number");
  require(!std::isnan(to), "heap_slope", "to", to, "m must be a number");
  const Eigen::Index up = axis.size() - 1;
  std::vector<std::array<double, 2>> used;  // distance, height
  double mean[2] = {0, 0};
  for (const Vector& point : surface) {
    const double distance = double((point - axis).head(up).norm());
    if (distance < from || distance > to) continue;
    used.push_back({distance, double(point[up])});
    mean[0] += distance, mean[1] += double(point[up]);
  }
  require(used.size() >= 2, "heap_slope", "points", used.size(),
          "must be at least 2 between the distances `from` and `to`");
  for (double& value : mean) value /= double(used.size());
  double square = 0, product = 0;
  for (const auto& [distance, height] : used) {
    square += (distance - mean[0]) * (distance - mean[0]);
    product += (distance - mean[0]) * (height - mean[1]);
  }
  require(square > 0, "heap_slope", "distances", mean[0], "must differ");
  const double slope = product / square;
  HeapSlope fit{std::atan(-slope), mean[1] - slope * mean[0], 0, used.size()};
  for (const auto& [distance, height] : used) {
    const double error = height - fit.apex - slope * distance;
    fit.error += error * error / double(used.size());
  }
  fit.error = std::sqrt(fit.error);
  return fit;
}

}  // namespace moreau
