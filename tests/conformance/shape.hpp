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
#include <string>
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

/// Differences that rounding may make, relative.
template <class ShapeT>
constexpr double rounding() {
  return 256 * std::numeric_limits<typename ShapeT::Space::Scalar>::epsilon();
}

// Not templates: they take the compiler long.
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
  // The principal values are sums of two out of three second moments.
  expect_at_most("largest less the sum of the others", principal[2] - principal[1] - principal[0],
                 rounding * principal[2]);
}

/// Mass and inertia of a body that can exist, about the origin, proportional to the density.
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

/// Farthest points, whatever the length of the direction.
/// @returns points of the boundary
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

/// Volume, centroid and second moments about the origin, by volume [m^2], of the body that the
/// farthest points describe: cells of a grid that no plane of support cuts off. A fifth too large
/// where there are flat faces.
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

/// Mass (to a quarter), centre, trace of the inertia (to a third) and in space the shares of its
/// axes (to a tenth) are about those of the body that the farthest points describe.
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
  // The trace of the inertia: in space twice the mean square of the distance, in the plane once.
  const double trace = (S::angular_dim > 1 ? 2 : 1) * body.second.trace() * double(mass.mass);
  expect_at_most("trace of the inertia / that of the support, from 0.9",
                 std::abs(double(mass.inertia.trace()) / trace - 0.9), 0.35);
  if constexpr (S::angular_dim > 1) {
    // I = trace(M) - M of the second moments M, so M = trace(I) / 2 - I.
    const Eigen::Matrix3d inertia = mass.inertia.template cast<double>();
    const Eigen::Matrix3d second = inertia.trace() / 2 * Eigen::Matrix3d::Identity() - inertia;
    expect_at_most("second moments over their trace, from those of the support",
                   (second / second.trace() - body.second / body.second.trace()).norm(), 0.1);
  }
}

/// Around the farthest points; it may be wider than they are, which costs pairs.
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

/// Members that not every shape has.
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
    expect_at_most("support at twice the size",
                   (twice.support(points[0]) - 2 * shape.support(points[0])).norm(),
                   2 * close * size);
  }
}

/// No wider than that, as the library's own boxes are.
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

/// All of it, of whatever the shape has.
template <moreau::ConvexShape ShapeT>
void check_shape(const ShapeT& shape) {
  using S = typename ShapeT::Space;
  std::mt19937_64 random(1);
  const moreau::Aabb<S> box = shape.bounding_box({});
  const double size = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm();
  check_mass(shape, size);
  std::mt19937_64 of_grid(3);
  check_mass_of_support(shape, size, of_grid);
  const auto points = check_support(shape, size, random);
  check_box(shape, size, random);
  check_members(shape, points, size);
}

}  // namespace conformance
