// SPDX-License-Identifier: MIT
#include "moreau/shape/polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using moreau::Polyhedron;
using moreau::Pose;
using moreau::Space;
template <class T>
using V3 = Eigen::Matrix<T, 3, 1>;
using FaceLists = std::vector<std::vector<std::uint32_t>>;

static_assert(moreau::Polytope<Polyhedron<double>>);
static_assert(moreau::Polytope<Polyhedron<float>>);

template <class T>
constexpr double tolerance = 64 * std::numeric_limits<T>::epsilon();

template <class T>
Polyhedron<T> hull(const std::vector<V3<T>>& points) {
  return Polyhedron<T>(std::span<const V3<T>>(points));
}

template <class T>
Polyhedron<T> from_faces(const std::vector<V3<T>>& vertices, const FaceLists& faces) {
  return Polyhedron<T>::from_faces(vertices, faces);
}

template <class T>
std::vector<V3<T>> box_vertices(T a, T b, T c) {
  std::vector<V3<T>> vertices;
  for (int k = 0; k < 8; ++k) {
    vertices.emplace_back(k & 1 ? a / 2 : -a / 2, k & 2 ? b / 2 : -b / 2, k & 4 ? c / 2 : -c / 2);
  }
  return vertices;
}

const FaceLists box_faces{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

template <class T>
V3<T> random_vector(std::mt19937_64& random) {
  std::uniform_real_distribution<T> coordinate(-1, 1);
  return V3<T>(coordinate(random), coordinate(random), coordinate(random));
}

template <class T>
Eigen::Quaternion<T> random_rotation(std::mt19937_64& random) {
  Eigen::Quaternion<T> q;
  q.coeffs() << random_vector<T>(random), T(0.3);
  return q.normalized();
}

template <class T>
std::vector<V3<T>> random_points(std::size_t n, std::mt19937_64& random) {
  std::vector<V3<T>> points(n);
  for (auto& x : points) x = random_vector<T>(random);
  return points;
}

template <class T>
double distance(const Eigen::Matrix<T, 3, 3>& a, const Eigen::Matrix<T, 3, 3>& b) {
  return static_cast<double>((a - b).norm() / b.norm());
}

/// Checks all relations between vertices, edges and faces.
template <class T>
void check_incidences(const Polyhedron<T>& p) {
  REQUIRE(p.vertex_count() + p.face_count() == p.edge_count() + 2);
  std::size_t triangles = 0;
  std::vector<std::size_t> faces_at(p.vertex_count(), 0);
  for (std::uint32_t f = 0; f < p.face_count(); ++f) {
    const auto face = p.face(f), edges = p.face_edges(f);
    REQUIRE(face.size() == edges.size());
    triangles += face.size() - 2;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % face.size()];
      const auto& edge = p.edges()[edges[k]];
      const bool forward = edge.vertex[0] == a && edge.vertex[1] == b && edge.face[0] == f;
      const bool backward = edge.vertex[0] == b && edge.vertex[1] == a && edge.face[1] == f;
      REQUIRE(forward != backward);
      const auto at = p.vertex_faces(a);
      REQUIRE(std::binary_search(at.begin(), at.end(), f));
      ++faces_at[a];
    }
  }
  REQUIRE(triangles == p.triangle_count());
  for (std::size_t v = 0; v < p.vertex_count(); ++v) {
    REQUIRE(p.vertex_faces(v).size() == faces_at[v]);
    REQUIRE(p.vertex_edges(v).size() == faces_at[v]);
    for (const std::uint32_t e : p.vertex_edges(v)) {
      const auto& ends = p.edges()[e].vertex;
      REQUIRE((ends[0] == v || ends[1] == v));
    }
  }
}

