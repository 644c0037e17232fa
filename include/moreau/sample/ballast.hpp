// SPDX-License-Identifier: MIT
// Random grain shapes that look like railway ballast: crushed rock, angular, roughly equant.
//
// In space a shape is the hull of points near an ellipsoid with the semi-axes 1, e, e f:
//
//   1. Draw the elongation e and the flatness f between 0.7 and 1, and the number V of vertices.
//   2. Draw random directions with a least distance, and their points on the ellipsoid.
//   3. Pull each point inwards by up to a fifth, so that faces differ in size and corners in angle.
//   4. Accept the hull if it has V vertices. All faces are triangles, 2 V - 4 of them.
//
// The ratios of the axes of the hulls (of ellipsoids of the same inertia) lie between about 0.55
// and 1, most around 0.83. Crushed rock is a little flatter on average and seldom as equant as a
// ball. A hull fills 0.37 of its circumscribed ball on average. In the plane the algorithm is the
// same, with 5 to 7 corners on an ellipse of semi-axes 1, e.
//
// All shapes are scaled to circumradius 1 (to rounding), their largest distance from the centre of
// mass to a vertex.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "moreau/core/error.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

namespace moreau {

/// Draws random grains of a shape; specialise it for your own shape. draw(random) returns a random
/// grain of circumradius 1 (to rounding).
template <class Shape>
struct Ballast;

/// A shape with a specialisation of Ballast, so that random grains can be drawn.
template <class Shape>
concept BallastShape = requires(std::mt19937_64& random) {
  { Ballast<Shape>::draw(random) } -> std::same_as<Shape>;
};

/// Parameters of the random shapes described at the top of this file. Lengths are relative to the
/// largest semi-axis [-].
struct BallastParameters {
  double lowest_axis_ratio = 0.7;  ///< of e and f, uniform up to 1
  double pull = 0.2;      ///< radii are uniform between 1 - pull and 1, times the ellipsoid
  double spacing = 0.55;  ///< least distance of two directions, in that of V points spread evenly
  double lowest_inradius = 0.35;  ///< over the circumradius: no splinters, no flakes
};

namespace detail {

inline double uniform(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A direction drawn uniformly.
template <int Dim>
Eigen::Matrix<double, Dim, 1> random_direction(std::mt19937_64& random) {
  Eigen::Matrix<double, Dim, 1> x;
  do {
    for (int k = 0; k < Dim; ++k) x[k] = uniform(-1, 1, random);
  } while (x.squaredNorm() > 1 || x.squaredNorm() < 1e-4);
  return x.normalized();
}

/// Random directions with at least the spacing (chord length) between any two. Returns fewer than
/// `count` if no further direction is found.
template <int Dim>
std::vector<Eigen::Matrix<double, Dim, 1>> spaced_directions(std::size_t count, double spacing,
                                                             std::mt19937_64& random) {
  std::vector<Eigen::Matrix<double, Dim, 1>> directions;
  for (std::size_t trial = 0; trial < 100 * count && directions.size() < count; ++trial) {
    const auto x = random_direction<Dim>(random);
    bool free = true;
    for (const auto& y : directions) free = free && (x - y).norm() >= spacing;
    if (free) directions.push_back(x);
  }
  return directions;
}

/// Points on an ellipsoid with the semi-axes 1, e, e f, .., pulled inwards at random.
template <class S>
std::vector<typename S::Vector> jittered_ellipsoid(std::size_t count, double spacing,
                                                   std::mt19937_64& random) {
  const BallastParameters parameters;
  Eigen::Matrix<double, S::dim, 1> axes;
  axes[0] = 1;
  for (int k = 1; k < S::dim; ++k) {
    axes[k] = axes[k - 1] * uniform(parameters.lowest_axis_ratio, 1, random);
  }
  std::vector<typename S::Vector> points;
  for (const auto& direction : spaced_directions<S::dim>(count, spacing, random)) {
    const double radius = uniform(1 - parameters.pull, 1, random);
    points.push_back((radius * axes.cwiseProduct(direction)).template cast<typename S::Scalar>());
  }
  return points;
}

/// The hull of the points at circumradius 1. Nothing if a point is not a vertex or if the inradius
/// is below BallastParameters::lowest_inradius.
template <class Shape>
std::optional<Shape> sound_hull(std::span<const typename Shape::Vector> points,
                                std::size_t vertices) {
  if (points.size() < vertices) return std::nullopt;
  const Shape hull(points);
  const BallastParameters parameters;
  if (hull.vertex_count() != vertices) return std::nullopt;
  if (hull.inradius() < parameters.lowest_inradius * hull.circumradius()) return std::nullopt;
  return hull.scaled(1 / hull.circumradius());
}

}  // namespace detail

/// 8 to 37 vertices, 12 to 70 faces, all triangles.
template <std::floating_point T>
struct Ballast<Polyhedron<T>> {
  /// A grain of circumradius 1.
  static Polyhedron<T> draw(std::mt19937_64& random) {
    using S = Space<3, T>;
    const auto count = std::uniform_int_distribution<std::size_t>(8, 37)(random);
    const double even = std::sqrt(4 * std::numbers::pi / static_cast<double>(count));
    for (;;) {
      // More points than vertices: some of those pulled inwards end inside the hull.
      const std::size_t extra = std::uniform_int_distribution<std::size_t>(0, count / 2)(random);
      const auto points =
          detail::jittered_ellipsoid<S>(count + extra, BallastParameters{}.spacing * even, random);
      const auto hull = detail::sound_hull<Polyhedron<T>>(points, count);
      if (hull && hull->face_count() == hull->triangle_count()) return *hull;
    }
  }
};

/// 5 to 7 sides.
template <std::floating_point T>
struct Ballast<Polygon<T>> {
  /// A grain of circumradius 1.
  static Polygon<T> draw(std::mt19937_64& random) {
    using S = Space<2, T>;
    const auto count = std::uniform_int_distribution<std::size_t>(5, 7)(random);
    const double even = 2 * std::numbers::pi / static_cast<double>(count);
    for (;;) {
      const auto points =
          detail::jittered_ellipsoid<S>(count, BallastParameters{}.spacing * even, random);
      if (const auto hull = detail::sound_hull<Polygon<T>>(points, count)) return *hull;
    }
  }
};

/// Balls and disks, the reference without corners: all grains are equal.
template <class S>
struct Ballast<BallIn<S>> {
  /// The ball of radius 1.
  static BallIn<S> draw(std::mt19937_64&) { return BallIn<S>(1); }
};

/// Random grain shapes of circumradius 1, each drawn by Ballast<Shape>.
/// @param count  how many, at least 1
/// @param random its state goes on; the same state gives the same shapes
/// @throws std::invalid_argument for count = 0
template <BallastShape Shape>
std::vector<Shape> ballast_shapes(std::size_t count, std::mt19937_64& random) {
  require(count > 0, "ballast_shapes", "count", count, "must be at least 1");
  std::vector<Shape> shapes;
  shapes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) shapes.push_back(Ballast<Shape>::draw(random));
  return shapes;
}

}  // namespace moreau
