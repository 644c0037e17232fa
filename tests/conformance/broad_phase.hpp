// SPDX-License-Identifier: MIT
// The requirements on every broad phase: for boxes of many kinds and in consecutive calls, it finds
// the same pairs as AllPairs. A new broad phase is tested by one line:
//
//   TEST_CASE("mine") { conformance::broad_phase<moreau::Space<3>>(MyBroadPhase()); }
#pragma once

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/detect/broad/all_pairs.hpp"
#include "moreau/detect/broad_phase.hpp"

namespace conformance {

/// @param span    side length of the region in which the lower corners of the boxes lie
/// @param ratio   ratio of the largest to the smallest size. The logarithms of the sizes are
///                uniform, and the largest size is 1
template <class S>
std::vector<moreau::Aabb<S>> random_boxes(std::size_t count, double span, double ratio,
                                          double origin, std::mt19937_64& random) {
  using T = typename S::Scalar;
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<moreau::Aabb<S>> list(count);
  for (auto& box : list) {
    const double size = std::pow(ratio, -uniform(random));
    for (Eigen::Index k = 0; k < S::dim; ++k) {
      box.lower[k] = static_cast<T>(origin + span * uniform(random));
      box.upper[k] = box.lower[k] + static_cast<T>(size * (0.5 + 0.5 * uniform(random)));
    }
  }
  return list;
}

/// Checks that all pairs of these boxes are found, each once and in order, and that earlier
/// contents of the result are removed.
template <class S, class B>
void check_pairs(B& tested, const std::vector<moreau::Aabb<S>>& list) {
  std::vector<moreau::IndexPair> expected, found{{7, 9}};
  moreau::AllPairs<S>().find_pairs(list, expected);
  tested.find_pairs(list, found);
  CHECK(found == expected);
}

/// Boxes that move and change size slightly from call to call, like the boxes of grains.
template <class S, class B>
void check_drifting_boxes(B& tested, std::mt19937_64& random) {
  using T = typename S::Scalar;
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  auto list = random_boxes<S>(200, 6, 3, 0, random);
  for (int call = 0; call < 30; ++call) {
    check_pairs(tested, list);
    for (auto& box : list)
      for (Eigen::Index k = 0; k < S::dim; ++k) {
        const T by = static_cast<T>(shift(random));
        box.lower[k] += by;
        box.upper[k] += by + static_cast<T>(std::abs(shift(random)) / 10);
      }
    if (call == 15)
      // Two boxes exchange their places in the list.
      std::swap(list.front(), list.back());
  }
}

template <class S, class B>
void check_special_boxes(B& tested) {
  using Vector = typename S::Vector;
  std::vector<moreau::Aabb<S>> list;
  for (int i = 0; i < 20; ++i) list.push_back({Vector::Constant(3), Vector::Constant(3)});
  check_pairs(tested, list);  // points, all at the same place
  for (int i = 0; i < 20; ++i) {
    const auto x = static_cast<typename S::Scalar>(i);
    list.push_back({Vector::Constant(x), Vector::Constant(x + 1)});
  }
  check_pairs(tested, list);  // a row of boxes that touch at their corners
  list.push_back({Vector::Constant(-100), Vector::Constant(100)});
  check_pairs(tested, list);  // with one box that contains all others
  for (auto& box : list) box.upper[0] = box.lower[0];
  check_pairs(tested, list);  // with boxes of zero thickness
}

/// Boxes of which a few are far away, along an axis or all axes, alone or in a pair that overlaps, or
/// one is far larger than the others.
template <class S, class B>
void check_lost_boxes(B& tested, std::mt19937_64& random) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  for (const double distance : {1e2, 1e4, 1e6, 1e9, 1e12, 1e30})
    for (int axis = -1; axis < S::dim; ++axis)
      for (const int lost : {1, 2, 20}) {
        auto list = random_boxes<S>(100, 4, 3, distance < 1e3 ? 1e3 : 0, random);
        Vector far = Vector::Zero();
        if (axis < 0)
          far.setConstant(static_cast<T>(-distance));
        else
          far[axis] = static_cast<T>(lost == 2 ? -distance : distance);
        for (std::size_t k = 0; k < std::size_t(lost); ++k) {
          auto& box = list[5 * k];
          box = {box.lower + far, box.upper + far};
        }
        check_pairs(tested, list);
        list[50] = {Vector::Constant(static_cast<T>(-distance)),
                    Vector::Constant(static_cast<T>(distance))};
        check_pairs(tested, list);
      }
}

template <class S, class B>
requires moreau::BroadPhase<B, S>
void broad_phase(B tested) {
  std::mt19937_64 random(1);
  for (const std::size_t count : {0u, 1u, 2u, 10u, 100u, 600u})
    for (const double span : {1.0, 8.0, 100.0})
      for (const double ratio : {1.0, 20.0, 1000.0})
        for (const double origin : {0.0, -3.0, 1e3})
          check_pairs(tested, random_boxes<S>(count, span, ratio, origin, random));
  check_drifting_boxes<S>(tested, random);
  check_special_boxes<S>(tested);
  check_lost_boxes<S>(tested, random);
}

}  // namespace conformance
