// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <doctest/doctest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "moreau/mesh/check_mesh.hpp"
#include "moreau/mesh/convex_of_mesh.hpp"
#include "moreau/mesh/facet_mesh.hpp"
#include "moreau/mesh/mesh_wall.hpp"
#include "moreau/mesh/repair_mesh.hpp"
#include "moreau/sample/concave_mesh.hpp"
#include "moreau/shape/regular_shape.hpp"
#include "moreau/shape/simplify_hull.hpp"

#include "shape/message_of.hpp"

namespace {

using namespace moreau;
using Plane = Space<2, double>;
using Volume = Space<3, double>;
using Flat = Space<2, float>;
using Solid = Space<3, float>;

/// A cube of edge 1 with a corner at the origin, in the plane a square.
FacetMesh<Volume> cube(Volume = {}) {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
          {{0, 2, 1},
           {0, 3, 2},
           {4, 5, 6},
           {4, 6, 7},
           {0, 1, 5},
           {0, 5, 4},
           {1, 2, 6},
           {1, 6, 5},
           {2, 3, 7},
           {2, 7, 6},
           {3, 0, 4},
           {3, 4, 7}}};
}
FacetMesh<Plane> cube(Plane) {
  return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
}

/// Appends a mesh, moved.
template <class S>
void append(FacetMesh<S>& mesh, const FacetMesh<S>& other, const typename S::Vector& by) {
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const auto& x : other.vertices) mesh.vertices.push_back(x + by);
  for (auto facet : other.facets) {
    for (auto& v : facet) v += first;
    mesh.facets.push_back(facet);
  }
}

/// Every facet with corners of its own, as in an STL file.
template <class S>
FacetMesh<S> soup(const FacetMesh<S>& mesh) {
  FacetMesh<S> parted;
  for (const auto& facet : mesh.facets) {
    auto& own = parted.facets.emplace_back();
    for (std::size_t k = 0; k < facet.size(); ++k) {
      own[k] = std::uint32_t(parted.vertices.size());
      parted.vertices.push_back(mesh.vertices[facet[k]]);
    }
  }
  return parted;
}

template <class S>
std::string fault(const FacetMesh<S>& mesh) {
  const auto found = find_solid_fault(mesh);
  return found ? std::string(name(found->defect)) + ": " + found->message : "none";
}

}  // namespace

TEST_CASE_TEMPLATE("mass properties of a mesh are those of its polytope", S, Plane, Volume) {
  const auto far = typename S::Vector(S::Vector::Constant(1000));
  FacetMesh<S> mesh;
  append(mesh, cube(S{}), far);
  CHECK(fault(mesh) == "none");
  const auto whole = mass_properties(mesh, 2.0);
  const auto polytope = convex_of_mesh(mesh);
  const auto exact = polytope.mass_properties(2.0);
  CHECK(whole.mass == doctest::Approx(2).epsilon(1e-12));
  CHECK((whole.center - far - S::Vector::Constant(0.5)).norm() < 1e-12);
  CHECK((whole.inertia - exact.inertia).norm() < 1e-12);
  CHECK(polytope.vertex_count() == std::size_t(1) << S::dim);
}

