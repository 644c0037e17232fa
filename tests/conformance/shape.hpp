// SPDX-License-Identifier: MIT
// The requirements of the library on every convex shape, and on grains of parts (check_grain()). A
// shape is tested by one line:
//     TEST_CASE("my shape") { conformance::check_shape(MyShape(..)); }
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "moreau/shape/concepts.hpp"
#include "moreau/shape/support_box.hpp"

#include "conformance/random_direction.hpp"

namespace conformance {

template <class S>
moreau::Pose<S> random_pose(std::mt19937_64& random) {
  typename S::Angular turn;
  std::uniform_real_distribution<double> angle(-2, 2);
  for (auto& w : turn) w = static_cast<typename S::Scalar>(angle(random));
  return {random_direction<S>(random), S::exp(turn)};
}

/// Relative difference that rounding errors may cause.
template <class ShapeT>
constexpr double rounding() {
  return 256 * std::numeric_limits<typename ShapeT::Space::Scalar>::epsilon();
}

// These functions are not templates, because templates would increase the compile time.
inline void expect_at_most(const char* what, double value, double limit) {
  INFO(std::string(what));
  CHECK(value <= limit);
}
inline void expect_positive(const char* what, double value) {
  INFO(std::string(what));
  CHECK(value > 0);
}
inline void check_principal(const Eigen::Matrix<double, 1, 1>& inertia, double) {
  expect_positive("inertia", inertia(0, 0));
}
inline void check_principal(const Eigen::Matrix3d& inertia, double rounding) {
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  expect_positive("least principal moment of inertia", principal[0]);
  // Each principal moment of inertia is the sum of two of the three second moments. So the largest
  // principal moment is at most the sum of the other two.
  expect_at_most("largest less the sum of the others", principal[2] - principal[1] - principal[0],
                 rounding * principal[2]);
}

/// Checks that mass and inertia are possible for a real body, that the centre of mass is the
/// origin, and that they are proportional to the density.
template <class ShapeT>
void check_mass(const ShapeT& shape, double size) {
  using T = typename ShapeT::Space::Scalar;
  constexpr double close = rounding<ShapeT>();
  const auto mass = shape.mass_properties(T(3)), denser = shape.mass_properties(T(6));
  const double inertia = mass.inertia.norm();
  expect_positive("mass", mass.mass);
  expect_at_most("centre of mass from the origin", mass.center.norm(), close * size);
  expect_at_most("mass at twice the density", std::abs(denser.mass - 2 * mass.mass),
                 close * mass.mass);
  expect_at_most("inertia at twice the density", (denser.inertia - 2 * mass.inertia).norm(),
                 close * inertia);
  expect_at_most("asymmetry", (mass.inertia - mass.inertia.transpose()).norm(), close * inertia);
  expect_at_most("inertia", inertia, 2 * mass.mass * size * size);
  check_principal(mass.inertia.template cast<double>().eval(), close);
}

/// Checks that support points are farthest in their direction, and do not depend on the length of
/// the direction.
/// @returns support points in many directions
template <class ShapeT>
std::vector<typename ShapeT::Space::Vector> check_support(const ShapeT& shape, double size,
                                                          std::mt19937_64& random) {
  using S = typename ShapeT::Space;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  std::vector<Vector> directions, points;
  for (int axis = 0; axis < S::dim; ++axis)
    for (const T sign : {T(-1), T(1)}) directions.push_back(sign * Vector::Unit(axis));
  for (int i = 0; i < 100; ++i) directions.push_back(random_direction<S>(random));
  for (const Vector& d : directions) points.push_back(shape.support(d));
  T higher = 0, depends = 0, inside = std::numeric_limits<T>::infinity();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vector d = directions[i];
    const T height = d.dot(points[i]);
    inside = std::min(inside, height);
    depends = std::max(depends, height - d.dot(shape.support(T(1e-3) * d)));
    for (const Vector& x : points) higher = std::max(higher, d.dot(x) - height);
  }
  expect_positive("depth of the centre of mass", inside);
  expect_at_most("a point higher than the support", higher, rounding<ShapeT>() * size);
  expect_at_most("support for a short direction", depends, rounding<ShapeT>() * size);
  return points;
}

