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

/// Boxes in and around the cells of the tests.
template <class S>
std::vector<Aabb<S>> random_boxes() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(-12, 12), size(0.05, 0.6);
  std::vector<Aabb<S>> boxes;
  for (int k = 0; k < 60; ++k) {
    typename S::Vector center;
    for (int axis = 0; axis < S::dim; ++axis) center[axis] = anywhere(random);
    boxes.push_back(box_at<S>(center, size(random)));
  }
  return boxes;
}

}  // namespace

TEST_CASE_TEMPLATE("pairs across the boundary are those of all images", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  PeriodicCell<S> cell;
  cell.set(0, -1, 3);
  cell.set(S::dim - 1, 2, 5);
  const std::vector<Aabb<S>> boxes = random_boxes<S>();
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

namespace {

/// Vectors of a cell that is neither a box nor thin.
template <class S>
typename S::Matrix oblique() {
  typename S::Matrix vectors = 4 * S::Matrix::Identity();
  vectors(0, 1) = 1.1;
  vectors(1, 0) = -0.3;
  vectors(S::dim - 1, 0) += 0.4;
  return vectors;
}
/// Calls use(n) for all vectors n of whole numbers from -most to most.
template <class S>
void for_cells(int most, const auto& use) {
  int count = 1;
  for (int axis = 0; axis < S::dim; ++axis) count *= 2 * most + 1;
  for (int code = 0; code < count; ++code) {
    typename S::Vector n;
    for (int axis = 0, rest = code; axis < S::dim; ++axis, rest /= 2 * most + 1)
      n[axis] = rest % (2 * most + 1) - most;
    use(n);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("pairs in a lattice are those of all images", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  PeriodicCell<S> cell;
  cell.set_vectors(oblique<S>(), Vector::Constant(-0.7));
  cell.require_room(1.2, "test");
  const std::vector<Aabb<S>> boxes = random_boxes<S>();
  moreau::PeriodicImages<S> images;
  moreau::SweepAndPrune<S> broad_phase;
  std::vector<IndexPair> pairs, expected;
  std::vector<Vector> shifts, of_expected;
  images.find_pairs(cell, std::span<const Aabb<S>>(boxes), broad_phase, pairs, shifts);
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      for_cells<S>(9, [&](const Vector& n) {
        const Vector shift = cell.vectors() * n;
        if (!boxes[i].overlaps(Aabb<S>{boxes[j].lower + shift, boxes[j].upper + shift})) return;
        expected.push_back({i, j});
        of_expected.push_back(shift);
      });
  REQUIRE(expected.size() > 40);
  REQUIRE(pairs == expected);
  for (std::size_t p = 0; p < pairs.size(); ++p) CHECK((shifts[p] - of_expected[p]).norm() < 1e-12);
}

TEST_CASE_TEMPLATE("images of a point in a lattice", S, Space<2>, Space<3>) {
  using Vector = typename S::Vector;
  using Matrix = typename S::Matrix;
  PeriodicCell<S> cell;
  const Vector lower = Vector::Constant(-0.7);
  cell.set_vectors(oblique<S>(), lower);
  CHECK(cell.is_lattice());
  CHECK(!cell.is_open());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> anywhere(-12, 12);
  const auto is_whole = [&](const Vector& displacement) {
    const Vector n = cell.vectors().inverse() * displacement;
    return (n - Vector(n.array().round())).norm() < 1e-12;
  };
  for (int k = 0; k < 30; ++k) {
    Vector x, to;
    for (int axis = 0; axis < S::dim; ++axis)
      x[axis] = anywhere(random), to[axis] = anywhere(random);
    const Vector home = cell.wrap(x), part = cell.vectors().inverse() * (home - lower);
    CHECK(is_whole(home - x));
    CHECK(part.minCoeff() > -1e-12);
    CHECK(part.maxCoeff() < 1 + 1e-12);
    CHECK((x - home - cell.shift(cell.cell_of(x))).norm() < 1e-12);
    const Vector near = cell.nearest(x, to);
    CHECK(is_whole(near - x));
    double least = 1e9;
    for_cells<S>(
        9, [&](const Vector& n) { least = std::min(least, (x + cell.vectors() * n - to).norm()); });
    CHECK((near - to).norm() == doctest::Approx(least));
  }
  // Reduction: a cell that was sheared by whole multiples of its vectors.
  PeriodicCell<S> thin;
  Matrix vectors = oblique<S>();
  vectors.col(1) += 3 * vectors.col(0);
  vectors.col(0) -= 2 * vectors.col(S::dim - 1);
  thin.set_vectors(vectors, lower);
  CHECK_THROWS_AS(thin.require_room(1.2, "test"), std::invalid_argument);
  CHECK(thin.reduce());
  CHECK(!thin.reduce());
  thin.require_room(1.2, "test");
  CHECK(thin.volume() == doctest::Approx(cell.volume()));
  for (int axis = 0; axis < S::dim; ++axis) CHECK(is_whole(thin.vectors().col(axis)));
  // Deformation: the corner stays, and so does the number of each cell.
  Matrix map = Matrix::Identity();
  map(0, 1) = 0.2;
  const Vector x = Vector::Constant(5.3), n = cell.cell_of(x);
  const Matrix increment = map - Matrix::Identity();
  cell.deform(increment);
  CHECK((cell.vectors() - map * oblique<S>()).norm() < 1e-14);
  CHECK(cell.cell_of(cell.deformed(increment, x)) == n);
  CHECK(cell.deformed(increment, lower) == lower);
  CHECK_THROWS_AS(cell.set(0, 0, 1), std::invalid_argument);
}

TEST_CASE(
    "a reduced lattice has its shortest vectors, also where vectors have angles near 120 degrees") {
  using S = Space<3>;
  using Vector = S::Vector;
  S::Matrix star;  // all scalar products are about -0.45: only the sum of all three is shorter
  star << 1, -0.45, -0.45, 0, 0.893, -0.73, 0, 0, 0.514;
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 200; ++trial) {
    S::Matrix vectors = star;
    if (trial > 0)
      for (int k = 0; k < 9; ++k) vectors(k) = number(random);
    if (vectors.determinant() < 0) vectors.col(0) = -vectors.col(0);
    if (vectors.determinant() < 0.02) continue;
    PeriodicCell<S> cell;
    cell.set_vectors(vectors, Vector(Vector::Zero()));
    const bool changed = cell.reduce();
    if (trial == 0) CHECK(changed);
    const S::Matrix reduced = cell.vectors();
    CHECK(reduced.determinant() == doctest::Approx(vectors.determinant()));
    double shortest = 1e9, found = 1e9;
    for_cells<S>(4, [&](const Vector& n) {
      if (!n.isZero(0)) shortest = std::min(shortest, (reduced * n).norm());
      for (int k = 0; k < 3; ++k)  // Minkowski's conditions
        if (std::abs(n[k]) == 1) CHECK((reduced * n).norm() > 0.98 * reduced.col(k).norm());
    });
    for (int k = 0; k < 3; ++k) found = std::min(found, reduced.col(k).norm());
    CHECK(found == doctest::Approx(shortest).epsilon(0.01));
  }
}