TEST_CASE_TEMPLATE("a mesh without a volume or a density has no mass", S, Plane, Volume) {
  auto mesh = cube(S{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double density : {0., -1., nan})
    CHECK(message_of([&] {
            (void)mass_properties(mesh, density);
          }).find("mass_properties: density") == 0);
  for (auto& facet : mesh.facets) std::swap(facet[0], facet[1]);  // inside out
  CHECK(message_of([&] {
          (void)mass_properties(mesh, 1.);
        }).find("mass_properties: volume of the mesh = -") == 0);
  mesh.facets.resize(1);
  for (auto& x : mesh.vertices) x[S::dim - 1] = 0;
  CHECK(message_of([&] { (void)mass_properties(mesh, 1.); }).find("mass_properties: volume") == 0);
}

TEST_CASE_TEMPLATE("a closed surface in every form", S, Plane, Volume) {
  CHECK(fault(pebble_mesh<S>(0.01, 5, 1)) == "none");
  CHECK_THROWS_WITH(pebble_mesh<S>(-0.01, 5, 1), doctest::Contains("pebble_mesh: radius = -0.01"));
  CHECK_THROWS_WITH(pebble_mesh<S>(0.01, -1, 1), doctest::Contains("pebble_mesh: dents = -1"));
  CHECK_THROWS_WITH(ballast_mesh<S>(0, 5, 1), doctest::Contains("ballast_mesh: radius = 0"));
  CHECK_THROWS_WITH(ballast_mesh<S>(0.01, -1, 1), doctest::Contains("ballast_mesh: lumps = -1"));
  CHECK_THROWS_WITH(star_mesh<S>([](const auto& u) { return u[0]; }),
                    doctest::Contains("star_mesh: radius"));
  CHECK(fault(tetrapod_mesh<S>(0.02, 0.006)) == "none");
  for (const double width : {0.006, 0.002})
    for (const auto& leg : detail::simplex_directions<S>()) {
      double reach = 0;
      for (const auto& x : tetrapod_mesh<S>(0.02, width, 6).vertices)
        reach = std::max(reach, x.dot(leg));
      CHECK(reach == doctest::Approx(0.02).epsilon(1e-12));
    }
  CHECK_THROWS_WITH(tetrapod_mesh<S>(0.1, 1e-4),
                    doctest::Contains("tetrapod_mesh: fineness = 4 is too low for legs so thin"));
  CHECK(fault(ballast_mesh<S>(0.02, 3, 7)) == "none");
  CHECK(volume_of(pebble_mesh<S>(1, 0, 1, 5)) ==
        doctest::Approx(S::dim == 2 ? 3.14159 : 4.18879).epsilon(1e-2));
}

TEST_CASE("faults of a mesh in space name the triangle") {
  const FacetMesh<Volume> good = cube();
  FacetMesh<Volume> mesh = good;
  mesh.facets.clear();
  CHECK(fault(mesh) == "empty: triangles = 0 must be at least 1");

  mesh = good;
  mesh.facets.resize(3);
  CHECK(fault(mesh) == "empty: triangles = 3 must be at least 4 to bound a solid");

  mesh = good;
  mesh.vertices[4][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault(mesh) == "not_finite: vertex 4 = (0, nan, 1) of triangle 2 must be finite");

  mesh = good;
  mesh.facets[5] = {0, 5, 8};
  CHECK(fault(mesh) ==
        "out_of_range: triangle 5 = (0, 5, 8) must have corners below 8, the number of vertices");

  mesh = good;
  mesh.facets[5] = {0, 5, 0};
  CHECK(fault(mesh) == "degenerate: triangle 5 = (0, 5, 0) must have different corners");

  mesh = good;
  mesh.vertices.push_back({0.5, 0.5, 0});
  mesh.facets[1] = {0, 8, 2};
  CHECK(fault(mesh) == "degenerate: triangle 1 = (0, 8, 2) must have an area that is not 0");

  mesh = good;
  mesh.facets.pop_back();
  CHECK(
      fault(mesh) ==
      "open: triangle 3 = (4, 6, 7) must have a neighbour at its edge (4, 7): the surface is open");

  mesh = good;
  mesh.vertices.push_back({2, 2, 2});
  mesh.facets.push_back({0, 1, 8});
  CHECK(fault(mesh) ==
        "non_manifold: triangle 12 = (0, 1, 8) must not share the edge (0, 1) with triangle 0 and "
        "triangle 4: the surface is not a manifold");

  mesh = good;
  std::swap(mesh.facets[3][0], mesh.facets[3][1]);
  CHECK(fault(mesh).substr(0, 10) == "unoriented");
  CHECK(fault(mesh).find("triangle 3 = (6, 4, 7)") != std::string::npos);

  mesh = good;
  append(mesh, good, {3, 0, 0});
  CHECK(fault(mesh) ==
        "several_pieces: triangle 12 = (8, 10, 9) must be connected to triangle 0: the mesh has "
        "several pieces");

  mesh = good;
  for (auto& facet : mesh.facets) std::swap(facet[0], facet[1]);
  CHECK(fault(mesh) ==
        "inside_out: volume = -1 m^3 must be positive: triangle 0 = (2, 0, 1) and all others are "
        "inside out");

  mesh = good;  // two cubes that touch at a corner
  append(mesh, good, {1, 1, 1});
  weld(mesh, 1e-9);
  CHECK(fault(mesh).substr(0, 12) == "non_manifold");
  CHECK(fault(mesh).find("only at the vertex 6") != std::string::npos);
}

TEST_CASE("unused vertices are dropped; a corner out of range is refused") {
  FacetMesh<Plane> mesh = cube(Plane{});
  mesh.vertices.insert(mesh.vertices.begin(), {5, 5});
  for (auto& facet : mesh.facets)
    for (auto& v : facet) ++v;
  CHECK(drop_unused_vertices(mesh) == 1);
  CHECK(mesh.vertices == cube(Plane{}).vertices);
  CHECK(mesh.facets == cube(Plane{}).facets);
  mesh.facets[0][1] = 5000;
  CHECK_THROWS_WITH_AS(drop_unused_vertices(mesh),
                       "drop_unused_vertices: corner = 5000 must be the index of a vertex",
                       std::invalid_argument);
}

TEST_CASE("faults of a mesh in the plane name the segment") {
  const FacetMesh<Plane> good = cube(Plane{});
  FacetMesh<Plane> mesh = good;
  mesh.facets[2] = {2, 2};
  CHECK(fault(mesh) == "degenerate: segment 2 = (2, 2) must have different corners");
  mesh = good;
  mesh.facets.pop_back();
  CHECK(fault(mesh) ==
        "open: segment 0 = (0, 1) must have a neighbour at its end (0): the surface is open");
  mesh = good;
  mesh.vertices.push_back({2, 2});
  mesh.facets.push_back({1, 4});
  CHECK(fault(mesh) ==
        "non_manifold: segment 4 = (1, 4) must not share the end (1) with segment 0 and segment 1: "
        "the surface is not a manifold");
  mesh = good;
  mesh.facets[1] = {2, 1};
  CHECK(fault(mesh).substr(0, 10) == "unoriented");
  mesh = good;
  for (auto& facet : mesh.facets) std::swap(facet[0], facet[1]);
  CHECK(fault(mesh) ==
        "inside_out: volume = -1 m^2 must be positive: segment 0 = (1, 0) and all others are "
        "inside out");
}

TEST_CASE_TEMPLATE("a surface may be open, a solid not", S, Plane, Volume) {
  FacetMesh<S> mesh = cube(S{});
  mesh.facets.pop_back();
  CHECK_NOTHROW(require_surface(mesh, "test"));
  CHECK(message_of([&] { require_solid(mesh, "test"); }).substr(0, 6) == "test: ");
}

// A grain would touch rims that lie along each other as ends of the wall.
TEST_CASE_TEMPLATE("the facets of a wall join where they meet, with their outsides on one side", S,
                   Plane, Volume) {
  const auto found = [](const FacetMesh<S>& mesh) {
    const auto fault = find_wall_fault(mesh);
    return fault ? std::string(name(fault->defect)) : "none";
  };
  FacetMesh<S> sheet = cube(S{});
  sheet.facets.pop_back();
  CHECK(found(sheet) == "none");
  CHECK(found(soup(sheet)) == "unwelded");
  FacetMesh<S> noisy = soup(sheet);
  for (std::size_t v = 0; v < noisy.vertices.size(); v += 2) noisy.vertices[v][0] += 5e-7;
  CHECK(found(noisy) == "unwelded");
  weld(noisy, 1e-6);
  CHECK(found(noisy) == "none");
  FacetMesh<S> apart;
  append(apart, sheet, typename S::Vector(S::Vector::Zero()));
  append(apart, sheet, typename S::Vector(4 * S::Vector::UnitX()));
  CHECK(found(apart) == "none");
  FacetMesh<S> turned = sheet;
  std::swap(turned.facets[1][0], turned.facets[1][1]);
  CHECK(found(turned) == "unoriented");
  FacetMesh<S> twice = sheet;
  twice.facets.push_back(twice.facets[1]);
  CHECK(found(twice) == "non_manifold");
  CHECK(message_of([&] { require_wall(twice, "test"); }).find("must not have the corners of") !=
        std::string::npos);
}

// Rims may lie along each other without ends in common.
TEST_CASE("a rim along part of another rim") {
  const auto found = [](double begin, double beside) {
    const FacetMesh<Volume> mesh{{{0, 0, 0},
                                  {2, 0, 0},
                                  {0, 1, 0},
                                  {begin, -beside, 0},
                                  {begin + 1, -beside, 0},
                                  {begin, -1, 0}},
                                 {{0, 1, 2}, {4, 3, 5}}};
    const auto fault = find_wall_fault(mesh);
    return fault ? fault->message : "none";
  };
  CHECK(found(0.5, 0) ==
        "triangle 1 = (4, 3, 5) must have vertices in common with triangle 0, along whose rim its "
        "edge (3, 4) lies: call weld(), then divide_rims()");
  CHECK(found(1.5, 0) != "none");
  CHECK(found(2, 0) == "none");  // they touch at a point
  CHECK(found(0.5, 1e-7) != "none");
  CHECK(found(0.5, 1e-4) == "none");
}

TEST_CASE_TEMPLATE("tiles of two sizes are joined", T, double, float) {
  using S = Space<3, T>;
  const auto faults = [](const FacetMesh<S>& mesh) {
    const auto fault = find_wall_fault(mesh);
    return fault ? fault->message : "none";
  };
  const auto area = [](const FacetMesh<S>& mesh) {
    T sum = 0;
    for (const auto& f : mesh.facets)
      sum += (mesh.vertices[f[1]] - mesh.vertices[f[0]])
                 .cross(mesh.vertices[f[2]] - mesh.vertices[f[0]])
                 .norm() /
             2;
    return sum;
  };
  // Two triangles beside three, whose vertex 4 lies in the middle of the edge (2, 3).
  FacetMesh<S> two{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 1, 0}, {0, 2, 0}, {1, 2, 0}},
                   {{0, 1, 2}, {0, 2, 3}, {3, 4, 5}, {4, 6, 5}, {4, 2, 6}}};
  CHECK(faults(two).find("divide_rims()") != std::string::npos);
  CHECK(divide_rims(two, T(1e-5)) == 1);
  CHECK(faults(two) == "none");
  CHECK(two.facets.size() == 6);
  CHECK(area(two) == doctest::Approx(2));
  CHECK(divide_rims(two, T(1e-5)) == 0);
  // A triangle among small ones along all of its edges, on a slope.
  constexpr std::uint32_t n = 5;
  FacetMesh<S> one{{{0, 0, 0}, {1, 0, T(0.3)}, {0, 1, T(0.2)}}, {{0, 1, 2}}};
  for (std::uint32_t edge = 0; edge < 3; ++edge) {
    const typename S::Vector begin = one.vertices[edge], end = one.vertices[(edge + 1) % 3];
    const auto out = std::uint32_t(one.vertices.size());
    one.vertices.push_back(T(0.7) * (begin + end) - T(0.4) * one.vertices[(edge + 2) % 3]);
    std::uint32_t last = edge;
    for (std::uint32_t k = 1; k <= n; ++k) {
      const auto next = k == n ? (edge + 1) % 3 : std::uint32_t(one.vertices.size());
      if (k < n) one.vertices.push_back(begin + T(k) / n * (end - begin));
      one.facets.push_back({next, last, out});
      last = next;
    }
  }
  const T before = area(one);
  CHECK(faults(one) != "none");
  CHECK(divide_rims(one, T(1e-5)) == 3 * (n - 1));
  CHECK(faults(one) == "none");
  CHECK(area(one) == doctest::Approx(before).epsilon(1e-5));
  CHECK_THROWS_AS(divide_rims(one, T(0)), std::invalid_argument);
}

