// SPDX-License-Identifier: MIT
// A straight line through measured points.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace study {

struct Point {
  double x, y;
};

/// y = intercept + slope x by least squares.
struct Line {
  double intercept = std::nan(""), slope = std::nan("");
  double slope_error = std::nan("");  ///< standard error; nan for fewer than three points
  std::size_t points = 0;
};

/// @returns a line of nan for fewer than two different x
inline Line fit_line(const std::vector<Point>& points) {
  Line line;
  line.points = points.size();
  if (points.size() < 2) return line;
  const double n = double(points.size());
  Point mean{0, 0};
  for (const Point& p : points) mean = {mean.x + p.x / n, mean.y + p.y / n};
  double xx = 0, xy = 0, left = 0;
  for (const Point& p : points) {
    xx += (p.x - mean.x) * (p.x - mean.x);
    xy += (p.x - mean.x) * (p.y - mean.y);
  }
  if (!(xx > 0)) return line;
  line.slope = xy / xx;
  line.intercept = mean.y - line.slope * mean.x;
  for (const Point& p : points) {
    const double residual = p.y - line.intercept - line.slope * p.x;
    left += residual * residual;
  }
  if (points.size() > 2) line.slope_error = std::sqrt(left / (n - 2) / xx);
  return line;
}

}  // namespace study