/// Checks that the faces are planar, have outward normals and are supporting planes, and that the
/// origin is the centre of mass.
template <class T>
void check_geometry(const Polyhedron<T>& p) {
  const double close = tolerance<T> * static_cast<double>(p.circumradius());
  for (std::size_t f = 0; f < p.face_count(); ++f) {
    const auto row = static_cast<Eigen::Index>(f);
    const V3<T> normal = p.face_normals().row(row).transpose();
    REQUIRE(std::abs(normal.norm() - 1) < tolerance<T>);
    const auto heights = (p.vertices() * normal).array() - p.face_offsets()[row];
    REQUIRE(heights.maxCoeff() < close);
    for (const std::uint32_t v : p.face(f)) REQUIRE(std::abs(heights[v]) < close);
    const auto at = [&](std::size_t k) { return p.vertices().row(p.face(f)[k]).transpose(); };
    REQUIRE(normal.dot((at(1) - at(0)).cross(at(2) - at(1))) > 0);
  }
  REQUIRE(p.inradius() > 0);
  REQUIRE(p.inradius() <= p.circumradius());
  REQUIRE(p.circumradius() == doctest::Approx(p.vertices().rowwise().norm().maxCoeff()));
  REQUIRE(p.mass_properties(1).center == V3<T>::Zero());
}

TEST_CASE_TEMPLATE("a box has the moments of a box, turned and moved as well", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(1);
  const T a = T(0.3), b = T(1.1), c = T(2.3), density = 2700;
  for (int trial = 0; trial < 20; ++trial) {
    const auto q = random_rotation<T>(random);
    const V3<T> shift = T(3) * random_vector<T>(random);
    auto vertices = box_vertices(a, b, c);
    for (auto& x : vertices) x = q * x + shift;
    const auto box = hull(vertices);
    check_incidences(box);
    check_geometry(box);
    CHECK(box.face_count() == 6);
    CHECK(box.edge_count() == 12);
    CHECK((box.centroid_of_input() - shift).norm() < tolerance<T>);
    CHECK(box.volume() == doctest::Approx(a * b * c).epsilon(tolerance<T>));
    const auto mass = box.mass_properties(density);
    CHECK(mass.mass == doctest::Approx(density * a * b * c).epsilon(tolerance<T>));
    const V3<T> moments(b * b + c * c, a * a + c * c, a * a + b * b);
    const Eigen::Matrix<T, 3, 3> rotation = q.toRotationMatrix(),
                                 truth = rotation * (mass.mass / 12 * moments).asDiagonal() *
                                         rotation.transpose();
    CHECK(distance(mass.inertia, truth) < tolerance<T>);
    CHECK(box.circumradius() == doctest::Approx(V3<T>(a, b, c).norm() / 2).epsilon(tolerance<T>));
    CHECK(box.inradius() == doctest::Approx(a / 2).epsilon(10 * tolerance<T>));
  }
}

TEST_CASE_TEMPLATE("any tetrahedron: volume, centre, and second moment in closed form", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    auto points = random_points<T>(4, random);
    Eigen::Matrix<double, 3, 4> x;
    for (int k = 0; k < 4; ++k)
      x.col(k) = points[static_cast<std::size_t>(k)].template cast<double>();
    const Eigen::Vector3d center = x.rowwise().mean();
    const double volume =
        std::abs((x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).dot(x.col(3) - x.col(0))) / 6;
    if (volume < 0.01) continue;
    const auto p = hull(points);
    check_incidences(p);
    check_geometry(p);
    CHECK(p.face_count() == 4);
    CHECK(p.volume() == doctest::Approx(volume).epsilon(10 * tolerance<T>));
    CHECK((p.centroid_of_input().template cast<double>() - center).norm() < 10 * tolerance<T>);
    // The second moment of a tetrahedron about its centre is that of four point masses m / 20 at
    // its vertices.
    const Eigen::Matrix<double, 3, 4> y = x.colwise() - center;
    const Eigen::Matrix3d second = volume / 20 * y * y.transpose();
    const Eigen::Matrix3d inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
    CHECK(distance<double>(p.mass_properties(1).inertia.template cast<double>(), inertia) <
          20 * tolerance<T>);
  }
}

