// SPDX-License-Identifier: MIT
// Polytopes of points that have the rounding of a file: the faces are those of the shape that was written.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/convex_hull.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"
#include "moreau/shape/simplify_hull.hpp"

#include "sanitized.hpp"

using namespace moreau;

namespace {

using Points = std::vector<Eigen::Vector3d>;
struct Solid {
  const char* name;
  Points points;
  std::size_t faces;
};

Points prism(int corners, double height) {
  Points points;
  for (int k = 0; k < corners; ++k)
    for (const double z : {-height / 2, height / 2}) {
      const double angle = 2 * std::numbers::pi * (k + 0.3) / corners;
      points.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), z);
    }
  return points;
}
/// Points at (+-x, +-y, +-z) and, if asked for, their cyclic permutations.
void add_corners(Points& points, const Eigen::Vector3d& x, bool permuted) {
  for (int turn = 0; turn < (permuted ? 3 : 1); ++turn)
    for (int signs = 0; signs < 8; ++signs) {
      Eigen::Vector3d corner;
      bool is_new = true;
      for (int k = 0; k < 3; ++k) {
        const bool negative = (signs >> k & 1) != 0;
        corner[(k + turn) % 3] = negative ? -x[k] : x[k];
        is_new = is_new && !(negative && x[k] == 0);
      }
      if (is_new) points.push_back(corner);
    }
}

/// Solids of a size of about 1 m.
std::vector<Solid> solids() {
  constexpr double golden = std::numbers::phi;
  std::vector<Solid> all;
  Points cube, dodecahedron, octahedron, icosahedron, rhombic, truncated;
  add_corners(cube, {0.5, 0.5, 0.5}, false);
  add_corners(dodecahedron, {0.3, 0.3, 0.3}, false);
  add_corners(dodecahedron, {0, 0.3 / golden, 0.3 * golden}, true);
  add_corners(octahedron, {0.5, 0, 0}, true);
  add_corners(icosahedron, {0, 0.3, 0.3 * golden}, true);
  add_corners(rhombic, {0.3, 0.3, 0.3}, false);
  add_corners(rhombic, {0.6, 0, 0}, true);  // four rhombs meet at these
  add_corners(truncated, {0, 0.2, 0.4}, true);
  add_corners(truncated, {0.2, 0, 0.4}, true);
  all.push_back({"cube", cube, 6});
  all.push_back({"tetrahedron",
                 {{0.5, 0.5, 0.5}, {-0.5, -0.5, 0.5}, {-0.5, 0.5, -0.5}, {0.5, -0.5, -0.5}},
                 4});
  all.push_back({"dodecahedron", dodecahedron, 12});
  all.push_back({"octahedron", octahedron, 8});
  all.push_back({"icosahedron", icosahedron, 20});
  all.push_back({"rhombic dodecahedron", rhombic, 12});
  all.push_back({"truncated octahedron", truncated, 14});
  for (int corners = 5; corners <= 12; ++corners) {
    all.push_back({"prism", prism(corners, 0.8), std::size_t(corners) + 2});
    all.push_back({"plate", prism(corners, 0.1), std::size_t(corners) + 2});
  }
  return all;
}

Points turned(const Points& points, double size, std::mt19937_64& random) {
  const auto rotation = random_rotation<Space<3>>(random);
  Points result;
  for (const auto& x : points) result.push_back(size * (rotation * x));
  return result;
}

/// Rounds coordinates to a number of decimals.
Points to_decimals(Points points, int decimals) {
  const double unit = std::pow(10., decimals);
  for (auto& x : points) x = (x * unit).array().round() / unit;
  return points;
}
Points to_float(Points points) {
  for (auto& x : points) x = x.cast<float>().cast<double>();
  return points;
}

/// Distance of the vertices of a face from its plane, of all faces the largest [m].
template <class T>
double warp(const Polyhedron<T>& shape) {
  double largest = 0;
  for (std::size_t f = 0; f < shape.face_count(); ++f)
    for (const std::uint32_t v : shape.face(f)) {
      const auto row = Eigen::Index(f);
      const T height = shape.face_normals().row(row).dot(shape.vertices().row(Eigen::Index(v))) -
                       shape.face_offsets()[row];
      largest = std::max(largest, std::abs(double(height)));
    }
  return largest;
}

