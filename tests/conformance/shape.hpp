// SPDX-License-Identifier: MIT
// What the library takes for granted of a convex shape, whatever it is. One line for a shape:
//
//     TEST_CASE("my shape") { conformance::check_shape(MyShape(..)); }
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <vector>

#include "moreau/shape/concepts.hpp"
#include "moreau/shape/support_box.hpp"

namespace conformance {

template <class S>
typename S::Vector random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  typename S::Vector v;
  do {
    for (auto& x : v) x = static_cast<typename S::Scalar>(normal(random));
  } while (v.norm() < 1e-3);
  return v.normalized();
}

template <class S>
moreau::Pose<S> random_pose(std::mt19937_64& random) {
  typename S::Angular turn;
  std::uniform_real_distribution<double> angle(-2, 2);
  for (auto& w : turn) w = static_cast<typename S::Scalar>(angle(random));
  return {random_direction<S>(random), S::exp(turn)};
}

/// Differences of lengths that rounding may make, relative to the size.
template <class ShapeT>
constexpr double rounding() {
  return 256 * std::numeric_limits<typename ShapeT::Space::Scalar>::epsilon();
}

/// Mass and inertia of a body that can exist, about the origin, proportional to the density.
template <class ShapeT>
void check_mass(const ShapeT& shape, double size) {
  using S = typename ShapeT::Space;
  using T = typename S::Scalar;
  using Inertia = typename S::Inertia;
  const auto mass = shape.mass_properties(T(3));
  const auto denser = shape.mass_properties(T(6));
  CHECK(mass.mass > 0);
  CHECK(mass.center.norm() <= rounding<ShapeT>() * size);
  CHECK(denser.mass == doctest::Approx(2 * mass.mass).epsilon(rounding<ShapeT>()));
  CHECK((denser.inertia - 2 * mass.inertia).norm() <= rounding<ShapeT>() * mass.inertia.norm());
  CHECK((mass.inertia - mass.inertia.transpose()).norm() <=
        rounding<ShapeT>() * mass.inertia.norm());
  const auto principal = Eigen::SelfAdjointEigenSolver<Inertia>(mass.inertia).eigenvalues().eval();
  CHECK(principal.minCoeff() > 0);
  // What is left of the trace is at least as large: the principal values are sums of two moments.
  if (principal.size() > 1)
    CHECK(principal.sum() - 2 * principal.maxCoeff() >= -rounding<ShapeT>() * principal.maxCoeff());
  CHECK(double(principal.maxCoeff()) <= double(mass.mass) * size * size);
}

/// Farthest points, whatever the length of the direction; together they are the boundary.
template <class ShapeT>
std::vector<typename ShapeT::Vector> check_support(const ShapeT& shape, double size,
                                                   std::mt19937_64& random) {
  using S = typename ShapeT::Space;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::vector<Vector> directions, points;
  for (int axis = 0; axis < S::dim; ++axis) {
    directions.push_back(Vector::Unit(axis));
    directions.push_back(-Vector::Unit(axis));
  }
  for (int i = 0; i < 100; ++i) directions.push_back(random_direction<S>(random));
  for (const Vector& d : directions) points.push_back(shape.support(d));
  double worst = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vector d = directions[i];
    CHECK(d.dot(points[i]) > 0);  // the centre of mass is inside
    worst = std::max(worst, double(d.dot(points[i] - shape.support(T(1e-3) * d))));
    for (const Vector& x : points) worst = std::max(worst, double(d.dot(x - points[i])));
  }
  CHECK(worst <= rounding<ShapeT>() * size);
  return points;
}

/// Around the farthest points, and no larger than that.
template <class ShapeT>
void check_box(const ShapeT& shape, double size, std::mt19937_64& random) {
  using S = typename ShapeT::Space;
  for (int i = 0; i < 10; ++i) {
    const auto pose = i == 0 ? moreau::Pose<S>{} : random_pose<S>(random);
    const auto box = shape.bounding_box(pose), tight = moreau::support_box(shape, pose);
    CHECK((box.lower - tight.lower).norm() <= rounding<ShapeT>() * (size + 1));
    CHECK((box.upper - tight.upper).norm() <= rounding<ShapeT>() * (size + 1));
  }
}

/// Members that not every shape has.
template <class ShapeT>
void check_members(const ShapeT& shape, const std::vector<typename ShapeT::Vector>& points,
                   double size, std::mt19937_64& random) {
  using S = typename ShapeT::Space;
  using T = typename S::Scalar;
  const double close = rounding<ShapeT>();
  const auto mass = shape.mass_properties(T(1));
  if constexpr (requires { shape.volume(); })
    CHECK(mass.mass == doctest::Approx(shape.volume()).epsilon(close));
  if constexpr (requires { shape.circumradius(); })
    for (const auto& x : points) CHECK(x.norm() <= shape.circumradius() + close * size);
  if constexpr (requires { shape.inradius(); })
    for (int i = 0; i < 20; ++i) {
      const auto d = random_direction<S>(random);
      CHECK(d.dot(shape.support(d)) >= shape.inradius() - close * size);
    }
  if constexpr (requires { shape.scaled(T(2)); }) {
    const auto twice = shape.scaled(T(2));
    const auto its = twice.mass_properties(T(1));
    CHECK(its.mass == doctest::Approx(std::pow(2, S::dim) * mass.mass).epsilon(close));
    CHECK((its.inertia - T(std::pow(2, S::dim + 2)) * mass.inertia).norm() <=
          close * its.inertia.norm());
    const auto d = random_direction<S>(random);
    CHECK((twice.support(d) - 2 * shape.support(d)).norm() <= 2 * close * size);
  }
}

template <moreau::ConvexShape ShapeT>
void check_shape(const ShapeT& shape) {
  std::mt19937_64 random(1);
  double size = 0;
  for (int i = 0; i < 200; ++i)
    size = std::max(size,
                    double(shape.support(random_direction<typename ShapeT::Space>(random)).norm()));
  size *= 1.5;  // the largest reach may be between these directions
  check_mass(shape, size);
  const auto points = check_support(shape, size, random);
  check_box(shape, size, random);
  check_members(shape, points, size, random);
}

}  // namespace conformance
