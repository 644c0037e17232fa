// SPDX-License-Identifier: MIT
// Straight lines and power laws through measured points.
#pragma once

#include <algorithm>
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

/// y = prefactor x^exponent by least squares of the logarithms.
struct PowerLaw {
  double prefactor = std::nan(""), exponent = std::nan("");
  double exponent_error = std::nan("");  ///< standard error
  std::size_t points = 0;                ///< used: those with x > 0 and y > 0
};

inline PowerLaw fit_power_law(const std::vector<Point>& points) {
  std::vector<Point> logs;
  for (const Point& p : points)
    if (p.x > 0 && p.y > 0) logs.push_back({std::log(p.x), std::log(p.y)});
  const Line line = fit_line(logs);
  return {std::exp(line.intercept), line.slope, line.slope_error, line.points};
}

/// y = factor x by least squares of the logarithms.
struct Proportion {
  double factor = std::nan("");     ///< geometric mean of y/x
  double scatter = std::nan("");    ///< root mean square of ln(y / (factor x))
  double deviation = std::nan("");  ///< root mean square of ln(y/x): from y = x
  std::size_t points = 0;
};

inline Proportion fit_proportion(const std::vector<Point>& points) {
  Proportion fit;
  double sum = 0, squares = 0;
  for (const Point& p : points) {
    if (!(p.x > 0 && p.y > 0)) continue;
    const double ratio = std::log(p.y / p.x);
    sum += ratio;
    squares += ratio * ratio;
    ++fit.points;
  }
  if (fit.points == 0) return fit;
  const double n = double(fit.points), mean = sum / n;
  fit.factor = std::exp(mean);
  fit.scatter = std::sqrt(std::max(0.0, squares / n - mean * mean));
  fit.deviation = std::sqrt(squares / n);
  return fit;
}

}  // namespace study
