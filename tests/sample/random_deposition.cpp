// SPDX-License-Identifier: MIT
#include "moreau/sample/random_deposition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "moreau/core/space.hpp"

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using moreau::random_deposition;
using moreau::random_rotation;
using moreau::Space;

}  // namespace

TEST_CASE_TEMPLATE("deposited spheres lie in the box, overlap nowhere and rest on something", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  constexpr int up = S::dim - 1;
  constexpr T length = 1, rounding = 20 * std::numeric_limits<T>::epsilon();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<T> radius(T(0.05), T(0.12));
  std::vector<T> radii(60);
  for (T& r : radii) r = radius(random);
  const auto poses = random_deposition<S>(radii, length, random);
  REQUIRE(poses.size() == radii.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& x = poses[i].position;
    for (int k = 0; k < up; ++k) {
      CHECK(x[k] >= radii[i] - rounding);
      CHECK(x[k] <= length - radii[i] + rounding);
    }
    T nearest = x[up] - radii[i];  // gap to the floor
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, (poses[j].position - x).norm() - radii[i] - radii[j]);
    CHECK(nearest >= -rounding);
    CHECK(nearest <= rounding);
  }
}

TEST_CASE("a floor with two lengths is filled to both, and nowhere overlaps a sphere another") {
  using S = Space<3>;
  std::mt19937_64 random(3);
  const std::vector<double> radii(400, 0.1);
  for (const std::array<double, 2>& lengths : {std::array{2.0, 0.5}, {0.5, 2.0}, {0.2, 3.0}}) {
    const auto poses = random_deposition<S>(radii, lengths, random);
    S::Vector least = poses[0].position, most = poses[0].position;
    double nearest = 1;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      least = least.cwiseMin(poses[i].position);
      most = most.cwiseMax(poses[i].position);
      for (std::size_t j = 0; j < i; ++j)
        nearest = std::min(nearest, (poses[i].position - poses[j].position).norm());
    }
    CHECK(nearest >= 0.2 - 1e-12);
    for (int k = 0; k < 2; ++k) {
      CHECK(least[k] >= 0.1 - 1e-12);
      CHECK(least[k] <= 0.12);
      CHECK(most[k] <= lengths[std::size_t(k)] - 0.1 + 1e-12);
      CHECK(most[k] >= lengths[std::size_t(k)] - 0.12);
    }
  }
}

TEST_CASE_TEMPLATE("a round floor holds all spheres, and a floor that is too small is refused", S,
                   MOREAU_TYPES((Space<2>, Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  std::mt19937_64 random(4);
  const std::vector<T> radii(100, T(0.1));
  std::array<T, std::size_t(S::dim - 1)> lengths;
  lengths.fill(T(1));
  const auto poses = random_deposition<S>(radii, lengths, random, moreau::round_floor<S>(T(1)));
  T farthest = 0;
  for (const auto& pose : poses) {
    typename S::Vector aside = pose.position - S::Vector::Constant(T(0.5));
    aside[S::dim - 1] = 0;
    farthest = std::max(farthest, aside.norm());
  }
  CHECK(farthest <= T(0.4) + 20 * std::numeric_limits<T>::epsilon());
  CHECK(farthest > T(0.36));
  CHECK_THROWS_WITH_AS(random_deposition<S>(radii, lengths, random,
                                            [](const typename S::Vector&, T) { return false; }),
                       doctest::Contains("must leave room above the floor"), std::invalid_argument);
}

TEST_CASE("the same seed gives the same sample") {
  const std::vector<double> radii(20, 0.1);
  std::mt19937_64 one(5), two(5), three(6);
  const auto a = random_deposition<Space<3>>(radii, 1, one);
  const auto b = random_deposition<Space<3>>(radii, 1, two);
  const auto c = random_deposition<Space<3>>(radii, 1, three);
  for (std::size_t i = 0; i < radii.size(); ++i) {
    CHECK(a[i].position == b[i].position);
    CHECK(a[i].rotation.coeffs() == b[i].rotation.coeffs());
    CHECK(a[i].position != c[i].position);
  }
}

TEST_CASE("radii that do not fit are refused by their number") {
  std::mt19937_64 random(1);
  const auto said = [&](const std::vector<double>& radii, double length) {
    return message_of([&] { random_deposition<Space<2>>(radii, length, random); });
  };
  CHECK(said({0.1, 0.6}, 1).find("random_deposition: radii[1] = 0.6") != std::string::npos);
  CHECK(said({-0.1}, 1).find("radii[0] = -0.1") != std::string::npos);
  CHECK(said({std::nan("")}, 1).find("radii[0]") != std::string::npos);
  CHECK(said({0.1}, std::nan("")).find("length") != std::string::npos);
  CHECK(said({0.5}, 1) == "nothing thrown");
}

TEST_CASE_TEMPLATE(
    "random rotations are normalized; the mean is 0 in the plane and 1/27 of the identity in space",
    S, MOREAU_TYPES((Space<2>, Space<3>), (Space<3, float>))) {
  using T = typename S::Scalar;
  constexpr int count = 4000;
  std::mt19937_64 random(2);
  typename S::Matrix sum = S::Matrix::Zero();
  for (int k = 0; k < count; ++k) {
    const typename S::Matrix q = random_rotation<S>(random).toRotationMatrix();
    CHECK((q * q.transpose() - S::Matrix::Identity()).norm() <
          10 * std::numeric_limits<T>::epsilon());
    sum += q;
  }
  sum = sum / T(count) - (S::dim == 3 ? T(1) / 27 : T(0)) * S::Matrix::Identity();
  // Each entry has the variance 1/dim; the limit is four standard errors.
  CHECK(sum.cwiseAbs().maxCoeff() < 4 / std::sqrt(T(S::dim) * T(count)));
}
