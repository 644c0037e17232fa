// SPDX-License-Identifier: MIT
// Results of a validation case: rows of the table and curves.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <deque>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace validation {

/// Size of a case: quick takes seconds, full is as large as the answer requires.
enum class Effort { quick, full };

/// One comparison. It passes iff error <= tolerance, so a NaN does not pass.
struct Row {
  std::string name, space;  ///< space: "3D" or "3D float"
  double expected, measured, error, tolerance;
  bool pass() const { return error <= tolerance; }
};

/// Points of a curve; every row has one number per column.
struct Curve {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

/// The tolerance of a comparison: at least 1000 roundings (1.2e-4 in float), unless it is 0.
template <class S>
double tolerance_in(double tolerance) {
  const double roundings = 1000 * double(std::numeric_limits<typename S::Scalar>::epsilon());
  return tolerance == 0 ? 0 : std::max(tolerance, roundings);
}

/// Collects the results of a case. Every comparison has the name of its space: dimension and
/// scalar.
class Record {
 public:
  /// Compares: |measured - expected| <= tolerance.
  template <class S>
  void compare(const std::string& name, S, double expected, double measured, double tolerance) {
    add({name, text<S>(), expected, measured, std::abs(measured - expected),
         tolerance_in<S>(tolerance)});
  }
  /// Compares: |measured - expected| <= tolerance |expected|.
  template <class S>
  void compare_relative(const std::string& name, S, double expected, double measured,
                        double tolerance) {
    add({name, text<S>(), expected, measured, std::abs(measured / expected - 1),
         tolerance_in<S>(tolerance)});
  }
  /// Compares a value that should vanish: |measured| <= most.
  template <class S>
  void vanishes(const std::string& name, S space, double measured, double most) {
    compare(name, space, 0, measured, most);
  }
  /// Adds an empty curve named name_2d, name_3d, name_2d_float or name_3d_float. The reference
  /// stays valid.
  template <class S>
  Curve& curve(const std::string& name, S, std::initializer_list<const char*> columns) {
    const std::string kind = std::to_string(S::dim) + (is_float<S> ? "d_float" : "d");
    curves_.push_back({name + '_' + kind, {columns.begin(), columns.end()}, {}});
    return curves_.back();
  }

  const std::vector<Row>& rows() const { return rows_; }
  const std::deque<Curve>& curves() const { return curves_; }

 private:
  template <class S>
  static constexpr bool is_float = std::same_as<typename S::Scalar, float>;
  template <class S>
  static std::string text() {
    return std::to_string(S::dim) + (is_float<S> ? "D float" : "D");
  }
  void add(const Row& row) { rows_.push_back(row); }

  std::vector<Row> rows_;
  std::deque<Curve> curves_;
};

/// Order of convergence: slope of log(error) over log(step) by least squares.
inline double order_of(const std::vector<double>& steps, const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double a = std::log(steps[k]), b = std::log(errors[k]);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

/// Threshold at which a property begins to hold, by bisection.
/// @param holds number -> bool; false at `low`, true at `high`
/// @returns the middle of the last interval; NaN if holds(low) or not holds(high)
double threshold(double low, double high, int bisections, const auto& holds) {
  if (holds(low) || !holds(high)) return std::nan("");
  for (int k = 0; k < bisections; ++k) {
    const double middle = (low + high) / 2;
    (holds(middle) ? high : low) = middle;
  }
  return (low + high) / 2;
}

}  // namespace validation