TEST_CASE("octahedron and regular prisms in closed form") {
  std::vector<Eigen::Vector3d> octahedron;
  for (int k = 0; k < 3; ++k) {
    for (const int sign : {-1, 1}) octahedron.push_back(sign * Eigen::Vector3d::Unit(k));
  }
  const auto eight = hull(octahedron);
  CHECK(eight.volume() == doctest::Approx(4.0 / 3).epsilon(1e-14));
  // An octahedron with the edge length a = sqrt(2) has the moment of inertia m a^2 / 10.
  CHECK(distance<double>(eight.mass_properties(3).inertia, 4 * 0.2 * Eigen::Matrix3d::Identity()) <
        1e-14);

  for (int n = 3; n <= 12; ++n) {
    const double height = 0.7, radius = 1.3, step = 2 * std::numbers::pi / n;
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < n; ++k) {
      for (const double z : {0.0, height}) {
        points.emplace_back(radius * std::cos(k * step), radius * std::sin(k * step), z);
      }
    }
    const auto prism = hull(points);
    const auto mass = prism.mass_properties(1);
    CHECK(prism.volume() ==
          doctest::Approx(n / 2.0 * radius * radius * std::sin(step) * height).epsilon(1e-13));
    const double polar = mass.mass * radius * radius / 6 * (2 + std::cos(step));
    const double across = polar / 2 + mass.mass * height * height / 12;
    CHECK(distance<double>(mass.inertia, Eigen::Vector3d(across, across, polar).asDiagonal()) <
          1e-13);
    CHECK((prism.centroid_of_input() - Eigen::Vector3d(0, 0, height / 2)).norm() < 1e-14);
  }
}

TEST_CASE_TEMPLATE("random hulls: geometry, incidences, mass by summation over points", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(3);
  for (std::size_t n = 4; n <= 100; n += 8) {
    const auto p = hull(random_points<T>(n, random));
    check_incidences(p);
    check_geometry(p);
  }
  // A plane through the origin divides the polyhedron: both parts together have the volume of the
  // whole.
  auto points = random_points<T>(60, random);
  const auto whole = hull(points);
  std::vector<V3<T>> halves[2];
  for (Eigen::Index v = 0; v < whole.vertices().rows(); ++v) {
    const V3<T> x = whole.vertices().row(v).transpose();
    halves[x.z() > 0].push_back(x);
  }
  for (const auto& edge : whole.edges()) {
    const V3<T> x = whole.vertices().row(edge.vertex[0]).transpose(),
                y = whole.vertices().row(edge.vertex[1]).transpose();
    if (x.z() * y.z() >= 0) continue;
    for (auto& half : halves) half.push_back((x * y.z() - y * x.z()) / (y.z() - x.z()));
  }
  CHECK(hull(halves[0]).volume() + hull(halves[1]).volume() ==
        doctest::Approx(whole.volume()).epsilon(tolerance<T>));
}

TEST_CASE("the vertices of the input that are kept, are kept in order") {
  std::vector<Eigen::Vector3d> points = box_vertices(1.0, 2.0, 3.0);
  points.insert(points.begin() + 3, Eigen::Vector3d(0.1, 0.2, 0.3));
  points.insert(points.begin() + 6, Eigen::Vector3d(0.5, 0.2, 0.3));
  const auto p = hull(points);
  CHECK(p.vertex_count() == 8);
  for (int k = 0; k < 8; ++k) {
    CHECK(p.vertices().row(k).transpose() ==
          box_vertices(1.0, 2.0, 3.0)[static_cast<std::size_t>(k)]);
  }
}

