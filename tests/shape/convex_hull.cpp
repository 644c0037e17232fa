// SPDX-License-Identifier: MIT
#include "moreau/shape/convex_hull.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using Face = std::vector<std::uint32_t>;
using moreau::orientation;
template <class T>
using V2 = Eigen::Matrix<T, 2, 1>;
template <class T>
using V3 = Eigen::Matrix<T, 3, 1>;

template <class Vector>
auto hull_of(const std::vector<Vector>& points) {
  return moreau::convex_hull(std::span<const Vector>(points));
}

/// Whether a point x lies inside a segment between two other points or inside a triangle of three
/// other points. All points lie in one plane and are given by two of their coordinates.
bool is_inside_others(const Eigen::Vector2d& x, const std::vector<Eigen::Vector2d>& others) {
  for (const auto& a : others) {
    for (const auto& b : others) {
      if (orientation(a, b, x) == 0 && (a - x).dot(b - x) < 0) return true;
      for (const auto& c : others) {
        if (orientation(a, b, x) > 0 && orientation(b, c, x) > 0 && orientation(c, a, x) > 0) {
          return true;
        }
      }
    }
  }
  return false;
}

/// The sorted vertices of each face, found by trying the planes of all triples of points. The
/// points must be distinct, and orientation signs are exact.
std::set<Face> brute_force_faces(const std::vector<Eigen::Vector3d>& x) {
  std::set<Face> faces;
  const auto n = static_cast<std::uint32_t>(x.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i + 1; j < n; ++j) {
      for (std::uint32_t k = j + 1; k < n; ++k) {
        const Eigen::Vector3d normal = (x[j] - x[i]).cross(x[k] - x[i]);
        if (normal.isZero(0)) continue;  // collinear; exact for small integers
        Face on;
        bool above = false, below = false;
        for (std::uint32_t l = 0; l < n; ++l) {
          const bool corner = l == i || l == j || l == k;
          const double side = corner ? 0 : orientation(x[i], x[j], x[k], x[l]);
          above = above || side > 0;
          below = below || side < 0;
          if (side == 0) on.push_back(l);
        }
        if (above && below) continue;
        Eigen::Index longest = 0;
        normal.cwiseAbs().maxCoeff(&longest);
        const auto flat = [&](std::uint32_t v) {
          return Eigen::Vector2d(x[v][(longest + 1) % 3], x[v][(longest + 2) % 3]);
        };
        Face corners;
        for (const std::uint32_t v : on) {
          std::vector<Eigen::Vector2d> others;
          for (const std::uint32_t w : on) {
            if (w != v) others.push_back(flat(w));
          }
          if (!is_inside_others(flat(v), others)) corners.push_back(v);
        }
        faces.insert(corners);
      }
    }
  }
  return faces;
}

std::set<Face> sorted_faces(std::vector<Face> faces) {
  for (Face& face : faces) std::sort(face.begin(), face.end());
  return {faces.begin(), faces.end()};
}

std::set<std::uint32_t> vertices_of(const std::vector<Face>& faces) {
  std::set<std::uint32_t> vertices;
  for (const Face& face : faces) vertices.insert(face.begin(), face.end());
  return vertices;
}

/// Checks that the faces form a closed surface, that they are planar, and that all points lie on or
/// below the plane of each face, within the tolerance.
template <class T>
void check_encloses(const std::vector<Face>& faces, const std::vector<V3<T>>& points,
                    double tolerance) {
  REQUIRE(moreau::detail::is_closed_surface(faces));
  for (const Face& face : faces) {
    const auto plane = moreau::face_plane<Eigen::Matrix<long double, 3, 1>>(
        face.size(),
        [&](std::size_t k) { return points[face[k]].template cast<long double>().eval(); });
    const auto height = [&](const V3<T>& x) {
      return plane.normal.dot(x.template cast<long double>() - plane.center);
    };
    long double lowest = 0, highest = 0;
    for (const std::uint32_t v : face) lowest = std::min(lowest, height(points[v]));
    for (const auto& x : points) highest = std::max(highest, height(x));
    REQUIRE(lowest >= -tolerance);
    REQUIRE(highest <= tolerance);
  }
}

std::vector<Eigen::Vector3d> distinct_integer_points(int count, int bound,
                                                     std::mt19937_64& random) {
  std::uniform_int_distribution<int> coordinate(-bound, bound);
  std::vector<Eigen::Vector3d> points;
  while (points.size() < static_cast<std::size_t>(count)) {
    const Eigen::Vector3d x(coordinate(random), coordinate(random), coordinate(random));
    if (std::find(points.begin(), points.end(), x) == points.end()) points.push_back(x);
  }
  return points;
}

Eigen::Quaterniond random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized();
}