TEST_CASE_TEMPLATE("the size of a mesh does not depend on the origin", S, Plane, Volume) {
  for (const double far : {0.0, 1e4, 1e6}) {
    FacetMesh<S> mesh;
    append(mesh, cube(S{}), typename S::Vector(S::Vector::Constant(far)));
    CHECK(size_of(mesh) == doctest::Approx(1).epsilon(1e-9));
    CHECK_NOTHROW(convex_of_mesh(mesh));
    // A dent of a thousandth is seen wherever it is.
    auto& corner = mesh.vertices[mesh.facets[0][0]];
    const typename S::Vector other = mesh.vertices[mesh.facets[0][1]];
    mesh.vertices.push_back((corner + other) / 2);
    mesh.vertices.back()[S::dim - 1] += 1e-3;
    CHECK(worst_concavity(mesh, hull_of_mesh(mesh)).depth < 1e-8);  // no facet has it yet
    const auto middle = std::uint32_t(mesh.vertices.size() - 1);
    if constexpr (S::dim == 2) {
      mesh.facets[0] = {0, middle};
      mesh.facets.push_back({middle, 1});
      CHECK(message_of([&] { convex_of_mesh(mesh); }).find("concavity = 0.001") !=
            std::string::npos);
    }
  }
}

TEST_CASE_TEMPLATE("a vertex without a facet sets no tolerance", S, Plane, Volume, Flat, Solid) {
  FacetMesh<S> mesh;
  for (const auto& x : cube(Space<S::dim>{}).vertices)
    mesh.vertices.push_back(x.template cast<typename S::Scalar>());
  for (const auto& facet : cube(Space<S::dim>{}).facets) mesh.facets.push_back(facet);
  const auto size = size_of(mesh), rounding = detail::rounding_of(mesh);
  mesh.vertices.push_back(S::Vector::Constant(1e4));  // a marker, as files have it
  CHECK(size_of(mesh) == size);
  CHECK(detail::rounding_of(mesh) == rounding);
  mesh.facets.clear();
  CHECK(size_of(mesh) > 9e3);
}

