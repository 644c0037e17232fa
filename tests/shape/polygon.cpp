// SPDX-License-Identifier: MIT
#include "moreau/shape/polygon.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using moreau::Polygon;
using moreau::Space;
template <class T>
using V2 = Eigen::Matrix<T, 2, 1>;

static_assert(moreau::Polytope<Polygon<double>>);
static_assert(moreau::Polytope<Polygon<float>>);

template <class T>
constexpr double tolerance = 64 * std::numeric_limits<T>::epsilon();

template <class T>
Polygon<T> hull(const std::vector<V2<T>>& points) {
  return Polygon<T>(std::span<const V2<T>>(points));
}

template <class T>
std::vector<V2<T>> random_points(std::size_t n, std::mt19937_64& random) {
  std::uniform_real_distribution<T> coordinate(-1, 1);
  std::vector<V2<T>> points(n);
  for (auto& x : points) x = V2<T>(coordinate(random), coordinate(random));
  return points;
}

template <class T>
void check_geometry(const Polygon<T>& p) {
  const double close = tolerance<T> * static_cast<double>(p.circumradius());
  const Eigen::Index n = p.vertices().rows();
  REQUIRE(p.face_normals().rows() == n);
  REQUIRE(p.face_offsets().size() == n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const V2<T> normal = p.face_normals().row(i).transpose();
    REQUIRE(std::abs(normal.norm() - 1) < tolerance<T>);
    const auto heights = ((p.vertices() * normal).array() - p.face_offsets()[i]).eval();
    REQUIRE(heights.maxCoeff() < close);
    REQUIRE(std::abs(heights[i]) < close);
    REQUIRE(std::abs(heights[(i + 1) % n]) < close);
    const V2<T> along = (p.vertices().row((i + 1) % n) - p.vertices().row(i)).transpose();
    REQUIRE(normal.x() * along.y() - normal.y() * along.x() > 0);
  }
  REQUIRE(p.circumradius() == doctest::Approx(p.vertices().rowwise().norm().maxCoeff()));
  REQUIRE(p.inradius() > 0);
}

TEST_CASE_TEMPLATE("regular polygons in closed form, turned and moved", T,
                   MOREAU_TYPES((double), (float))) {
  for (int n = 3; n <= 12; ++n) {
    const double radius = 1.7, step = 2 * std::numbers::pi / n;
    std::vector<V2<T>> points;
    for (int k = 0; k < n; ++k) {
      const double angle = k * step + 0.3 * n;
      points.emplace_back(static_cast<T>(3 + radius * std::cos(angle)),
                          static_cast<T>(-1 + radius * std::sin(angle)));
    }
    const auto p = hull(points);
    check_geometry(p);
    CHECK(p.vertex_count() == static_cast<std::size_t>(n));
    CHECK((p.centroid_of_input() - V2<T>(3, -1)).norm() < tolerance<T>);
    const double area = n / 2.0 * radius * radius * std::sin(step);
    CHECK(p.area() == doctest::Approx(area).epsilon(tolerance<T>));
    CHECK(p.volume() == p.area());
    CHECK(p.circumradius() == doctest::Approx(radius).epsilon(tolerance<T>));
    CHECK(p.inradius() == doctest::Approx(radius * std::cos(step / 2)).epsilon(tolerance<T>));
    const auto mass = p.mass_properties(2);
    CHECK(mass.mass == doctest::Approx(2 * area).epsilon(tolerance<T>));
    CHECK(mass.center == V2<T>::Zero());
    CHECK(mass.inertia(0, 0) ==
          doctest::Approx(2 * area * radius * radius / 6 * (2 + std::cos(step)))
              .epsilon(tolerance<T>));
  }
}

TEST_CASE_TEMPLATE("a rectangle and a triangle in closed form", T,
                   MOREAU_TYPES((double), (float))) {
  const auto box = hull<T>({{1, 1}, {4, 1}, {4, 3}, {1, 3}});
  CHECK(box.area() == doctest::Approx(6));
  CHECK(box.mass_properties(1).inertia(0, 0) == doctest::Approx(6.0 * (9 + 4) / 12));
  CHECK((box.centroid_of_input() - V2<T>(2.5, 2)).norm() < tolerance<T>);
  // The second moment of a triangle about its centre is that of three point masses m / 12 at its
  // vertices.
  const auto triangle = hull<T>({{0, 0}, {3, 1}, {1, 2}});
  CHECK(triangle.area() == doctest::Approx(2.5));
  CHECK(triangle.mass_properties(1).inertia(0, 0) ==
        doctest::Approx(2.5 / 12 * triangle.vertices().squaredNorm()).epsilon(tolerance<T>));
}