template <class T>
std::vector<V3<T>> moved(const std::vector<Eigen::Vector3d>& points, const Eigen::Quaterniond& q,
                         const Eigen::Vector3d& shift) {
  std::vector<V3<T>> result;
  for (const auto& x : points) result.push_back((q * x + shift).template cast<T>());
  return result;
}

/// The points of a lattice in the unit cube, with n + 1 points along each axis.
std::vector<Eigen::Vector3d> cube_lattice(int n) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) points.push_back(Eigen::Vector3d(i, j, k) / n);
    }
  }
  return points;
}

TEST_CASE("hull in space equals brute force, degenerate integer points") {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const auto points = distinct_integer_points(6 + trial % 13, 1 + trial % 4, random);
    const auto truth = brute_force_faces(points);
    if (truth.size() < 4) continue;  // all points in one plane, found as a face from both sides
    const auto faces = hull_of(points);
    REQUIRE(sorted_faces(faces) == truth);
    check_encloses(faces, points, 1e-13);
  }
}

TEST_CASE_TEMPLATE("a rigid motion does not change the faces", T, MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(4);
  const double epsilon = std::numeric_limits<T>::epsilon();
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const auto points = distinct_integer_points(5 + trial % 40, 2 + trial % 4, random);
    std::vector<Face> still;
    if (message_of([&] { still = hull_of(points); }) != "nothing thrown") continue;
    const Eigen::Vector3d shift = trial % 2 ? Eigen::Vector3d(7, -3, 9) : Eigen::Vector3d(0, 0, 0);
    const auto turned = moved<T>(points, random_rotation(random), shift);
    const auto faces = hull_of(turned);
    REQUIRE(faces == still);
    check_encloses(faces, turned, 64 * epsilon * 15);
  }
}

TEST_CASE("hull in space of random points equals brute force") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Eigen::Vector3d> points(20);
    for (auto& x : points) {
      for (double& c : x) c = coordinate(random);
      if (trial % 2) x.normalize();
    }
    const auto faces = hull_of(points);
    REQUIRE(sorted_faces(faces) == brute_force_faces(points));
    if (trial % 2) CHECK(faces.size() == 2 * points.size() - 4);
  }
}

TEST_CASE("the order of the points does not change the hull") {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> noise(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    auto points = cube_lattice(3);
    // The perturbation is zero, of the size of the tolerance, or much larger.
    const double size = trial == 0 ? 0 : std::pow(10.0, -18 + trial % 8);
    for (auto& x : points) {
      for (double& c : x) c += size * noise(random);
    }
    const auto faces = hull_of(points);
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Eigen::Vector3d> shuffled;
    for (const std::uint32_t i : order) shuffled.push_back(points[i]);
    auto back = hull_of(shuffled);
    for (Face& face : back) {
      for (std::uint32_t& v : face) v = order[v];
    }
    REQUIRE(sorted_faces(back) == sorted_faces(faces));
  }
}

TEST_CASE("noise around the tolerance always leaves a closed convex surface") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> noise(-1, 1);
  for (int trial = 0; trial < 75; ++trial) {
    CAPTURE(trial);
    auto points = trial % 3 ? cube_lattice(4) : std::vector<Eigen::Vector3d>{};
    for (int k = 0; k < 24 && trial % 3 == 0; ++k) {  // a prism with many narrow sides
      const double angle = 2 * std::numbers::pi * k / 24;
      for (const double z : {-1.0, -0.2, 0.7, 1.0}) {
        points.emplace_back(std::cos(angle), std::sin(angle), z);
      }
    }
    const double size = std::pow(10.0, -17 + 0.1 * trial);
    const auto q = random_rotation(random);
    for (auto& x : points) {
      x = q * x;
      for (double& c : x) c += size * noise(random);
    }
    const auto faces = hull_of(points);
    // The tolerance may have been increased by a factor of 64, and the deviation may be twice the
    // tolerance.
    check_encloses(faces, points, 128 * 32 * std::numeric_limits<double>::epsilon() * 1.8);
    if (size < 2e-15) REQUIRE(faces.size() == (trial % 3 ? 6 : 26));
  }
}

TEST_CASE_TEMPLATE("subdivided, needle-like and plate-like boxes have six faces", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(8);
  for (const Eigen::Vector3d& scale :
       {Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(100, 1, 1), Eigen::Vector3d(100, 100, 1),
        Eigen::Vector3d(1e-3, 2e-3, 0.1), Eigen::Vector3d(1e3, 10, 1e3)}) {
    for (int trial = 0; trial < 4; ++trial) {
      auto points = cube_lattice(1 + trial);
      for (auto& x : points) x = scale.cwiseProduct(x);
      const auto faces =
          hull_of(moved<T>(points, random_rotation(random), Eigen::Vector3d::Zero()));
      REQUIRE(faces.size() == 6);
      REQUIRE(vertices_of(faces).size() == 8);
      for (const Face& face : faces) REQUIRE(face.size() == 4);
    }
  }
}

