// SPDX-License-Identifier: MIT
#include "moreau/core/neighbour_cells.hpp"

#include <Eigen/Core>

#include <doctest/doctest.h>
#include <set>
#include <vector>

#include "moreau/core/periodic_cell.hpp"
#include "moreau/core/space.hpp"

using namespace moreau;

TEST_CASE_TEMPLATE(
    "The neighbours of a cell are different, and opposite ones have opposite numbers", S, Space<2>,
    Space<3>) {
  using Vector = typename S::Vector;
  constexpr int count = detail::neighbour_cells<S::dim>();
  static_assert(count == (S::dim == 2 ? 9 : 27));
  std::set<std::vector<double>> found;
  for (int k = 0; k < count; ++k) {
    const auto steps = detail::neighbour_cell<Vector>(k);
    CHECK(steps.cwiseAbs().maxCoeff() <= 1);
    CHECK(steps == -detail::neighbour_cell<Vector>(count - 1 - k));
    CHECK(steps.isZero(0) == (k == count / 2));
    found.insert({steps.data(), steps.data() + S::dim});
  }
  CHECK(found.size() == count);
}

TEST_CASE_TEMPLATE("Points have no images along open axes", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  PeriodicCell<S> cell;
  cell.set(0, 0, 1);
  int images = 0;
  for (int k = 0; k < detail::neighbour_cells<S::dim>(); ++k)
    images += cell.has_image(detail::neighbour_cell<Vector>(k));
  CHECK(images == 3);
  CHECK(cell.has_image(Vector(5 * Vector::UnitX())));
  CHECK(!cell.has_image(Vector(Vector::UnitY())));
}