TEST_CASE_TEMPLATE("support and bounding box equal a search over all vertices", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const auto p = hull(random_points<T>(30, random));
    const V3<T> direction = random_vector<T>(random);
    const std::size_t v = p.support_vertex(direction);
    const auto reach = (p.vertices() * direction).eval();
    CHECK(p.support(direction).transpose() == p.vertices().row(static_cast<Eigen::Index>(v)));
    CHECK(reach.maxCoeff() - p.support(direction).dot(direction) < tolerance<T>);

    Pose<Space<3, T>> pose;
    pose.position = random_vector<T>(random);
    pose.rotation = random_rotation<T>(random);
    moreau::Aabb<Space<3, T>> truth;
    for (Eigen::Index k = 0; k < p.vertices().rows(); ++k) {
      truth.merge(pose(p.vertices().row(k).transpose()));
    }
    const auto box = p.bounding_box(pose);
    CHECK((box.lower - truth.lower).norm() < tolerance<T>);
    CHECK((box.upper - truth.upper).norm() < tolerance<T>);
  }
}

TEST_CASE_TEMPLATE("scaled keeps the incidences and scales the rest", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(5);
  const auto p = hull(random_points<T>(20, random));
  const auto twice = p.scaled(2);
  check_incidences(twice);
  check_geometry(twice);
  CHECK(twice.vertices() == 2 * p.vertices());
  CHECK(twice.face_normals() == p.face_normals());
  CHECK((twice.face_offsets() == 2 * p.face_offsets()).all());
  CHECK(twice.volume() == 8 * p.volume());
  CHECK(twice.circumradius() == 2 * p.circumradius());
  CHECK(twice.mass_properties(3).inertia == 32 * p.mass_properties(3).inertia);
  const auto third = p.scaled(T(1) / 3);
  check_geometry(third);
  CHECK(third.volume() == doctest::Approx(p.volume() / 27).epsilon(tolerance<T>));
}

TEST_CASE_TEMPLATE("from_faces takes its own faces back", T, MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(6);
  const auto box = from_faces(box_vertices<T>(1, 2, 3), box_faces);
  check_incidences(box);
  check_geometry(box);
  CHECK(box.volume() == doctest::Approx(6));
  for (int trial = 0; trial < 30; ++trial) {
    const auto p = hull(random_points<T>(6 + static_cast<std::size_t>(trial), random));
    std::vector<V3<T>> vertices;
    for (Eigen::Index v = 0; v < p.vertices().rows(); ++v) {
      vertices.push_back(p.vertices().row(v).transpose() + V3<T>(1, 2, 3));
    }
    FaceLists faces;
    for (std::size_t f = 0; f < p.face_count(); ++f) {
      faces.emplace_back(p.face(f).begin(), p.face(f).end());
    }
    const auto again = from_faces(vertices, faces);
    check_geometry(again);
    CHECK((again.centroid_of_input() - V3<T>(1, 2, 3)).norm() < 4 * tolerance<T>);
    CHECK(again.volume() == doctest::Approx(p.volume()).epsilon(4 * tolerance<T>));
  }
}