TEST_CASE("a box cut very unevenly has six faces") {
  // The cuts are at 1e-9 to 0.5 of the side, so that slivers of many proportions lie between them.
  std::vector<double> cuts{0, 1e-9, 1e-6, 1e-3, 0.5, 1};
  std::vector<Eigen::Vector3d> points;
  for (const double x : cuts) {
    for (const double y : cuts) {
      for (const double z : {0.0, 1e-7, 1.0}) points.emplace_back(x, y, z);
    }
  }
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 8; ++trial) {
    const auto faces =
        hull_of(moved<double>(points, random_rotation(random), Eigen::Vector3d(0.1, 2, 0.3)));
    REQUIRE(faces.size() == 6);
    REQUIRE(vertices_of(faces).size() == 8);
  }
}

TEST_CASE_TEMPLATE("prisms and bipyramids", T, MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(10);
  for (int n = 3; n <= 20; ++n) {
    CAPTURE(n);
    std::vector<Eigen::Vector3d> prism, bipyramid{{0, 0, 0.7}, {0, 0, -0.4}};
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      const Eigen::Vector3d x(std::cos(angle), std::sin(angle), 0);
      bipyramid.push_back(x);
      for (const double z : {-0.5, 0.1, 0.5}) prism.push_back(x + Eigen::Vector3d(0, 0, z));
    }
    const auto q = random_rotation(random);
    const auto of_prism = hull_of(moved<T>(prism, q, Eigen::Vector3d(0, 3, 0)));
    CHECK(of_prism.size() == static_cast<std::size_t>(n) + 2);
    CHECK(vertices_of(of_prism).size() == static_cast<std::size_t>(2 * n));
    const auto of_bipyramid = hull_of(moved<T>(bipyramid, q, Eigen::Vector3d(0, 3, 0)));
    CHECK(of_bipyramid.size() == static_cast<std::size_t>(2 * n));
  }
}

TEST_CASE_TEMPLATE("the Platonic solids with their faces", T, MOREAU_TYPES((double), (float))) {
  const double g = std::numbers::phi;
  std::vector<Eigen::Vector3d> cube, dodecahedron, icosahedron, octahedron;
  for (const int a : {-1, 1}) {
    for (int k = 0; k < 3; ++k) octahedron.push_back(a * Eigen::Vector3d::Unit(k));
    for (const int b : {-1, 1}) {
      for (const int c : {-1, 1}) cube.emplace_back(a, b, c);
      for (int k = 0; k < 3; ++k) {
        Eigen::Vector3d x = Eigen::Vector3d::Zero(), y = x;
        x[k] = a / g;
        x[(k + 1) % 3] = b * g;
        y[k] = a;
        y[(k + 1) % 3] = b * g;
        dodecahedron.push_back(x);
        icosahedron.push_back(y);
      }
    }
  }
  dodecahedron.insert(dodecahedron.end(), cube.begin(), cube.end());
  std::mt19937_64 random(11);
  const auto check = [&](const auto& points, std::size_t faces, std::size_t corners) {
    const auto hull = hull_of(moved<T>(points, random_rotation(random), Eigen::Vector3d::Zero()));
    CHECK(hull.size() == faces);
    for (const Face& face : hull) CHECK(face.size() == corners);
  };
  check(octahedron, 8, 3);
  check(cube, 6, 4);
  check(dodecahedron, 12, 5);
  check(icosahedron, 20, 3);
}

TEST_CASE("many vertices on a sphere are all kept") {
  std::mt19937_64 random(12);
  std::normal_distribution<double> normal;
  for (const std::size_t n : {100UL, 600UL}) {
    std::vector<Eigen::Vector3d> points(n);
    for (auto& x : points) x = Eigen::Vector3d(normal(random), normal(random), normal(random));
    for (auto& x : points) x.normalize();
    const auto faces = hull_of(points);
    CHECK(vertices_of(faces).size() == n);
    CHECK(faces.size() == 2 * n - 4);
    check_encloses(faces, points, 1e-13);
  }
}

