// SPDX-License-Identifier: MIT
// The part of check() that names a grain which has left all others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "moreau/measure/detail/check_report.hpp"

namespace moreau::detail {

/// The element in the middle of the order, the lower one of two; changes the order.
template <class T>
T lower_median(std::vector<T>& values) {
  const auto middle = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Names the grain that is farthest from the others, if it is lost. The distance of a grain is the
/// largest component of its distance from the median of the positions, in the periodic cell; it is lost
/// if this exceeds 100 times the median of these distances and 100 grain sizes (10,000 among fewer than
/// ten grains).
template <class Simulation>
[[gnu::cold]] void check_lost(Findings& found, const Simulation& simulation) {
  using Scalar = typename Simulation::Scalar;
  using Vector = typename Simulation::Vector;
  const std::size_t count = simulation.grain_count();
  if (count == 0) return;
  const auto position = [&](std::size_t k) -> const Vector& {
    return simulation.bodies().pose[simulation.grain(k).index()].position;
  };
  const auto place = [&](std::size_t k) -> Vector { return simulation.cell().wrap(position(k)); };
  const Scalar size = simulation.grain_size();
  std::vector<Scalar> values(count);
  Vector middle;
  for (int axis = 0; axis < Simulation::S::dim; ++axis) {
    for (std::size_t k = 0; k < count; ++k) values[k] = place(k)[axis];
    middle[axis] = lower_median(values);
  }
  std::size_t farthest = 0, outermost = 0;
  Scalar most = -1, out = 0;
  for (std::size_t k = 0; k < count; ++k) {
    values[k] = Vector(place(k) - middle).cwiseAbs().maxCoeff();
    if (values[k] > most) most = values[k], farthest = k;
    // Poses are stored as they are, not wrapped into the cell.
    const Scalar away = position(k).cwiseAbs().maxCoeff();
    if (away > out) out = away, outermost = k;
  }
  const Scalar spread = lower_median(values);
  if (most > 100 * spread && most > Scalar(count < 10 ? 10000 : 100) * size)
    found.say(
        "grain % is lost: % m from the middle of the grains, half of which lie within % m. Remove "
        "it",
        {double(simulation.grain(farthest).index()), double(most), double(spread)});
  const Scalar grid = out * std::numeric_limits<Scalar>::epsilon();
  if (grid > Scalar(1e-3) * size)
    found.say(
        "grain % is % m from the origin, where positions are known to % m only, % of the grain "
        "size. "
        "Place the origin nearer, move grains by whole periodic cells (set_pose), or take double",
        {double(simulation.grain(outermost).index()), double(out), double(grid),
         double(grid / size)});
}

}  // namespace moreau::detail
