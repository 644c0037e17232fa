// SPDX-License-Identifier: MIT
// Random grain shapes similar to railway ballast: crushed rock, angular, roughly equant.
//
// In space a shape is the convex hull of points near an ellipsoid with the semi-axes 1, e, e f:
//
//   1. Draw the elongation e and the flatness f between 0.7 and 1, and the number V of vertices.
//   2. Draw random directions with a prescribed smallest distance between any two. Take the points
//      of the ellipsoid in these directions.
//   3. Move each point inwards by up to a fifth of its distance from the centre. So the faces
//      differ in size and the corners differ in angle.
//   4. Accept the hull if it has V vertices. All its 2 V - 4 faces must be triangles.
//
// Let the axes of a hull be those of the ellipsoid with the same inertia. The ratios of these axes
// lie between about 0.55 and 1, most of them around 0.83. Crushed rock is on average a little
// flatter and seldom as equant as a ball. A hull fills on average 0.37 of the volume of its
// circumscribed ball. In the plane the algorithm is the same, with 5 to 7 corners on an ellipse
// with the semi-axes 1, e.
//
// All shapes are scaled to a circumradius of 1 (to rounding). The circumradius is the largest
// distance of a vertex from the centre of mass.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
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

/// Draws random grains of a type of shape. Specialise this class for a shape of your own.
/// draw(random) returns a random grain with the circumradius 1 (to rounding).
template <class Shape>
struct Ballast;

/// A type of shape for which random grains can be drawn, because Ballast is specialised for it.
template <class Shape>
concept BallastShape = requires(std::mt19937_64& random) {
  { Ballast<Shape>::draw(random) } -> std::same_as<Shape>;
};

/// Parameters of the random shapes described at the top of this file. Lengths are relative to the
/// largest semi-axis of the ellipsoid [-].
struct BallastParameters {
  double lowest_axis_ratio = 0.7;  ///< e and f are uniform between this and 1
  double pull = 0.2;  ///< distances of points from the centre are uniform between 1 - pull and 1,
                      ///< relative to the ellipsoid
  double spacing = 0.55;  ///< smallest distance of two directions, relative to the distance of V
                          ///< evenly spread directions
  double lowest_inradius = 0.35;  ///< smallest inradius / circumradius, which excludes splinters
                                  ///< and flakes
};

namespace detail {

inline double uniform(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A random direction with a uniform distribution.
template <int Dim>
Eigen::Matrix<double, Dim, 1> random_direction(std::mt19937_64& random) {
  Eigen::Matrix<double, Dim, 1> x;
  do {
    for (int k = 0; k < Dim; ++k) x[k] = uniform(-1, 1, random);
  } while (x.squaredNorm() > 1 || x.squaredNorm() < 1e-4);
  return x.normalized();
}

/// Random directions whose end points on the unit sphere have at least the distance `spacing` from
/// each other. Returns fewer than `count` directions if no further direction is found.
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

/// Random points on an ellipsoid with the semi-axes 1, e, e f, ..., moved inwards by random
/// amounts.
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

/// The convex hull of the points, scaled to the circumradius 1. Returns nothing if the hull has not
/// exactly the given number of vertices, or if its inradius is below
/// BallastParameters::lowest_inradius.
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

/// Random polyhedra with 8 to 37 vertices and 12 to 70 faces, all triangles.
template <std::floating_point T>
struct Ballast<Polyhedron<T>> {
  /// A grain with the circumradius 1.
  static Polyhedron<T> draw(std::mt19937_64& random) {
    using S = Space<3, T>;
    const auto count = std::uniform_int_distribution<std::size_t>(8, 37)(random);
    const double even = std::sqrt(4 * std::numbers::pi / static_cast<double>(count));
    for (;;) {
      // More points than vertices are drawn, because some of the points moved inwards lie inside
      // the hull.
      const std::size_t extra = std::uniform_int_distribution<std::size_t>(0, count / 2)(random);
      const auto points =
          detail::jittered_ellipsoid<S>(count + extra, BallastParameters{}.spacing * even, random);
      const auto hull = detail::sound_hull<Polyhedron<T>>(points, count);
      if (hull && hull->face_count() == hull->triangle_count()) return *hull;
    }
  }
};

/// Random polygons with 5 to 7 sides.
template <std::floating_point T>
struct Ballast<Polygon<T>> {
  /// A grain with the circumradius 1.
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

/// Balls and disks, for comparison with angular grains. All grains are equal.
template <class S>
struct Ballast<BallIn<S>> {
  /// The ball of radius 1.
  static BallIn<S> draw(std::mt19937_64&) { return BallIn<S>(1); }
};

/// Random grain shapes with the circumradius 1, drawn by Ballast<Shape>.
/// @param count  number of shapes, at least 1
/// @param random random number generator. Its state is advanced; the same state gives the same
///               shapes
/// @throws std::invalid_argument if count is 0
template <BallastShape Shape>
std::vector<Shape> ballast_shapes(std::size_t count, std::mt19937_64& random) {
  require(count > 0, "ballast_shapes", "count", count, "must be at least 1");
  std::vector<Shape> shapes;
  shapes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) shapes.push_back(Ballast<Shape>::draw(random));
  return shapes;
}

}  // namespace moreau
