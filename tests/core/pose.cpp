// SPDX-License-Identifier: MIT
#include "moreau/core/pose.hpp"

#include <doctest/doctest.h>
#include <limits>
#include <random>

namespace {

using moreau::Pose;
using moreau::Space;

template <class Matrix>
Matrix uniform(std::mt19937_64& engine, typename Matrix::Scalar scale) {
  std::uniform_real_distribution<typename Matrix::Scalar> distribution(-scale, scale);
  return Matrix::NullaryExpr([&] { return distribution(engine); });
}

TEST_CASE_TEMPLATE("a pose maps body to world and back", S, Space<2>, Space<3>, Space<2, float>,
                   Space<3, float>) {
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::mt19937_64 engine(1);
  for (int i = 0; i < 100; ++i) {
    const Pose<S> pose{uniform<Vector>(engine, T(10)),
                       S::exp(uniform<typename S::Angular>(engine, T(3)))};
    const auto x = uniform<Vector>(engine, T(1));
    const auto y = uniform<Vector>(engine, T(1));
    const T tolerance = 64 * std::numeric_limits<T>::epsilon();
    CHECK((pose.to_body(pose(x)) - x).norm() <= tolerance);
    CHECK((pose(pose.to_body(x)) - x).norm() <= tolerance);
    // A rigid motion preserves distances and maps the origin to the position.
    CHECK(std::abs((pose(x) - pose(y)).norm() - (x - y).norm()) <= tolerance);
    CHECK(pose(Vector::Zero()) == pose.position);
  }
}

TEST_CASE_TEMPLATE("a pose starts as the identity", S, Space<2>, Space<3>) {
  const typename S::Vector x = S::Vector::Constant(0.25);
  CHECK(Pose<S>{}(x) == x);
  CHECK(Pose<S>{}.to_body(x) == x);
}

TEST_CASE_TEMPLATE("is_finite sees position and rotation", S, Space<2>, Space<3>) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Pose<S> pose;
  CHECK(pose.is_finite());
  pose.position[1] = nan;
  CHECK_FALSE(pose.is_finite());
  pose.position[1] = std::numeric_limits<double>::infinity();
  CHECK_FALSE(pose.is_finite());
  pose = Pose<S>{};
  pose.rotation = S::exp(S::Angular::Constant(nan));
  CHECK_FALSE(pose.is_finite());
}

}  // namespace