/// Estimates of the volume [m^D], the centroid [m] and the second moments divided by the volume
/// [m^2], about the origin, of the body given by the support function. The grid cells on the inner
/// side of all supporting planes in random directions are counted. For a body with flat faces the
/// result is about a fifth too large, because there are only finitely many directions.
template <class S>
struct Described {
  double volume = 0;
  Eigen::Matrix<double, S::dim, 1> centre = Eigen::Matrix<double, S::dim, 1>::Zero();
  Eigen::Matrix<double, S::dim, S::dim> second = Eigen::Matrix<double, S::dim, S::dim>::Zero();
};
template <class ShapeT>
Described<typename ShapeT::Space> described(const ShapeT& shape, std::mt19937_64& random) {
  using S = typename ShapeT::Space;
  constexpr int per_axis = S::angular_dim > 1 ? 20 : 60, planes = S::angular_dim > 1 ? 300 : 60;
  using V = Eigen::Matrix<double, S::dim, 1>;
  std::vector<V> normals;
  std::vector<double> heights;
  for (int i = 0; i < planes; ++i) {
    const auto d = random_direction<S>(random);
    normals.push_back(d.template cast<double>());
    heights.push_back(double(d.dot(shape.support(d))));
  }
  const auto box = moreau::support_box(shape, moreau::Pose<S>{});
  const V lower = box.lower.template cast<double>();
  const V cell = (box.upper - box.lower).template cast<double>() / per_axis;
  Described<S> body;
  std::size_t inside = 0;
  for (int k = 0; k < std::pow(per_axis, int(S::dim)); ++k) {
    V x;
    for (int axis = 0, rest = k; axis < S::dim; ++axis, rest /= per_axis)
      x[axis] = lower[axis] + cell[axis] * (rest % per_axis + 0.5);
    bool within = true;
    for (std::size_t i = 0; within && i < normals.size(); ++i)
      within = normals[i].dot(x) <= heights[i];
    if (!within) continue;
    ++inside;
    body.centre += x;
    body.second += x * x.transpose();
  }
  body.volume = double(inside) * cell.prod();
  body.centre /= double(inside);
  body.second /= double(inside);
  return body;
}

/// Checks that mass, centre of mass and inertia agree with the body given by the support function:
/// the mass to a quarter, the trace of the inertia to about a third, and in space the ratios of the
/// second moments to a tenth.
template <class ShapeT>
void check_mass_of_support(const ShapeT& shape, double size, std::mt19937_64& random) {
  using S = typename ShapeT::Space;
  using T = typename S::Scalar;
  const auto mass = shape.mass_properties(T(1));
  const auto body = described(shape, random);
  expect_at_most("mass / volume within the support, from 0.9",
                 std::abs(double(mass.mass) / body.volume - 0.9), 0.25);
  expect_at_most("centre of what the support describes from the origin", body.centre.norm(),
                 0.05 * size);
  // In space the trace of the inertia is twice the mean square distance from the origin times the
  // mass; in the plane it is once this product.
  const double trace = (S::angular_dim > 1 ? 2 : 1) * body.second.trace() * double(mass.mass);
  expect_at_most("trace of the inertia / that of the support, from 0.9",
                 std::abs(double(mass.inertia.trace()) / trace - 0.9), 0.35);
  if constexpr (S::angular_dim > 1) {
    // With the second moments M, the inertia is I = trace(M) - M. So M = trace(I) / 2 - I.
    const Eigen::Matrix3d inertia = mass.inertia.template cast<double>();
    const Eigen::Matrix3d second = inertia.trace() / 2 * Eigen::Matrix3d::Identity() - inertia;
    expect_at_most("second moments over their trace, from those of the support",
                   (second / second.trace() - body.second / body.second.trace()).norm(), 0.1);
  }
}

/// Checks that the bounding box contains the shape. It may be larger than the shape, which only
/// costs time.
template <class ShapeT>
void check_box(const ShapeT& shape, double size, std::mt19937_64& random) {
  using S = typename ShapeT::Space;
  for (int i = 0; i < 10; ++i) {
    const auto pose = i == 0 ? moreau::Pose<S>{} : random_pose<S>(random);
    const auto box = shape.bounding_box(pose), tight = moreau::support_box(shape, pose);
    const double limit = rounding<ShapeT>() * (size + 1);
    expect_at_most("lower corner of the box", (box.lower - tight.lower).maxCoeff(), limit);
    expect_at_most("upper corner of the box", (tight.upper - box.upper).maxCoeff(), limit);
  }
}

