// SPDX-License-Identifier: MIT
#include "moreau/shape/detail/orientation.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <doctest/doctest.h>
#include <random>

namespace {

using moreau::orientation;

int sign(double x) {
  return (x > 0) - (x < 0);
}

/// A random point of a coarse grid, moved by at most one unit, so that many triples are nearly or
/// exactly collinear.
template <int Dim>
Eigen::Matrix<std::int64_t, Dim, 1> random_grid_point(std::int64_t spacing,
                                                      std::mt19937_64& random) {
  std::uniform_int_distribution<std::int64_t> coarse(-2, 2), fine(0, 9);
  Eigen::Matrix<std::int64_t, Dim, 1> x;
  for (int k = 0; k < Dim; ++k) {
    const std::int64_t step = fine(random);
    x[k] = coarse(random) * spacing + (step == 0) - (step == 1);
  }
  return x;
}

// The spacings are the largest for which 64-bit integers represent the determinant exactly. The 53
// bits of a double do not suffice.

TEST_CASE("orientation in the plane: the sign is that of integer arithmetic") {
  std::mt19937_64 random(1);
  const auto point = [&] { return random_grid_point<2>(std::int64_t{1} << 28, random); };
  int zeros = 0, rounded = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    const auto a = point(), b = point(), c = point();
    const auto u = (b - a).eval(), v = (c - a).eval();
    const std::int64_t exact = u.x() * v.y() - u.y() * v.x();
    const double found =
        orientation(a.cast<double>().eval(), b.cast<double>().eval(), c.cast<double>().eval());
    REQUIRE(sign(found) == (exact > 0) - (exact < 0));
    zeros += exact == 0;
    rounded += exact != 0 && std::abs(exact) < (std::int64_t{1} << 9);
  }
  CHECK(zeros > 100);
  CHECK(rounded > 100);
}

TEST_CASE("orientation in space: the sign is that of integer arithmetic") {
  std::mt19937_64 random(2);
  const auto point = [&] { return random_grid_point<3>(std::int64_t{1} << 18, random); };
  int zeros = 0, small = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    const auto a = point(), b = point(), c = point(), d = point();
    const auto u = (b - a).eval(), v = (c - a).eval(), w = (d - a).eval();
    const std::int64_t exact = (u.y() * v.z() - u.z() * v.y()) * w.x() +
                               (u.z() * v.x() - u.x() * v.z()) * w.y() +
                               (u.x() * v.y() - u.y() * v.x()) * w.z();
    const double found = orientation(a.cast<double>().eval(), b.cast<double>().eval(),
                                     c.cast<double>().eval(), d.cast<double>().eval());
    REQUIRE(sign(found) == (exact > 0) - (exact < 0));
    zeros += exact == 0;
    small += exact != 0 && std::abs(exact) < (std::int64_t{1} << 38);
  }
  CHECK(zeros > 100);
  CHECK(small > 100);
}

TEST_CASE("orientation sees the last bit") {
  const double one_up = std::nextafter(1.0, 2.0);
  CHECK(orientation(Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 3), Eigen::Vector2d(1, 1)) == 0);
  CHECK(orientation(Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 3), Eigen::Vector2d(1, one_up)) > 0);
  CHECK(orientation(Eigen::Vector2d(0, 0), Eigen::Vector2d(3, 3), Eigen::Vector2d(one_up, 1)) < 0);

  const Eigen::Vector3d a(0.1, 0.2, 0.3), b(0.7, 0.5, 0.3), c(0.3, 0.9, 0.3);
  CHECK(orientation(a, b, c, Eigen::Vector3d(0.4, 0.4, 0.3)) == 0);
  CHECK(orientation(a, b, c, Eigen::Vector3d(0.4, 0.4, std::nextafter(0.3, 1.0))) > 0);
  CHECK(orientation(a, b, c, Eigen::Vector3d(0.4, 0.4, std::nextafter(0.3, 0.0))) < 0);
}

TEST_CASE("an expansion keeps what a double loses") {
  using moreau::detail::Expansion;
  Expansion e = Expansion::difference(1e100, 1.0);
  e -= Expansion::difference(1e100, 0.0);
  CHECK(e.leading() == -1.0);
  const Expansion tiny = Expansion::difference(1.0, 1.0 + 0x1p-52);
  CHECK((tiny * tiny).leading() == 0x1p-104);
  Expansion square = Expansion::difference(1.0, -0x1p-40);
  square = square * square;
  square -= Expansion::difference(1.0, -0x1p-39);
  CHECK(square.leading() == 0x1p-80);
  CHECK(Expansion().leading() == 0);
}

}  // namespace