TEST_CASE_TEMPLATE("weld joins what lies within the tolerance", S, Plane, Volume) {
  FacetMesh<S> mesh = soup(cube(S{}));
  CHECK(fault(mesh).substr(0, 5) == "open:");
  for (std::size_t v = 0; v < mesh.vertices.size(); v += 2) mesh.vertices[v][0] += 1e-5;
  FacetMesh<S> tight = mesh;
  weld(tight, 1e-6);
  CHECK(fault(tight).substr(0, 5) == "open:");
  const WeldReport report = weld(mesh, 1e-4);
  CHECK(report.merged_vertices + (std::size_t(1) << S::dim) ==
        cube(S{}).facets.size() * std::size_t(S::dim));
  CHECK(report.removed_facets == 0);
  CHECK(fault(mesh) == "none");
  FacetMesh<S> coarse = cube(S{});
  CHECK(weld(coarse, 1.0).removed_facets > 0);
  CHECK(message_of([&] { weld(mesh, -1.0); }) == "weld: tolerance = -1 must be finite and >= 0");
}

TEST_CASE_TEMPLATE("orient turns facets, and pieces inside out", S, Plane, Volume) {
  FacetMesh<S> mesh = cube(S{});
  append(mesh, cube(S{}), typename S::Vector(3 * S::Vector::UnitX()));
  const FacetMesh<S> good = mesh;
  for (std::size_t f : {std::size_t(1), std::size_t(2)})
    std::swap(mesh.facets[f][0], mesh.facets[f][1]);
  for (std::size_t f = good.facets.size() / 2; f < good.facets.size(); ++f)
    std::swap(mesh.facets[f][0], mesh.facets[f][1]);
  CHECK(orient(mesh) == 2 + good.facets.size() / 2);
  for (std::size_t f = 0; f < good.facets.size(); ++f)
    CHECK(area_vector(corners_of(mesh, f)).dot(area_vector(corners_of(good, f))) > 0);
  const auto pieces = pieces_of(mesh);
  REQUIRE(pieces.size() == 2);
  for (const auto& piece : pieces) CHECK(fault(piece) == "none");
}

