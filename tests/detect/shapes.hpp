// SPDX-License-Identifier: MIT
// Shapes and poses for the tests of the narrow phase.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "conformance/random_direction.hpp"

namespace samples {

template <class S>
typename S::Vector direction(std::mt19937_64& random) {
  return conformance::random_direction<S>(random);
}

template <class T>
Eigen::Quaternion<T> rotation(moreau::Space<3, T>, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Quaternion<T> q;
  for (auto& x : q.coeffs()) x = static_cast<T>(normal(random));
  return q.normalized();
}
template <class T>
Eigen::Rotation2D<T> rotation(moreau::Space<2, T>, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(-3.2, 3.2);
  return Eigen::Rotation2D<T>(static_cast<T>(angle(random)));
}

/// The convex hull of random points near an ellipsoid, with 8 to about 37 vertices and a size of
/// about 1.
template <class T>
moreau::Polyhedron<T> grain(moreau::Space<3, T>, std::mt19937_64& random) {
  using S = moreau::Space<3, T>;
  std::uniform_real_distribution<double> jitter(0.85, 1.1);
  std::uniform_int_distribution<int> count(8, 40);
  const typename S::Vector axes(1, static_cast<T>(jitter(random) * 0.85),
                                static_cast<T>(jitter(random) * 0.65));
  std::vector<typename S::Vector> points;
  for (int n = count(random); n > 0; --n)
    points.push_back(direction<S>(random).cwiseProduct(axes) * static_cast<T>(jitter(random)));
  return moreau::Polyhedron<T>(std::span<const typename S::Vector>(points));
}

/// An irregular polygon with about 5 to 7 sides and a size of about 1.
template <class T>
moreau::Polygon<T> grain(moreau::Space<2, T>, std::mt19937_64& random) {
  using S = moreau::Space<2, T>;
  std::uniform_real_distribution<double> jitter(0.8, 1.1);
  std::uniform_int_distribution<int> count(5, 8);
  std::vector<typename S::Vector> points;
  const int n = count(random);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5 * jitter(random)) / n;
    points.emplace_back(static_cast<T>(std::cos(angle) * jitter(random)),
                        static_cast<T>(std::sin(angle) * jitter(random)));
  }
  return moreau::Polygon<T>(std::span<const typename S::Vector>(points));
}

/// A box with the given side lengths.
template <class T>
moreau::Polyhedron<T> box(T x, T y, T z) {
  std::vector<typename moreau::Space<3, T>::Vector> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1 ? x : -x) / 2, (i & 2 ? y : -y) / 2, (i & 4 ? z : -z) / 2);
  return moreau::Polyhedron<T>(std::span<const typename moreau::Space<3, T>::Vector>(corners));
}

template <class T>
moreau::Polygon<T> box(T x, T y) {
  std::vector<typename moreau::Space<2, T>::Vector> corners;
  for (int i = 0; i < 4; ++i) corners.emplace_back((i & 1 ? x : -x) / 2, (i & 2 ? y : -y) / 2);
  return moreau::Polygon<T>(std::span<const typename moreau::Space<2, T>::Vector>(corners));
}

template <class T>
moreau::Polyhedron<T> tetrahedron(T size) {
  using Vector = typename moreau::Space<3, T>::Vector;
  const std::vector<Vector> corners = {Vector(size, size, size), Vector(size, -size, -size),
                                       Vector(-size, size, -size), Vector(-size, -size, size)};
  return moreau::Polyhedron<T>(std::span<const Vector>(corners));
}

/// An upright prism whose base is a regular polygon.
template <class T>
moreau::Polyhedron<T> prism(int sides, T radius, T height) {
  std::vector<typename moreau::Space<3, T>::Vector> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const T z : {-height / 2, height / 2})
      corners.emplace_back(radius * static_cast<T>(std::cos(angle)),
                           radius * static_cast<T>(std::sin(angle)), z);
  }
  return moreau::Polyhedron<T>(std::span<const typename moreau::Space<3, T>::Vector>(corners));
}

}  // namespace samples
