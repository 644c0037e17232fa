// SPDX-License-Identifier: MIT
#include "moreau/core/aabb.hpp"

#include <algorithm>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "types.hpp"

namespace {

using moreau::Aabb;
using moreau::Space;

#define MOREAU_SPACES \
  MOREAU_TYPES((Space<2, double>, Space<3, double>), (Space<2, float>, Space<3, float>))

template <class S>
Aabb<S> unit_box_at(const typename S::Vector& corner) {
  return {corner, corner + S::Vector::Ones()};
}

TEST_CASE_TEMPLATE("an empty box overlaps nothing and is neutral under merge", S, MOREAU_SPACES) {
  using Vector = typename S::Vector;
  const Aabb<S> empty;
  const auto box = unit_box_at<S>(Vector::Zero());
  CHECK_FALSE(empty.overlaps(box));
  CHECK_FALSE(box.overlaps(empty));
  CHECK_FALSE(empty.overlaps(empty));
  CHECK(box.contains(empty));
  Aabb<S> point;
  point.merge(Vector::Ones());
  CHECK(point.lower == Vector::Ones());
  CHECK(point.upper == Vector::Ones());
}

TEST_CASE_TEMPLATE("boxes that share a face, an edge or a corner overlap", S, MOREAU_SPACES) {
  using Vector = typename S::Vector;
  const auto box = unit_box_at<S>(Vector::Zero());
  CHECK(box.overlaps(box));
  for (int axis = 0; axis < S::dim; ++axis) {
    for (const int sign : {-1, 1}) {
      const Vector step = Vector::Unit(axis) * typename S::Scalar(sign);
      CHECK(box.overlaps(unit_box_at<S>(step)));
      CHECK_FALSE(box.overlaps(unit_box_at<S>(Vector(step * typename S::Scalar(1.001)))));
    }
  }
  CHECK(box.overlaps(unit_box_at<S>(Vector::Ones())));
}

TEST_CASE_TEMPLATE("overlap is symmetric and agrees with the intervals", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<T> coordinate(-1, 1);
  const auto draw = [&] {
    Aabb<S> box;
    for (int i = 0; i < 2; ++i)
      box.merge(Vector(Vector::NullaryExpr([&] { return coordinate(engine); })));
    return box;
  };
  for (int i = 0; i < 500; ++i) {
    const auto a = draw();
    const auto b = draw();
    bool expected = true;
    for (int k = 0; k < S::dim; ++k)
      expected = expected && std::max(a.lower[k], b.lower[k]) <= std::min(a.upper[k], b.upper[k]);
    CHECK(a.overlaps(b) == expected);
    CHECK(b.overlaps(a) == expected);
    CHECK((!a.contains(b) || a.overlaps(b)));
  }
}

TEST_CASE_TEMPLATE("merge gives the smallest box of the points", S, MOREAU_SPACES) {
  using Vector = typename S::Vector;
  using T = typename S::Scalar;
  Aabb<S> box;
  for (int k = 0; k < S::dim; ++k) {
    box.merge(Vector(Vector::Unit(k) * T(k + 1)));
    box.merge(Vector(Vector::Unit(k) * T(-2)));
  }
  for (int k = 0; k < S::dim; ++k) {
    CHECK(box.lower[k] == T(-2));
    CHECK(box.upper[k] == T(k + 1));
  }
}

TEST_CASE_TEMPLATE("inflated grows every side by the margin", S, MOREAU_SPACES) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  const auto box = unit_box_at<S>(Vector::Zero());
  const auto grown = box.inflated(T(0.5));
  CHECK(grown.lower == Vector::Constant(T(-0.5)));
  CHECK(grown.upper == Vector::Constant(T(1.5)));
  CHECK(grown.contains(box));
  CHECK_FALSE(box.contains(grown));
  CHECK(box.inflated(T(0)).contains(box));
}

}  // namespace