template <class T>
void check_solid(const Solid& solid, const Points& exact, const Points& points, double rounding) {
  using Vector = Eigen::Matrix<T, 3, 1>;
  std::vector<Vector> given, unrounded;
  for (const auto& x : points) given.push_back(x.cast<T>());
  for (const auto& x : exact) unrounded.push_back(x.cast<T>());
  const Polyhedron<T> shape{std::span<const Vector>(given), T(rounding)};
  CHECK(shape.face_count() == solid.faces);
  CHECK(shape.vertex_count() == points.size());
  const double epsilon = std::numeric_limits<T>::epsilon(), size = double(shape.circumradius());
  CHECK(warp(shape) <= 32 * epsilon * size);
  // Vertices move by at most the tolerance, so that the surface does.
  const Polyhedron<T> right{std::span<const Vector>(unrounded)};
  const double moved = 2 * HullTolerance{}.rounded * rounding + 32 * epsilon * size;
  const double surface = 30 * size * size;
  CHECK(std::abs(double(shape.volume() - right.volume())) <= surface * moved);
  CHECK(double((shape.centroid_of_input() - right.centroid_of_input()).norm()) <= 20 * moved);
  // The moments are those of the shape that collides.
  std::vector<Vector> own;
  for (Eigen::Index v = 0; v < shape.vertices().rows(); ++v)
    own.push_back(shape.vertices().row(v).transpose());
  const Polyhedron<T> again{std::span<const Vector>(own)};
  CHECK(again.face_count() == solid.faces);
  CHECK(std::abs(double(again.volume() - shape.volume())) <=
        100 * epsilon * double(shape.volume()));
  CHECK(double((again.moments().second - shape.moments().second).norm()) <=
        200 * epsilon * double(shape.moments().second.norm()));
}

}  // namespace

TEST_CASE_TEMPLATE("solids that were rounded to a file have their faces", T, double, float) {
  std::mt19937_64 random(5);
  const bool is_double = std::is_same_v<T, double>;
  for (const Solid& solid : solids()) {
    CAPTURE(solid.name);
    CAPTURE(solid.faces);
    for (int k = 0; k < rounds(20); ++k) {
      for (const double size : {0.01, 1.0, 30.0}) {
        CAPTURE(size);
        const Points points = turned(solid.points, size, random);
        check_solid<T>(solid, points, to_float(points), size * 6e-8);
      }
      for (const int decimals : {3, 4, 6, 9}) {
        if (decimals == 9 && !is_double) continue;
        CAPTURE(decimals);
        const Points points = turned(solid.points, 1, random);
        check_solid<T>(solid, points, to_decimals(points, decimals),
                       0.5 * std::pow(10., -decimals));
      }
      const Points small = turned(solid.points, 0.01, random);
      check_solid<T>(solid, small, to_decimals(small, 6), 5e-7);
    }
  }
}

TEST_CASE("points without rounding, and thin ones, are those without a tolerance") {
  using Vector = Eigen::Vector3d;
  std::mt19937_64 random(6);
  for (const Solid& solid : solids()) {
    const Points points = turned(solid.points, 1, random);
    const Polyhedron<> plain{std::span<const Vector>(points)},
        shape{std::span<const Vector>(points), 1e-7};
    CHECK(shape.vertices() == plain.vertices());
    CHECK(shape.face_count() == plain.face_count());
  }
  // Thinner than the rounding: the faces cannot be told from each other.
  const Points plate = to_decimals(turned(prism(6, 0.004), 1, random), 3);
  const Polyhedron<> plain{std::span<const Vector>(plate)},
      shape{std::span<const Vector>(plate), 5e-4};
  CHECK(shape.vertices() == plain.vertices());
  CHECK_THROWS_AS(Polyhedron<>(std::span<const Vector>(plate), -1e-6), std::invalid_argument);
  CHECK_THROWS_AS(Polyhedron<>(std::span<const Vector>(plate), std::nan("")),
                  std::invalid_argument);
}

TEST_CASE("fine surfaces keep facets that their digits resolve") {
  using Vector = Eigen::Vector3d;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Points ball;
  for (int k = 0; k < 500; ++k)
    ball.push_back(0.5 * Vector(normal(random), normal(random), normal(random)).normalized());
  const Points rounded = to_decimals(ball, 6);
  const Polyhedron<> shape{std::span<const Vector>(rounded), 5e-7};
  CHECK(shape.vertex_count() >= 495);
  CHECK(warp(shape) <= 1e-14);
  const SimplifiedHull<Polyhedron<>> fewer = simplify_hull(shape, 60);
  CHECK(fewer.shape.vertex_count() <= 60);
  CHECK(warp(fewer.shape) <= 1e-14);
}

TEST_CASE_TEMPLATE("polygons that were rounded to a file have their edges", T, double, float) {
  using Vector = Eigen::Matrix<T, 2, 1>;
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi), along(0.1, 0.9);
  for (int corners = 3; corners <= 12; ++corners)
    for (int k = 0; k < rounds(50); ++k)
      for (const int decimals : {3, 6}) {
        CAPTURE(corners);
        CAPTURE(decimals);
        const double start = angle(random), unit = std::pow(10., decimals);
        std::vector<Vector> points;
        const auto add = [&](const Eigen::Vector2d& x) {
          points.push_back(((x * unit).array().round() / unit).matrix().template cast<T>());
        };
        const auto corner = [&](int i) {
          const double at = start + 2 * std::numbers::pi * i / corners;
          return Eigen::Vector2d(std::cos(at), std::sin(at));
        };
        for (int i = 0; i < corners; ++i) {
          add(corner(i));
          // A point of the edge, which rounding moves off it.
          const double share = along(random);
          add((1 - share) * corner(i) + share * corner(i + 1));
        }
        const Polygon<T> shape{std::span<const Vector>(points), T(0.5 / unit)};
        CHECK(shape.face_count() == std::size_t(corners));
      }
}