TEST_CASE("duplicates are harmless, the first of equals is kept") {
  std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},    {0, 0, 1},
                                      {1, 0, 0}, {0, 0, 0}, {1e-17, 1, 0}};
  CHECK(vertices_of(hull_of(points)) == std::set<std::uint32_t>{0, 1, 2, 3});
  CHECK(hull_of(points).size() == 4);
  std::vector<Eigen::Vector2d> square{{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  CHECK(hull_of(square) == Face{0, 1, 3, 4});
}

TEST_CASE("very large and very small coordinates") {
  for (const double scale : {1e-250, 1e-30, 1e30, 1e250}) {
    auto points = cube_lattice(2);
    for (auto& x : points) x *= scale;
    CHECK(hull_of(points).size() == 6);
  }
}

TEST_CASE("hull in the plane equals brute force") {
  std::mt19937_64 random(13);
  std::uniform_int_distribution<int> coordinate(-3, 3);
  for (int trial = 0; trial < 150; ++trial) {
    std::vector<Eigen::Vector2d> points;
    while (points.size() < static_cast<std::size_t>(5 + trial % 20)) {
      const Eigen::Vector2d x(coordinate(random), coordinate(random));
      if (std::find(points.begin(), points.end(), x) == points.end()) points.push_back(x);
    }
    std::set<std::uint32_t> truth;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      auto others = points;
      others.erase(others.begin() + i);
      if (!is_inside_others(points[i], others)) truth.insert(i);
    }
    if (truth.size() < 3) continue;
    const Eigen::Rotation2Dd turn(trial);
    std::vector<Eigen::Vector2d> turned;
    for (const auto& x : points) turned.push_back(turn * x + Eigen::Vector2d(trial % 3, 1));
    for (const auto& input : {points, turned}) {
      const Face ring = hull_of(input);
      REQUIRE(std::set<std::uint32_t>(ring.begin(), ring.end()) == truth);
      REQUIRE(ring.front() == *truth.begin());
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const auto n = ring.size();
        REQUIRE(orientation(input[ring[k]], input[ring[(k + 1) % n]], input[ring[(k + 2) % n]]) >
                0);
      }
    }
  }
}

TEST_CASE_TEMPLATE("points along the sides of a polygon are dropped", T,
                   MOREAU_TYPES((double), (float))) {
  for (int n = 3; n <= 12; ++n) {
    std::vector<V2<T>> points;
    for (int k = 0; k < n; ++k) {
      const auto corner = [&](int i) -> Eigen::Vector2d {
        return Eigen::Vector2d(std::cos(2 * std::numbers::pi * i / n + 0.1),
                               0.01 * std::sin(2 * std::numbers::pi * i / n + 0.1));
      };
      for (int m = 0; m < 7; ++m) {
        const Eigen::Vector2d x = ((7 - m) * corner(k) + m * corner(k + 1)) / 7;
        points.push_back(x.template cast<T>());
      }
    }
    CHECK(hull_of(points).size() == static_cast<std::size_t>(n));
  }
}

TEST_CASE("bad input in space is named") {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto message = [&] { return message_of([&] { hull_of(points); }); };
  CHECK(message() == "convex_hull: vertices.size() = 3 must be at least 4");
  points.emplace_back(nan, 0, 1);
  CHECK(message() == "convex_hull: vertices[3] = (nan, 0, 1) must be finite");
  points[3] = {0, inf, 1};
  CHECK(message() == "convex_hull: vertices[3] = (0, inf, 1) must be finite");
  points[3] = {0.3, 0.3, 0};
  CHECK(message() == "convex_hull: thickness of vertices = 0 m must not vanish: they are coplanar");
  points[3] = {0.3, 0.3, 1e-14};
  CHECK(message() ==
        "convex_hull: thickness of vertices = 1e-14 m must not vanish: they are coplanar");
  points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {5, 5, 5}};
  CHECK(message() ==
        "convex_hull: thickness of vertices = 0 m must not vanish: they are collinear");
  points.assign(5, {1, 2, 3});
  CHECK(message() == "convex_hull: thickness of vertices = 0 m must not vanish: they coincide");
  points.assign(5, {0, 0, 0});
  CHECK(message() == "convex_hull: thickness of vertices = 0 m must not vanish: they coincide");
  // A thin plate is valid input.
  points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-9}};
  CHECK(hull_of(points).size() == 4);
}

TEST_CASE("bad input in the plane is named") {
  std::vector<Eigen::Vector2f> points{{0, 0}, {1, 0}};
  const auto message = [&] { return message_of([&] { hull_of(points); }); };
  CHECK(message() == "convex_hull: vertices.size() = 2 must be at least 3");
  points.emplace_back(2.0F, 0.0F);
  CHECK(message() ==
        "convex_hull: thickness of vertices = 0 m must not vanish: they are collinear");
  points[1].x() = std::nanf("");
  CHECK(message() == "convex_hull: vertices[1] = (nan, 0) must be finite");
  points.assign(3, {4.0F, 4.0F});
  CHECK(message() == "convex_hull: thickness of vertices = 0 m must not vanish: they coincide");
}

}  // namespace