TEST_CASE("from_faces names what is wrong") {
  const auto vertices = box_vertices(1.0, 1.0, 1.0);
  const auto message = [](const std::vector<Eigen::Vector3d>& v, const FaceLists& f) {
    return message_of([&] { from_faces(v, f); });
  };
  const std::string where = "Polyhedron::from_faces: ";
  CHECK(message({}, {}) == where + "vertices.size() = 0 must be at least 4");
  CHECK(message(vertices, {}) == where + "number of faces at vertices[0] = 0 must be at least 3");

  auto bad_vertices = vertices;
  bad_vertices[2].y() = std::nan("");
  CHECK(message(bad_vertices, box_faces) ==
        where + "vertices[2] = (-0.5, nan, -0.5) must be finite");
  bad_vertices = vertices;
  bad_vertices.emplace_back(0, 0, 0);
  CHECK(message(bad_vertices, box_faces) ==
        where + "number of faces at vertices[8] = 0 must be at least 3");
  bad_vertices = vertices;
  bad_vertices[7] *= 0.9;
  CHECK(message(bad_vertices, box_faces).find("m must be 0: planar faces") != std::string::npos);
  bad_vertices[7] = {0.5, 0.5, 0.4999999};
  CHECK(message(bad_vertices, box_faces).find("m must be 0: planar faces") != std::string::npos);

  FaceLists faces = box_faces;
  faces[3] = {2, 6};
  CHECK(message(vertices, faces) == where + "faces[3].size() = 2 must be at least 3");
  faces[3] = {2, 6, 8, 3};
  CHECK(message(vertices, faces) ==
        where + "a vertex of faces[3] = 8 must be below the number of vertices, 8");
  faces[3] = {2, 6, 7, 2};
  CHECK(message(vertices, faces) == where + "a vertex of faces[3] = 2 must not occur twice");
  faces = box_faces;
  faces.pop_back();
  CHECK(message(vertices, faces) ==
        where + "edge = (1, 5) must run back in another face: the surface is not closed");
  faces = box_faces;
  std::reverse(faces[2].begin(), faces[2].end());
  CHECK(message(vertices, faces) == where + "edge = (4, 5) must not run the same way in two faces");
  for (auto& face : faces = box_faces) std::reverse(face.begin(), face.end());
  CHECK(message(vertices, faces) ==
        where + "volume = -1 m^3 must be positive: faces run counter-clockwise seen from outside");
}

TEST_CASE("from_faces refuses coplanar neighbours, dents, two bodies, straight corners") {
  const auto message = [](const std::vector<Eigen::Vector3d>& v, const FaceLists& f) {
    return message_of([&] { from_faces(v, f); });
  };
  const auto vertices = box_vertices(1.0, 1.0, 1.0);
  FaceLists split = box_faces;
  split[0] = {0, 2, 3};
  split.push_back({0, 3, 1});
  CHECK(message(vertices, split) ==
        "Polyhedron::from_faces: height of vertices[1] above faces[0] = 0 m must be negative: "
        "convex, coplanar neighbours joined");

  // The top has the form of a pyramid that is pushed into the box.
  auto dented = vertices;
  dented.emplace_back(0, 0, 0.2);
  FaceLists dent = box_faces;
  dent[1] = {4, 5, 8};
  dent.insert(dent.end(), {{5, 7, 8}, {7, 6, 8}, {6, 4, 8}});
  CHECK(message(dented, dent).find("must be negative: convex") != std::string::npos);
  dented[8].z() = 0.8;
  CHECK(message(dented, dent) == "nothing thrown");

  auto twins = vertices;
  for (const auto& x : vertices) twins.push_back(x + Eigen::Vector3d(3, 0, 0));
  FaceLists both = box_faces;
  for (const auto& face : box_faces) {
    both.push_back(face);
    for (std::uint32_t& v : both.back()) v += 8;
  }
  CHECK(message(twins, both) ==
        "Polyhedron::from_faces: V - E + F = 4 must be 2: one closed surface, no holes");

  auto straight = vertices;
  straight.emplace_back(0, -0.5, -0.5);
  FaceLists corner = box_faces;
  corner[0] = {0, 2, 3, 1, 8};
  corner[2] = {0, 8, 1, 5, 4};
  CHECK(message(straight, corner) ==
        "Polyhedron::from_faces: number of faces at vertices[8] = 2 must be at least 3");
}

