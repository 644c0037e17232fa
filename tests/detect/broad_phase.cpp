// SPDX-License-Identifier: MIT
#include "conformance/broad_phase.hpp"

#include <ctime>
#include <limits>
#include <span>
#include <vector>

#include "moreau/core/periodic_cell.hpp"
#include "moreau/detect/broad/cell_grid.hpp"
#include "moreau/detect/broad/periodic_images.hpp"
#include "moreau/detect/broad/sweep_and_prune.hpp"

#include "types.hpp"

using moreau::CellGrid;
using moreau::Space;
using moreau::SweepAndPrune;

TEST_CASE_TEMPLATE("broad phases find what all pairs finds", S,
                   MOREAU_TYPES((Space<2, double>, Space<3, double>),
                                (Space<2, float>, Space<3, float>))) {
  conformance::broad_phase<S>(SweepAndPrune<S>());
  conformance::broad_phase<S>(CellGrid<S>());
}

namespace {

/// Boxes of edge 1 in a heap of 8 x 8 columns (in the plane 64), so that it is highest along the last
/// axis; each overlaps its neighbours.
template <class S>
std::vector<moreau::Aabb<S>> heap_of_boxes(std::size_t count) {
  using Vector = typename S::Vector;
  std::vector<moreau::Aabb<S>> list;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t wide = S::dim == 3 ? 8 : 64;
    Vector x;
    std::size_t rest = k;
    for (int axis = 0; axis < S::dim; ++axis, rest /= wide)
      x[axis] = static_cast<typename S::Scalar>(axis + 1 < S::dim ? rest % wide : rest);
    list.push_back(
        {typename S::Scalar(0.9) * x, typename S::Scalar(0.9) * x + Vector::Constant(1)});
  }
  return list;
}

/// CPU time of a call [s], of the best of three.
template <class Call>
double cpu_time(const Call& call) {
  double best = 1e9;
  for (int k = 0; k < 3; ++k) {
    const std::clock_t begin = std::clock();
    call();
    best = std::min(best, double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return best;
}

/// A few boxes of a heap are lost, in many ways: nothing takes more time, and the pairs of the others
/// are found.
template <class S, class B>
void check_cost_of_lost_boxes() {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const auto heap = heap_of_boxes<S>(8000);
  std::vector<moreau::IndexPair> pairs;
  B broad;
  const auto time = [&](const std::vector<moreau::Aabb<S>>& list) {
    return cpu_time([&] { broad.find_pairs(std::span<const moreau::Aabb<S>>(list), pairs); });
  };
  const double alone = time(heap);
  const std::size_t count = pairs.size();
  CHECK(count > 24000);
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  for (const T distance : {T(1e4), T(1e7), T(1e9), T(1e25), -T(1e9), nan, inf, -inf})
    for (int axis = -1; axis < S::dim; ++axis)
      for (const std::size_t lost : {std::size_t(1), std::size_t(3)}) {
        CAPTURE(distance);
        CAPTURE(axis);
        auto list = heap;
        for (std::size_t k = 0; k < lost; ++k) {
          auto& box = list[100 + 1000 * k];
          Vector far = Vector::Zero();
          if (axis < 0)
            far.setConstant(distance * T(k + 1));
          else
            far[axis] = distance * T(k + 1);
          box = {box.lower + far, box.upper + far};
        }
        CHECK(time(list) < 4 * alone + 0.005);
        CHECK(pairs.size() < count);
        CHECK(pairs.size() + 30 * lost > count);
      }
  for (const T size : {T(1e-3), T(1e-9), T(0), T(1e3), T(1e6)}) {  // one of another size
    auto list = heap;
    list[77].upper = list[77].lower + Vector::Constant(size);
    CHECK(time(list) < 4 * alone + 0.005);
    CHECK(pairs.size() + 30 > count);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("a lost box costs nothing", S, Space<2>, Space<3>, Space<3, float>) {
  check_cost_of_lost_boxes<S, CellGrid<S>>();
  check_cost_of_lost_boxes<S, SweepAndPrune<S>>();
}

TEST_CASE_TEMPLATE("boxes that are infinite or not numbers", S, Space<2>, Space<3, float>) {
  using T = typename S::Scalar;
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  CellGrid<S> grid;
  SweepAndPrune<S> sweep;
  for (const T low : {nan, -inf, T(0)})
    for (const T high : {nan, inf, T(3)})
      for (int axis = 0; axis < S::dim; ++axis)
        for (const std::size_t how_many : {std::size_t(1), std::size_t(2), std::size_t(70)}) {
          auto list = heap_of_boxes<S>(70);
          for (std::size_t k = 0; k < how_many; ++k) {
            list[k].lower[axis] = low;
            list[k].upper[axis] = high;
          }
          conformance::check_pairs(grid, list);
          conformance::check_pairs(sweep, list);
        }
}

TEST_CASE_TEMPLATE("a lost box costs nothing in a periodic cell", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  const auto heap = heap_of_boxes<S>(8000);
  moreau::PeriodicCell<S> cell;
  for (int axis = 0; axis + 1 < S::dim; ++axis) cell.set(axis, 0, S::dim == 3 ? 7.2 : 57.6);
  moreau::PeriodicImages<S> images;
  CellGrid<S> grid;
  std::vector<moreau::IndexPair> pairs;
  std::vector<Vector> shifts;
  const auto time = [&](const std::vector<moreau::Aabb<S>>& list) {
    return cpu_time([&] {
      images.find_pairs(cell, std::span<const moreau::Aabb<S>>(list), grid, pairs, shifts);
    });
  };
  const double alone = time(heap);
  const std::size_t count = pairs.size();
  for (const double distance : {1e5, -1e9, 1e15})
    for (int axis = 0; axis < S::dim; ++axis) {
      auto list = heap;
      list[123].lower[axis] += distance;
      list[123].upper[axis] += distance;
      CHECK(time(list) < 4 * alone + 0.005);
      CHECK(pairs.size() + 30 > count);
    }
}
