// SPDX-License-Identifier: MIT
// Distance between two closed curves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "power_law.hpp"

namespace study {

/// Distance of a point from a closed curve, with each axis divided by its unit.
inline double distance_from_loop(const Point& p, const std::vector<Point>& curve,
                                 const Point& unit) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Point& from = curve[k];
    const Point& to = curve[(k + 1) % curve.size()];
    const double ax = (to.x - from.x) / unit.x, ay = (to.y - from.y) / unit.y;
    const double px = (p.x - from.x) / unit.x, py = (p.y - from.y) / unit.y;
    const double length = ax * ax + ay * ay;
    const double at = length > 0 ? std::clamp((px * ax + py * ay) / length, 0.0, 1.0) : 0;
    nearest = std::min(nearest, std::hypot(px - at * ax, py - at * ay));
  }
  return nearest;
}

/// Hausdorff distance of two closed curves: the largest distance of a point of one curve from the
/// other curve. Each axis is divided by the range of `a`. nan without points.
inline double loop_distance(const std::vector<Point>& a, const std::vector<Point>& b) {
  if (a.empty() || b.empty()) return std::nan("");
  Point low = a.front(), high = a.front();
  for (const Point& p : a) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Point unit{high.x - low.x, high.y - low.y};
  double largest = 0;
  for (const Point& p : a) largest = std::max(largest, distance_from_loop(p, b, unit));
  for (const Point& p : b) largest = std::max(largest, distance_from_loop(p, a, unit));
  return largest;
}

}  // namespace study