TEST_CASE("a Moebius strip can not be oriented") {
  FacetMesh<Volume> strip;
  constexpr int count = 8;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * 3.14159265358979 * k / count, tilt = angle / 2;
    for (const double side : {-0.3, 0.3})
      strip.vertices.push_back({(1 + side * std::cos(tilt)) * std::cos(angle),
                                (1 + side * std::cos(tilt)) * std::sin(angle),
                                side * std::sin(tilt)});
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::uint32_t a = 2 * k, b = a + 1;
    const std::uint32_t c = k + 1 < count ? a + 2 : 1, d = k + 1 < count ? b + 2 : 0;
    strip.facets.push_back({a, c, d});
    strip.facets.push_back({a, d, b});
  }
  CHECK(message_of([&] { orient(strip); }).find("must have two sides") != std::string::npos);
}

TEST_CASE("repeated facets are dropped on request") {
  FacetMesh<Volume> mesh = cube();
  mesh.facets.push_back({1, 0, 2});
  CHECK(fault(mesh).substr(0, 12) == "non_manifold");
  CHECK(drop_repeated_facets(mesh) == 1);
  CHECK(fault(mesh) == "none");
}

TEST_CASE_TEMPLATE("a concave mesh is refused with its depth, its hull is given by name", S, Plane,
                   Volume) {
  FacetMesh<S> mesh = cube(S{});
  // A dent: the first facet is divided at a point that is moved inwards by 0.2.
  const typename S::Matrix corners = corners_of(mesh, 0);
  const typename S::Vector out = area_vector(corners).normalized();
  const auto dent = std::uint32_t(mesh.vertices.size());
  mesh.vertices.push_back(corners.rowwise().mean() - 0.2 * out);
  const auto first = mesh.facets[0];
  for (std::size_t k = 0; k < first.size(); ++k) {
    auto part = first;
    part[k] = dent;
    if (k == 0)
      mesh.facets[0] = part;
    else
      mesh.facets.push_back(part);
  }
  REQUIRE(fault(mesh) == "none");
  const std::string message = message_of([&] { convex_of_mesh(mesh); });
  CHECK(message.substr(0, 35) == "convex_of_mesh: concavity = 0.2 m a");
  CHECK(message.find("call hull_of_mesh()") != std::string::npos);
  const auto hull = hull_of_mesh(mesh);
  CHECK(hull.volume() == doctest::Approx(1));
  CHECK(worst_concavity(mesh, hull).depth == doctest::Approx(0.2));
}

