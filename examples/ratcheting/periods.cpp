// SPDX-License-Identifier: MIT
#include "periods.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ratcheting {

namespace {

/// Index of the sample at a time. There is a sample at the end of each step.
std::size_t index_at(const std::vector<WallSample>& wall, double t, double step) {
  const double k = std::round(t / step) - std::round(wall.front().t / step);
  return static_cast<std::size_t>(std::clamp(k, 0.0, double(wall.size() - 1)));
}

std::vector<double> column(const std::vector<WallSample>& wall, double WallSample::*field) {
  std::vector<double> values;
  for (const WallSample& sample : wall) values.push_back(sample.*field);
  return values;
}

}  // namespace

std::vector<Period> find_periods(const std::vector<WallSample>& wall, const Parameters& p,
                                 double weight) {
  const auto t = column(wall, &WallSample::t), x = column(wall, &WallSample::x),
             v = column(wall, &WallSample::v), f_g = column(wall, &WallSample::f_g);
  const double before = time_before_minimum(weight, p.fmin, p.fmax, p.frequency);
  std::vector<Period> periods;
  for (int k = 1; (k + 0.75) / p.frequency <= p.begin() + p.duration + p.step / 2; ++k) {
    const std::size_t first = index_at(wall, (k - 0.25) / p.frequency, p.step);
    const std::size_t last = index_at(wall, (k + 0.75) / p.frequency, p.step);
    if (last <= first || last >= wall.size()) break;
    Period period;
    period.start = t[first];
    period.finish = t[last];
    period.force_minimum = (k + 0.25) / p.frequency;
    period.jam_before = x[first];
    period.jam_after = x[last];
    period.elastic_energy = wall[first].elastic_energy;
    period.dx_max =
        *std::max_element(x.begin() + std::ptrdiff_t(first), x.begin() + std::ptrdiff_t(last) + 1) -
        x[first];
    period.active =
        active_phase(t, x, v, f_g, period.start, period.force_minimum - before, period.finish);
    periods.push_back(period);
  }
  return periods;
}

}  // namespace ratcheting
