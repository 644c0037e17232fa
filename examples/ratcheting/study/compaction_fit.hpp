// SPDX-License-Identifier: MIT
// The two forms that the paper fits to the compaction rate over the frequency (its eq. 5 and 6).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "power_law.hpp"

namespace study {

/// Two branches (eq. 5), divided by the prefactor: nu below nu_c, nu_c^2 / nu above.
inline double two_branches(double nu, double nu_c) {
  return nu < nu_c ? nu : nu_c * nu_c / nu;
}

/// The single expression (eq. 6). At nu << nu_c it is 1 + 1/e times the first form.
inline double single_form(double nu, double nu_c) {
  const double x = nu / nu_c;
  return (1 + std::exp(-(x - 1) * (x - 1))) / (1 + x * x) * nu;
}

struct CompactionFit {
  double prefactor = std::nan("");  ///< Delta rho_max / rho_0
  double nu_c = std::nan("");       ///< [Hz]
  double scatter = std::nan("");    ///< root mean square of the logarithm
  bool at_edge = false;  ///< nu_c is the lowest or highest frequency: it is not bracketed
};

/// Fits prefactor and nu_c of a form by least squares of the logarithms. Points that are not > 0
/// are left out. nu_c is searched between the lowest and the highest frequency.
/// @param form of (nu, nu_c)
inline CompactionFit fit_compaction(const std::vector<Point>& points, const auto& form) {
  std::vector<Point> used;
  for (const Point& p : points)
    if (p.x > 0 && p.y > 0) used.push_back(p);
  CompactionFit best;
  if (used.size() < 3) return best;
  const auto by_x = [](const Point& a, const Point& b) { return a.x < b.x; };
  const double low = std::min_element(used.begin(), used.end(), by_x)->x;
  const double high = std::max_element(used.begin(), used.end(), by_x)->x;
  constexpr int trials = 4000;
  for (int k = 0; k <= trials; ++k) {
    const double nu_c = low * std::pow(high / low, double(k) / trials);
    std::vector<Point> scaled;
    for (const Point& p : used) scaled.push_back({form(p.x, nu_c), p.y});
    const Proportion fit = fit_proportion(scaled);
    if (k == 0 || fit.scatter < best.scatter)
      best = {fit.factor, nu_c, fit.scatter, k == 0 || k == trials};
  }
  return best;
}

/// Power laws with free exponents below and above a frequency.
struct Slopes {
  PowerLaw below, above;
};

inline Slopes slopes_about(const std::vector<Point>& points, double nu_c) {
  std::vector<Point> below, above;
  for (const Point& p : points) (p.x <= nu_c ? below : above).push_back(p);
  return {fit_power_law(below), fit_power_law(above)};
}

}  // namespace study