/// Checks the member functions that are optional for shapes.
template <class ShapeT>
void check_members(const ShapeT& shape, const std::vector<typename ShapeT::Space::Vector>& points,
                   double size) {
  using S = typename ShapeT::Space;
  using T = typename S::Scalar;
  constexpr double close = rounding<ShapeT>();
  const auto mass = shape.mass_properties(T(1));
  T farthest = 0;
  for (const auto& x : points) farthest = std::max(farthest, x.norm());
  if constexpr (moreau::HasVolume<ShapeT>)
    expect_at_most("volume", std::abs(mass.mass - shape.volume()), close * mass.mass);
  if constexpr (moreau::HasCircumradius<ShapeT>)
    expect_at_most("farthest point", farthest, shape.circumradius() + close * size);
  if constexpr (moreau::HasInradius<ShapeT>)
    for (const auto& x : points)
      expect_at_most("inradius", shape.inradius(),
                     shape.support(x).dot(x.normalized()) + close * size);
  if constexpr (moreau::Scalable<ShapeT>) {
    const auto twice = shape.scaled(T(2));
    const auto its = twice.mass_properties(T(1));
    const T of_mass = T(1 << S::dim);
    expect_at_most("mass at twice the size", std::abs(its.mass - of_mass * mass.mass),
                   close * its.mass);
    expect_at_most("inertia at twice the size", (its.inertia - 4 * of_mass * mass.inertia).norm(),
                   close * its.inertia.norm());
    if constexpr (moreau::ConvexShape<ShapeT>)
      expect_at_most("support at twice the size",
                     (twice.support(points[0]) - 2 * shape.support(points[0])).norm(),
                     2 * close * size);
  }
}

/// The distance from the origin within which a shape lies, by its bounding box [m].
template <class ShapeT>
double extent(const ShapeT& shape) {
  const auto box = shape.bounding_box({});
  return box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm();
}

/// Runs the checks that apply to a grain of parts.
template <moreau::CompoundShape ShapeT>
void check_grain(const ShapeT& grain) {
  using S = typename ShapeT::Space;
  std::mt19937_64 random(1);
  const double size = extent(grain);
  check_mass(grain, size);
  std::vector<typename S::Vector> points;
  for (const auto& part : grain.parts())
    for (int i = 0; i < 100; ++i)
      points.push_back(part.pose(part.shape.support(random_direction<S>(random))));
  for (int i = 0; i < 10; ++i) {
    const auto pose = i == 0 ? moreau::Pose<S>{} : random_pose<S>(random);
    const double limit = rounding<ShapeT>() * (size + 1);
    const auto around = grain.bounding_box(pose);
    for (const auto& x : points)
      expect_at_most(
          "a point from the box",
          std::max((around.lower - pose(x)).maxCoeff(), (pose(x) - around.upper).maxCoeff()),
          limit);
  }
  check_members(grain, points, size);
}

/// Checks that bounding_box() returns the smallest box. All shapes of the library do; a shape of a
/// user may return a larger box, and then does not take this check.
template <class ShapeT>
void check_box_is_tight(const ShapeT& shape) {
  using S = typename ShapeT::Space;
  std::mt19937_64 random(2);
  for (int i = 0; i < 10; ++i) {
    const auto pose = random_pose<S>(random);
    const auto box = shape.bounding_box(pose), tight = moreau::support_box(shape, pose);
    const double limit = rounding<ShapeT>() * (double((box.upper - box.lower).norm()) + 1);
    expect_at_most("lower corner of the box", (box.lower - tight.lower).norm(), limit);
    expect_at_most("upper corner of the box", (box.upper - tight.upper).norm(), limit);
  }
}

/// Runs all checks that apply to the shape.
template <moreau::ConvexShape ShapeT>
void check_shape(const ShapeT& shape) {
  std::mt19937_64 random(1);
  const double size = extent(shape);
  check_mass(shape, size);
  std::mt19937_64 of_grid(3);
  check_mass_of_support(shape, size, of_grid);
  const auto points = check_support(shape, size, random);
  check_box(shape, size, random);
  check_members(shape, points, size);
}

}  // namespace conformance