TEST_CASE_TEMPLATE("random hulls: geometry, support, box, cut in two", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(1);
  for (std::size_t n = 3; n < 60; ++n) {
    const auto p = hull(random_points<T>(n, random));
    check_geometry(p);
    const V2<T> direction = random_points<T>(1, random)[0];
    CHECK((p.vertices() * direction).maxCoeff() - p.support(direction).dot(direction) <
          tolerance<T>);
    const moreau::Pose<Space<2, T>> pose{V2<T>(3, 4), Eigen::Rotation2D<T>(static_cast<T>(n))};
    moreau::Aabb<Space<2, T>> truth;
    for (Eigen::Index k = 0; k < p.vertices().rows(); ++k) {
      truth.merge(pose(p.vertices().row(k).transpose()));
    }
    CHECK((p.bounding_box(pose).lower - truth.lower).norm() < tolerance<T>);
    CHECK((p.bounding_box(pose).upper - truth.upper).norm() < tolerance<T>);
  }
}

TEST_CASE("vertices keep the cyclic order of the input, the first of it first") {
  const auto p = hull<double>({{0.1, 0.1}, {0, 1}, {0.5, 0.5}, {-1, 0}, {0, -1}, {1, 0}});
  const Eigen::Matrix<double, 4, 2> truth{{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
  CHECK(p.vertices() == truth);
}

TEST_CASE_TEMPLATE("scaled", T, MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(2);
  const auto p = hull(random_points<T>(9, random));
  const auto twice = p.scaled(2);
  check_geometry(twice);
  CHECK(twice.vertices() == 2 * p.vertices());
  CHECK(twice.area() == 4 * p.area());
  CHECK(twice.circumradius() == 2 * p.circumradius());
  CHECK(twice.mass_properties(1).inertia(0, 0) == 16 * p.mass_properties(1).inertia(0, 0));
}

TEST_CASE_TEMPLATE("bad arguments are named", T, MOREAU_TYPES((double), (float))) {
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  const auto message = [](const std::vector<V2<T>>& points) {
    return message_of([&] { hull(points); });
  };
  CHECK(message({{0, 0}, {1, 1}}) == "Polygon: vertices.size() = 2 must be at least 3");
  CHECK(message({{0, 0}, {1, inf}, {2, 0}}) == "Polygon: vertices[1] = (1, inf) must be finite");
  CHECK(message({{0, 0}, {1, 0}, {nan, 0}}) == "Polygon: vertices[2] = (nan, 0) must be finite");
  CHECK(message({{0, 0}, {1, 1}, {3, 3}}) ==
        "Polygon: thickness of vertices = 0 m must not vanish: they are collinear");
  CHECK(message({{1, 1}, {1, 1}, {1, 1}}) ==
        "Polygon: thickness of vertices = 0 m must not vanish: they coincide");
  const T huge = std::numeric_limits<T>::max() / 4;
  CHECK(message({{0, 0}, {huge, 0}, {0, huge}}) ==
        "Polygon: area = inf m^2 must be positive and finite");

  const auto p = hull<T>({{0, 0}, {1, 0}, {0, 1}});
  CHECK(message_of([&] { p.mass_properties(-1); }) ==
        "Polygon::mass_properties: density = -1 must be finite and > 0");
  CHECK(message_of([&] { return p.scaled(nan); }) ==
        "Polygon::scaled: factor = nan must be finite and > 0");
}

}  // namespace

TEST_CASE("a polygon of which the scalar cannot hold the moments is refused") {
  using V = Eigen::Vector2f;
  const auto square = [](float side) {
    const std::vector<V> corners{{0, 0}, {side, 0}, {side, side}, {0, side}};
    return moreau::Polygon<float>(std::span<const V>(corners));
  };
  CHECK_NOTHROW(square(1e-9f));
  CHECK_THROWS_WITH_AS(square(1e-12f), doctest::Contains("Polygon: second moment = 0 m^4"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(square(1e11f), doctest::Contains("Polygon: second moment = inf m^4"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(square(1).scaled(1e-12f)),
                       doctest::Contains("Polygon::scaled: second moment"), std::invalid_argument);
}
