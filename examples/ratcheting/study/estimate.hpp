// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace study {

/// Mean and standard deviation of a value over samples.
struct Estimate {
  double mean = std::nan(""), spread = std::nan("");  ///< standard deviation; nan for one sample
  std::size_t samples = 0;
};

/// Values that are not finite are left out.
inline Estimate estimate(const std::vector<double>& values) {
  Estimate e;
  double sum = 0, squares = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++e.samples;
  }
  if (e.samples == 0) return e;
  e.mean = sum / double(e.samples);
  for (const double value : values)
    if (std::isfinite(value)) squares += (value - e.mean) * (value - e.mean);
  if (e.samples > 1) e.spread = std::sqrt(squares / double(e.samples - 1));
  return e;
}

}  // namespace study
