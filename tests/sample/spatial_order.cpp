// SPDX-License-Identifier: MIT
#include "moreau/sample/spatial_order.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "moreau/core/space.hpp"

using moreau::Space;
using moreau::spatial_order;

namespace {

/// Mean distance of points that follow one another in an order.
template <class Vector>
double mean_distance(const std::vector<Vector>& points, const std::vector<std::size_t>& order) {
  double sum = 0;
  for (std::size_t i = 1; i < order.size(); ++i)
    sum += double((points[order[i]] - points[order[i - 1]]).norm());
  return sum / double(order.size() - 1);
}

}  // namespace

TEST_CASE_TEMPLATE("spatial order: each point once, near the one before", S, Space<2>, Space<3>,
                   Space<3, float>) {
  using Vector = typename S::Vector;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<typename S::Scalar> unit(-1, 1);
  std::vector<Vector> points(4096);
  for (Vector& x : points)
    for (int k = 0; k < S::dim; ++k) x[k] = unit(random);
  const std::vector<std::size_t> order = spatial_order<S>(std::span<const Vector>(points));
  std::vector<std::size_t> sorted = order, all(points.size());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  CHECK(sorted == all);
  // The mean distance of neighbours is about 0.6 of the spacing of the points; at random it is 1.0.
  const double spacing = 2 / std::pow(4096.0, 1.0 / S::dim);
  CHECK(mean_distance(points, order) < 2 * spacing);
  CHECK(mean_distance(points, all) > 6 * spacing / (S::dim - 1));
}

TEST_CASE("spatial order: equal points, no points, points that are not finite") {
  using Vector = Space<3>::Vector;
  std::vector<Vector> points(3, Vector(1, 2, 3));
  CHECK(spatial_order<Space<3>>(std::span<const Vector>(points)) ==
        std::vector<std::size_t>{0, 1, 2});
  CHECK(spatial_order<Space<3>>(std::span<const Vector>()).empty());
  points[1][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(spatial_order<Space<3>>(std::span<const Vector>(points)), std::invalid_argument);
}
