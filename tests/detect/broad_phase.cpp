// SPDX-License-Identifier: MIT
#include "moreau/detect/broad_phase.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/detect/all_pairs.hpp"
#include "moreau/detect/cell_grid.hpp"
#include "moreau/detect/sweep_and_prune.hpp"

using namespace moreau;

namespace {

/// @param span    side of the region the boxes lie in
/// @param ratio   largest to smallest size, drawn evenly by logarithm; the largest is 1
template <class S>
std::vector<Aabb<S>> boxes(std::size_t count, double span, double ratio, double origin,
                           std::mt19937_64& random) {
  using T = typename S::Scalar;
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Aabb<S>> list(count);
  for (auto& box : list) {
    const double size = std::pow(ratio, -uniform(random));
    for (Eigen::Index k = 0; k < S::dim; ++k) {
      box.lower[k] = static_cast<T>(origin + span * uniform(random));
      box.upper[k] = box.lower[k] + static_cast<T>(size * (0.5 + 0.5 * uniform(random)));
    }
  }
  return list;
}

template <class S, template <class> class Tested>
void check(Tested<S>& tested, const std::vector<Aabb<S>>& list) {
  static_assert(BroadPhase<Tested<S>, S>);
  std::vector<IndexPair> expected, found{{7, 9}};
  AllPairs<S>().find_pairs(list, expected);
  tested.find_pairs(list, found);
  CHECK(found == expected);
}

template <class S, template <class> class Tested>
void check_on_random_boxes() {
  std::mt19937_64 random(1);
  Tested<S> tested;
  for (const std::size_t count : {0u, 1u, 2u, 10u, 100u, 600u})
    for (const double span : {1.0, 8.0, 100.0})
      for (const double ratio : {1.0, 20.0, 1000.0})
        for (const double origin : {0.0, -3.0, 1e3})
          check(tested, boxes<S>(count, span, ratio, origin, random));
}

template <class S, template <class> class Tested>
void check_on_special_boxes() {
  using Vector = typename S::Vector;
  Tested<S> tested;
  std::vector<Aabb<S>> list;
  for (int i = 0; i < 20; ++i) list.push_back({Vector::Constant(3), Vector::Constant(3)});
  check(tested, list);  // points, all in one place
  for (int i = 0; i < 20; ++i) {
    const auto x = static_cast<typename S::Scalar>(i);
    list.push_back({Vector::Constant(x), Vector::Constant(x + 1)});
  }
  check(tested, list);  // a row of boxes that touch, corner to corner
  list.push_back({Vector::Constant(-100), Vector::Constant(100)});
  check(tested, list);  // one around all
  for (auto& box : list) box.upper[0] = box.lower[0];
  check(tested, list);  // flat ones
}

template <template <class> class Tested>
void check_all() {
  check_on_random_boxes<Space<2, double>, Tested>();
  check_on_random_boxes<Space<3, double>, Tested>();
  check_on_random_boxes<Space<2, float>, Tested>();
  check_on_random_boxes<Space<3, float>, Tested>();
  check_on_special_boxes<Space<2, double>, Tested>();
  check_on_special_boxes<Space<3, float>, Tested>();
}

}  // namespace

TEST_CASE("sweep and prune finds what all pairs finds") {
  check_all<SweepAndPrune>();
}
TEST_CASE("cell grid finds what all pairs finds") {
  check_all<CellGrid>();
}