// Its faces join second neighbours of an icosahedron. Every edge is convex, and V - E + F is 2.
TEST_CASE("from_faces refuses a great icosahedron, which surrounds its centre seven times") {
  std::vector<Eigen::Vector3d> vertices;
  const double golden = std::numbers::phi;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      vertices.insert(vertices.end(), {{0, a, b}, {a, b, 0}, {b, 0, a}});
  FaceLists faces;
  const auto far = [&](std::uint32_t i, std::uint32_t j) {
    return std::abs((vertices[i] - vertices[j]).norm() - 2 * golden) < 1e-9;
  };
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      for (std::uint32_t k = 0; k < j; ++k)
        if (far(i, j) && far(j, k) && far(k, i)) {
          const auto normal = (vertices[j] - vertices[i]).cross(vertices[k] - vertices[i]);
          const bool out = normal.dot(vertices[i]) > 0;
          faces.push_back({i, out ? j : k, out ? k : j});
        }
  REQUIRE(faces.size() == 20);
  CHECK(message_of([&] { from_faces(vertices, faces); }).find("must be negative: convex") !=
        std::string::npos);
}

// 30,000 vertices: all faces against all vertices would be 2e9 heights.
TEST_CASE("from_faces takes large polyhedra") {
  std::vector<Eigen::Vector3d> vertices;
  FaceLists faces(2);
  const std::uint32_t n = 15000;
  for (std::uint32_t k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    for (const double z : {-1.0, 1.0}) vertices.emplace_back(std::cos(angle), std::sin(angle), z);
    const std::uint32_t next = (k + 1) % n;
    faces[0].push_back(2 * (n - 1 - k));
    faces[1].push_back(2 * k + 1);
    faces.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
  }
  CHECK(from_faces(vertices, faces).volume() ==
        doctest::Approx(n * std::sin(2 * std::numbers::pi / n)));
}

TEST_CASE_TEMPLATE("bad arguments are named", T, MOREAU_TYPES((double), (float))) {
  const T nan = std::numeric_limits<T>::quiet_NaN(), inf = std::numeric_limits<T>::infinity();
  auto vertices = box_vertices<T>(1, 1, 1);
  const auto box = hull(vertices);
  CHECK(message_of([&] { box.mass_properties(0); }) ==
        "Polyhedron::mass_properties: density = 0 must be finite and > 0");
  CHECK(message_of([&] { box.mass_properties(-2); }) ==
        "Polyhedron::mass_properties: density = -2 must be finite and > 0");
  CHECK(message_of([&] { box.mass_properties(nan); }) ==
        "Polyhedron::mass_properties: density = nan must be finite and > 0");
  CHECK(message_of([&] { return box.scaled(0); }) ==
        "Polyhedron::scaled: factor = 0 must be finite and > 0");
  CHECK(message_of([&] { return box.scaled(inf); }) ==
        "Polyhedron::scaled: factor = inf must be finite and > 0");
  for (auto& x : vertices) x *= std::numeric_limits<T>::max() / 4;
  CHECK(message_of([&] { hull(vertices); }).find("nan m^3 must be finite") != std::string::npos);
  vertices[3] = V3<T>(nan, 0, 1);
  CHECK(message_of([&] { hull(vertices); }) ==
        "Polyhedron: vertices[3] = (nan, 0, 1) must be finite");
  for (auto& x : vertices) x = V3<T>(x.y(), x.z(), 1);
  vertices[3] = V3<T>(0, 0, 1);
  CHECK(message_of([&] { hull(vertices); }) ==
        "Polyhedron: thickness of vertices = 0 m must not vanish: they are coplanar");
  vertices.resize(3);
  CHECK(message_of([&] { hull(vertices); }) ==
        "Polyhedron: vertices.size() = 3 must be at least 4");
}

}  // namespace

TEST_CASE("a polyhedron of which the scalar cannot hold the moments is refused") {
  const auto tetrahedron = [](float size) {
    return hull<float>({{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}});
  };
  CHECK_NOTHROW(tetrahedron(1e-6f));
  CHECK_THROWS_WITH_AS(tetrahedron(1e-10f), doctest::Contains("Polyhedron: second moment = 0 m^5"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(tetrahedron(1e9f), doctest::Contains("Polyhedron: second moment = inf m^5"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(static_cast<void>(tetrahedron(1).scaled(1e9f)),
                       doctest::Contains("Polyhedron::scaled: second moment"),
                       std::invalid_argument);
}