TEST_CASE("a convex mesh whose corners lie on the hull may still be concave") {
  FacetMesh<Volume> mesh = cube();
  mesh.vertices[6] = {1, 1, 0.7};  // the top is not plane: one diagonal is convex, one concave
  const std::string first = message_of([&] { convex_of_mesh(mesh); });
  mesh.facets[2] = {4, 5, 7};
  mesh.facets[3] = {5, 6, 7};
  const std::string second = message_of([&] { convex_of_mesh(mesh); });
  CHECK((first == "nothing thrown") != (second == "nothing thrown"));
}

TEST_CASE_TEMPLATE("a hull with fewer vertices loses the least volume", S, Plane, Volume) {
  const auto hull = hull_of_mesh(pebble_mesh<S>(0.02, 0, 1, 3));
  double last = 0;
  for (const std::size_t n : {std::size_t(48), std::size_t(24), std::size_t(S::dim + 1)}) {
    const auto fewer = simplify_hull(hull, n);
    CHECK(fewer.shape.vertex_count() == n);
    CHECK(fewer.volume_error == doctest::Approx(1 - fewer.shape.volume() / hull.volume()));
    CHECK(fewer.volume_error > last);
    last = fewer.volume_error;
  }
  CHECK(simplify_hull(hull, 24).volume_error < 0.4);
  const auto same = simplify_hull(hull, 100000);
  CHECK(same.volume_error == 0);
  CHECK(same.shape.vertex_count() == hull.vertex_count());
  CHECK(message_of([&] { simplify_hull(hull, 2); }).substr(0, 17) == "simplify_hull: n ");
}

TEST_CASE("a corner that is nearly flat is removed first") {
  std::vector<Volume::Vector> points;
  for (const auto& x : cube().vertices) points.push_back(x);
  points.push_back({0.5, 0.5, 1.01});
  const auto fewer = simplify_hull(Polyhedron<>(points), 8);
  CHECK(fewer.shape.volume() == doctest::Approx(1));
  CHECK(fewer.volume_error == doctest::Approx(0.01 / 3).epsilon(0.02));
}

TEST_CASE_TEMPLATE("vertices along a straight crest are no tips, in either precision", T, double,
                   float) {
  using S = Space<3, T>;
  using V = typename S::Vector;
  constexpr int pieces = 12;
  int tips = 0;
  for (int k = 0; k < 20; ++k) {
    const auto turn = S::exp({T(0.3) * T(k), T(0.7) - T(0.2) * T(k), T(0.1)});
    const auto at = [&](T along, T aside, T height) { return turn * V(along, aside, height); };
    FacetMesh<S> roof;
    for (int i = 0; i <= pieces; ++i) {
      const T along = T(i) / pieces;
      for (const V& x : {at(along, -1, -1), at(along, 0, 0), at(along, 1, -1)})
        roof.vertices.push_back(x);
    }
    for (std::uint32_t i = 0; i < pieces; ++i)
      for (const std::uint32_t side : {0U, 1U}) {
        const std::uint32_t a = 3 * i + side, b = a + 1;
        roof.facets.push_back({a, a + 3, b});
        roof.facets.push_back({b, a + 3, b + 3});
      }
    const MeshWall<S> wall(roof);
    for (std::uint32_t i = 1; i < pieces; ++i) tips += wall.is_tip(3 * i + 1);
  }
  CHECK(tips == 0);
}
