// SPDX-License-Identifier: MIT
#include "periods.hpp"

#include <cmath>
#include <cstddef>

namespace ratcheting {

namespace {

/// Index of the first sample at or after a time; the samples end each step.
std::size_t index_at(const std::vector<WallSample>& wall, double t, double step) {
  const double k = std::round(t / step) - 1;
  return static_cast<std::size_t>(std::clamp(k, 0.0, double(wall.size() - 1)));
}

/// All but the active phase.
Period measure(const std::vector<WallSample>& wall, std::size_t first, std::size_t last) {
  Period period;
  period.start = wall[first].t;
  period.finish = wall[last].t;
  period.jam_before = wall[first].x;
  period.jam_after = wall[last].x;
  std::size_t peak = first;
  for (std::size_t k = first; k <= last; ++k)
    if (wall[k].x > wall[peak].x) peak = k;
  period.peak = wall[peak].t;
  period.dx_max = wall[peak].x - period.jam_before;
  for (std::size_t k = peak; k <= last; ++k)
    period.v_max_passive = std::max(period.v_max_passive, -wall[k].v);
  return period;
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
  for (int k = 1; (k + 0.75) / p.frequency <= p.duration + p.step / 2; ++k) {
    const std::size_t first = index_at(wall, (k - 0.25) / p.frequency, p.step);
    const std::size_t last = index_at(wall, (k + 0.75) / p.frequency, p.step);
    if (last <= first || last >= wall.size()) break;
    Period period = measure(wall, first, last);
    period.force_minimum = (k + 0.25) / p.frequency;
    period.take(
        active_phase(t, x, v, f_g, period.start, period.force_minimum - before, period.finish));
    periods.push_back(period);
  }
  return periods;
}

}  // namespace ratcheting
