// SPDX-License-Identifier: MIT
#include "periods.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ratcheting {

namespace {

/// Index of the first sample at or after a time; the samples end each step.
std::size_t index_at(const std::vector<WallSample>& wall, double t, double step) {
  const double k = std::round(t / step) - 1;
  return static_cast<std::size_t>(std::clamp(k, 0.0, double(wall.size() - 1)));
}

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
  for (std::size_t k = first; k <= peak; ++k)
    period.v_max_active = std::max(period.v_max_active, wall[k].v);
  // While the wall is blocked it creeps; the motion is what goes on to the peak without a halt.
  const double halfway = (wall[peak].x + period.jam_before) / 2;
  std::size_t onset = peak;
  while (onset > first &&
         (wall[onset - 1].x > halfway || wall[onset - 1].v > 0.05 * period.v_max_active))
    --onset;
  period.onset = wall[onset].t;
  std::size_t outward = 0;
  for (std::size_t k = onset; k <= peak; ++k) {
    if (wall[k].v < 0.2 * period.v_max_active) continue;
    period.f_g_active += wall[k].f_g;
    ++outward;
  }
  if (outward > 0) period.f_g_active /= double(outward);
  for (std::size_t k = peak; k <= last; ++k)
    period.v_max_passive = std::max(period.v_max_passive, -wall[k].v);
  return period;
}

}  // namespace

std::vector<Period> find_periods(const std::vector<WallSample>& wall, const Parameters& p) {
  std::vector<Period> periods;
  for (int k = 1; (k + 0.75) / p.frequency <= p.duration + p.step / 2; ++k) {
    const std::size_t first = index_at(wall, (k - 0.25) / p.frequency, p.step);
    const std::size_t last = index_at(wall, (k + 0.75) / p.frequency, p.step);
    if (last <= first || last >= wall.size()) break;
    Period period = measure(wall, first, last);
    period.force_minimum = (k + 0.25) / p.frequency;
    periods.push_back(period);
  }
  return periods;
}

}  // namespace ratcheting
