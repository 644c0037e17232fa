// SPDX-License-Identifier: MIT
// What a validation case leaves behind: rows of a table and curves.
#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <initializer_list>
#include <string>
#include <vector>

namespace validation {

/// How much of a case is run: quick takes seconds, full what the answer needs.
enum class Effort { quick, full };

/// One comparison. It passes iff error <= tolerance, so never where something is not a number.
struct Row {
  std::string name, dimension;
  double expected, measured, error, tolerance;
  bool pass() const { return error <= tolerance; }
};

/// Numbers to be drawn; every row has one for each column.
struct Curve {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

class Record {
 public:
  /// |measured - expected| <= tolerance.
  void compare(const std::string& name, int dimension, double expected, double measured,
               double tolerance) {
    add({name, text(dimension), expected, measured, std::abs(measured - expected), tolerance});
  }
  /// |measured - expected| <= tolerance |expected|.
  void compare_relative(const std::string& name, int dimension, double expected, double measured,
                        double tolerance) {
    add({name, text(dimension), expected, measured, std::abs(measured / expected - 1), tolerance});
  }
  /// What should vanish: |measured| <= most.
  void vanishes(const std::string& name, int dimension, double measured, double most) {
    compare(name, dimension, 0, measured, most);
  }
  /// A curve to be filled; the reference stays valid.
  Curve& curve(const std::string& name, std::initializer_list<const char*> columns) {
    curves_.push_back({name, {columns.begin(), columns.end()}, {}});
    return curves_.back();
  }

  const std::vector<Row>& rows() const { return rows_; }
  const std::deque<Curve>& curves() const { return curves_; }

 private:
  static std::string text(int dimension) { return std::to_string(dimension) + "D"; }
  void add(const Row& row) { rows_.push_back(row); }

  std::vector<Row> rows_;
  std::deque<Curve> curves_;
};

/// Slope of log(error) over log(step) by least squares: the order of convergence.
inline double order_of(const std::vector<double>& steps, const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double a = std::log(steps[k]), b = std::log(errors[k]);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

/// Where a property that holds on one side of a threshold changes, by bisection.
/// @param holds number -> bool, true at `high`, false at `low`
/// @returns the middle of the last interval, not a number if it does not change in between
double threshold(double low, double high, int bisections, const auto& holds) {
  if (holds(low) || !holds(high)) return std::nan("");
  for (int k = 0; k < bisections; ++k) {
    const double middle = (low + high) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

}  // namespace validation
