// SPDX-License-Identifier: MIT
#include "moreau/detect/broad/periodic_images.hpp"

#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/detect/broad/sweep_and_prune.hpp"

using moreau::Aabb;
using moreau::IndexPair;
using moreau::PeriodicCell;
using moreau::Space;

namespace {

template <class S>
Aabb<S> box_at(const typename S::Vector& center, double half) {
  return {center.array() - half, center.array() + half};
}

}  // namespace

TEST_CASE_TEMPLATE("pairs across the boundary are those of all images", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  PeriodicCell<S> cell;
  cell.set(0, -1, 3);
  cell.set(S::dim - 1, 2, 5);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(-12, 12), size(0.05, 0.6);
  std::vector<Aabb<S>> boxes;
  for (int k = 0; k < 60; ++k) {
    Vector center;
    for (int axis = 0; axis < S::dim; ++axis) center[axis] = anywhere(random);
    boxes.push_back(box_at<S>(center, size(random)));
  }
  moreau::PeriodicImages<S> images;
  moreau::SweepAndPrune<S> broad_phase;
  std::vector<IndexPair> pairs, expected;
  std::vector<Vector> shifts;
  images.find_pairs(cell, std::span<const Aabb<S>>(boxes), broad_phase, pairs, shifts);
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      const Vector a = (boxes[i].lower + boxes[i].upper) / 2;
      const Vector b = (boxes[j].lower + boxes[j].upper) / 2;
      const double half = (boxes[j].upper - boxes[j].lower)[0] / 2;
      if (boxes[i].overlaps(box_at<S>(cell.nearest(b, a), half))) expected.push_back({i, j});
    }
  REQUIRE(pairs == expected);
  REQUIRE(shifts.size() == pairs.size());
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    Aabb<S> second = boxes[pairs[p].second];
    second.lower += shifts[p];
    second.upper += shifts[p];
    CHECK(second.overlaps(boxes[pairs[p].first].inflated(1e-12)));
    CHECK((cell.wrap(shifts[p] + cell.lower()) - cell.lower()).norm() < 1e-9);
  }
}

TEST_CASE("images of a point") {
  PeriodicCell<Space<2>> cell;
  using Vector = Space<2>::Vector;
  CHECK(cell.is_open());
  CHECK(cell.wrap(Vector(7, -8)) == Vector(7, -8));
  CHECK(cell.nearest(Vector(7, -8), Vector(0, 0)) == Vector(7, -8));
  cell.set(0, 1, 3);
  CHECK(cell.wrap(Vector(0.5, 9)) == Vector(2.5, 9));
  CHECK(cell.wrap(Vector(3, 9)) == Vector(1, 9));
  CHECK(cell.image_from(Vector(-5, 0), Vector(2, 9)) == Vector(-4, 9));
  CHECK(cell.nearest(Vector(1.25, 9), Vector(2.75, 0)) == Vector(3.25, 9));
  CHECK_THROWS_WITH_AS(cell.set(0, 3, 1),
                       "PeriodicCell::set: upper = 1 must be finite and above lower",
                       std::invalid_argument);
  cell.set(1, 0, 1);
  CHECK(cell.wrap(Vector(1, -1e-17)) == Vector(1, 0));  // not 1, by rounding
}
