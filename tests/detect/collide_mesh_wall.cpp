// SPDX-License-Identifier: MIT
// Contacts of shapes with mesh walls, against the narrow phase of convex shapes: a wall that is the
// surface of a convex body must have the same distance as the body.
#include "moreau/detect/pairs/collide_mesh_wall.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/mesh/convex_of_mesh.hpp"
#include "moreau/sample/concave_mesh.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/regular_shape.hpp"

#include "conformance/random_direction.hpp"
#include "types.hpp"
#include "world/mesh_floor.hpp"

namespace {

using namespace moreau;
using Plane = Space<2, double>;
using Volume = Space<3, double>;

/// A contact point with its normal, which points into the wall.
template <class S>
struct Point {
  ManifoldPoint<S> at;
  typename S::Vector normal;
};

template <class ShapeT>
std::vector<Point<SpaceOf<ShapeT>>> points_of(const Placed<ShapeT>& shape,
                                              const MeshWall<SpaceOf<ShapeT>>& wall,
                                              double margin) {
  using S = SpaceOf<ShapeT>;
  std::vector<Point<S>> points;
  Manifold<S> manifold;
  MeshScratch scratch;
  const auto add = [&](std::uint32_t) {
    for (const auto& point : manifold.points) points.push_back({point, manifold.normal});
  };
  const bool touch = collide_each(shape, wall, margin, scratch, manifold, add);
  CHECK(touch == !points.empty());
  return points;
}

template <class S>
double least_gap(const std::vector<Point<S>>& points) {
  double gap = std::numeric_limits<double>::infinity();
  for (const auto& point : points) gap = std::min(gap, point.at.gap);
  return gap;
}

/// Random directions.
template <class S>
std::vector<typename S::Vector> directions(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<typename S::Vector> points;
  for (int k = 0; k < count; ++k) points.push_back(conformance::random_direction<S>(random));
  return points;
}

/// A random convex body as a mesh: the surface of the hull of a pebble, divided into facets.
FacetMesh<Volume> convex_mesh(Volume, std::uint64_t seed) {
  const Polyhedron<> hull(directions<Volume>(12, seed));
  FacetMesh<Volume> mesh;
  for (Eigen::Index i = 0; i < hull.vertices().rows(); ++i)
    mesh.vertices.push_back(hull.vertices().row(i).transpose());
  for (std::size_t f = 0; f < hull.face_count(); ++f)
    for (std::size_t k = 2; k < hull.face(f).size(); ++k)
      mesh.facets.push_back({hull.face(f)[0], hull.face(f)[k - 1], hull.face(f)[k]});
  return mesh;
}
FacetMesh<Plane> convex_mesh(Plane, std::uint64_t seed) {
  const Polygon<> hull(directions<Plane>(8, seed));
  FacetMesh<Plane> mesh;
  const auto count = std::uint32_t(hull.vertex_count());
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.vertices.push_back(hull.vertices().row(i).transpose());
    mesh.facets.push_back({i, (i + 1) % count});
  }
  return mesh;
}

/// A floor of n x n squares of two triangles each; place(x, y) gives the vertex of x, y in [0, 1].
template <class S, class Place>
FacetMesh<S> squares(int n, const Place& place) {
  FacetMesh<S> mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.vertices.push_back(place(double(i) / n, double(j) / n));
  mesh_floor::add_squares(mesh, n);
  return mesh;
}

/// A roof with its ridge along y from 0 to 3, divided at 1 and 2, and with slopes of the width 1.
template <class S>
FacetMesh<S> roof(typename S::Scalar slope) {
  FacetMesh<S> mesh;
  for (int j = 0; j <= 3; ++j)
    for (int i = -1; i <= 1; ++i) {
      const auto x = static_cast<typename S::Scalar>(i), y = static_cast<typename S::Scalar>(j);
      mesh.vertices.push_back({x, y, -slope * std::abs(x)});
    }
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i < 2; ++i) {
      const std::uint32_t at = 3 * j + i;
      mesh.facets.push_back({at, at + 1, at + 4});
      mesh.facets.push_back({at, at + 4, at + 3});
    }
  return mesh;
}

/// The distance of a point from the nearest facet; it is less than 0.06.
template <class S>
double facet_distance(const MeshWall<S>& wall, const typename S::Vector& x) {
  double least = std::numeric_limits<double>::infinity();
  Aabb<S> around;
  around.merge(x);
  around = around.inflated(0.06);
  wall.tree().query([&](const Aabb<S>& box) { return box.overlaps(around); },
                    [&](std::uint32_t k) {
                      const typename S::Matrix corners = wall.side(k).corners.colwise() - x;
                      least = std::min(least, double(detail::nearest_on_facet(corners).norm()));
                    });
  return least;
}
/// A place above x, in direction `up`, at a distance from the wall.
template <class S>
typename S::Vector above(const MeshWall<S>& wall, const typename S::Vector& x,
                         const typename S::Vector& up, double distance) {
  double low = 0, high = 2 * distance;
  for (int k = 0; k < 40; ++k) {
    const double middle = (low + high) / 2;
    (facet_distance(wall, x + middle * up) < distance ? low : high) = middle;
  }
  return x + high * up;
}

/// The contacts of a ball of radius 0.05 with its centre at a place.
template <class S>
auto points_of_ball(const MeshWall<S>& wall, const typename S::Vector& at) {
  const BallIn<S> ball(0.05);
  return points_of(Placed<BallIn<S>>(ball, {at, S::identity()}), wall, 1e-3);
}

template <class ShapeT>
ShapeT grain(double size);
template <>
[[maybe_unused]] Polyhedron<> grain(double size) {
  return cuboid<Polyhedron<>>({size, 0.8 * size, 0.6 * size});
}
template <>
[[maybe_unused]] Polygon<> grain(double size) {
  return cuboid<Polygon<>>({size, 0.6 * size});
}
template <>
[[maybe_unused]] Ball<> grain(double size) {
  return Ball<>(size);
}
template <>
[[maybe_unused]] Disk<> grain(double size) {
  return Disk<>(size);
}
template <>
[[maybe_unused]] Capsule<> grain(double size) {
  return Capsule<>(size, size / 2);
}
template <>
[[maybe_unused]] Rounded<Polyhedron<>> grain(double size) {
  return Rounded<Polyhedron<>>(grain<Polyhedron<>>(size), size / 4);
}

}  // namespace

TEST_CASE_TEMPLATE("the surface of a convex body has the distance of the body", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Disk<>),
                                (Polygon<>, Ball<>, Capsule<>, Rounded<Polyhedron<>>))) {
  using S = SpaceOf<ShapeT>;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  int apart = 0, touching = 0, missed = 0;
  for (int body = 0; body < 10; ++body) {
    const FacetMesh<S> mesh = convex_mesh(S{}, std::uint64_t(body));
    const MeshWall<S> wall(mesh);
    const auto hull = convex_of_mesh(mesh);
    const Placed<PolytopeOf<S>> placed(hull, {hull.centroid_of_input(), S::identity()});
    for (int trial = 0; trial < 1000; ++trial) {
      const ShapeT shape = grain<ShapeT>(0.1 + 0.6 * uniform(random));
      typename S::Vector direction;
      for (auto& x : direction) x = normal(random);
      const typename S::Vector at = direction.normalized() * (0.9 + 1.2 * uniform(random));
      const Placed<ShapeT> grain(shape, {at, random_rotation<S>(random)});
      const auto exact = distance(grain, placed);
      const double margin = 0.3;
      const auto points = points_of(grain, wall, margin);
      CAPTURE(body);
      CAPTURE(trial);
      if (exact.gap > margin) {
        CHECK(least_gap(points) > margin);
      } else if (exact.gap > 1e-9) {
        ++apart;
        CHECK(least_gap(points) == doctest::Approx(exact.gap).epsilon(1e-6));
        // The nearest point has the normal and the place of the exact contact.
        const auto nearest =
            std::min_element(points.begin(), points.end(),
                             [](const auto& p, const auto& q) { return p.at.gap < q.at.gap; });
        CHECK((nearest->normal - exact.normal).norm() < 1e-5);
      } else if (exact.gap > -0.02) {
        ++touching;
        missed += !(least_gap(points) < 0);
        // No direction out of a shallow overlap is shorter than that of its contact.
        if (exact.gap > -0.005)
          CHECK(least_gap(points) == doctest::Approx(exact.gap).epsilon(0.5).scale(0.01));
      }
    }
  }
  CHECK(apart > 200);
  CHECK(missed <= 2);  // of those deeper than 0.005
  MESSAGE(apart << " apart, " << touching << " overlap by at most 0.02, missed " << missed);
}

// A grain that wanders over the surface of a concave body: the facets that are known from earlier steps
// give the same bits as a search among all.
TEST_CASE_TEMPLATE("facets that are known from earlier steps give the same contacts", ShapeT,
                   MOREAU_TYPES((Polyhedron<>, Capsule<>), (Ball<>, Rounded<Polyhedron<>>))) {
  using S = SpaceOf<ShapeT>;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    const MeshWall<S> wall(pebble_mesh<S>(1, 5, 2), sides);
    const ShapeT shape = grain<ShapeT>(0.3);
    const double margin = 0.02;
    MeshNeighbours<S> near;
    MeshScratch scratch;
    Manifold<S> manifold;
    Pose<S> pose({0, 0, 1.2}, S::identity());
    std::size_t points = 0;
    for (int k = 0; k < 2000; ++k) {
      for (double& x : pose.position) x += 0.01 * normal(random);
      pose.position *= 1 + 0.1 * (1.1 - pose.position.norm());
      pose.rotation = S::exp({0.1 * normal(random), 0, 0.1}) * pose.rotation;
      const Placed<ShapeT> placed(shape, pose);
      const auto expected = points_of(placed, wall, margin);
      near.update(wall, placed.bounding_box().inflated(margin));
      std::size_t at = 0;
      bool same = true;
      collide_each(placed, wall, margin, margin, near, scratch, manifold, [&](std::uint32_t) {
        for (const auto& point : manifold.points) {
          same = same && at < expected.size() && point.gap == expected[at].at.gap &&
                 point.position == expected[at].at.position &&
                 point.feature == expected[at].at.feature && manifold.normal == expected[at].normal;
          ++at;
        }
      });
      CHECK(same);
      CHECK(at == expected.size());
      points += at;
    }
    CHECK(points > 500);
  }
}

// A grain keeps facets that were near it in earlier steps: those that its box has left change nothing.
TEST_CASE_TEMPLATE("facets outside of the box of the grain change no contact", ShapeT,
                   MOREAU_TYPES((Capsule<>), (Stadium<>))) {
  using S = SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  // The right end of a thin capsule touches a floor. A ceiling below the middle of the capsule is nearer to the
  // centre than the floor, but outside of the box.
  const auto strip = [](double x, double y, double z) {
    Vector at = y * Vector::Unit(1);
    at[0] = x;
    at[S::dim - 1] = z;
    return at;
  };
  FacetMesh<S> mesh;
  const auto add = [&](double from, double to, double z, bool up) {
    const auto first = std::uint32_t(mesh.vertices.size());
    if constexpr (S::dim == 3) {
      for (const double x : {from, to})
        for (const double y : {-0.05, 0.05}) mesh.vertices.push_back(strip(x, y, z));
      const std::uint32_t a = first, b = first + 1, c = first + 2, d = first + 3;
      mesh.facets.insert(mesh.facets.end(), {{a, c, d}, {a, d, b}});
    } else {
      for (const double x : {to, from}) mesh.vertices.push_back(strip(x, 0, z));
      mesh.facets.push_back({first, first + 1});
    }
    if (!up)
      for (auto f = mesh.facets.end() - (S::dim - 1); f != mesh.facets.end(); ++f)
        std::swap((*f)[0], (*f)[1]);
  };
  add(0.008, 0.03, -5e-4, true);
  add(-0.03, 0.006, -0.002, false);
  const MeshWall<S> wall(mesh);
  const ShapeT shape(0.01, 6e-4);
  const double margin = 1e-4;
  const Placed<ShapeT> placed(shape, {Vector::Zero(), S::identity()});
  MeshNeighbours<S> near;
  near.update(wall, placed.bounding_box().inflated(0.1));
  MeshScratch scratch;
  Manifold<S> manifold;
  int points = 0;
  const auto add_points = [&](std::uint32_t) {
    for (const auto& point : manifold.points) {
      ++points;
      CHECK(point.gap == doctest::Approx(-1e-4));
      CHECK(manifold.normal[S::dim - 1] == doctest::Approx(-1));
    }
  };
  collide_each(placed, wall, margin, scratch, manifold, add_points);
  CHECK(points == 2);  // the end of the capsule, and the rim of the floor
  collide_each(placed, wall, margin, margin, near, scratch, manifold, add_points);
  CHECK(points == 4);
}

// Files hold coordinates in single precision: the corners of a plane floor lie off its plane by more than the
// rounding of the grain.
TEST_CASE("a large floor with rounded coordinates holds grains everywhere") {
  using S = Volume;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  constexpr int n = 20;
  for (const double size : {40.0, 1000.0}) {
    FacetMesh<S> mesh;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.vertices.push_back({size * i / n, size * j / n, 1e-8 * size * uniform(random)});
    const auto at = [&](int i, int j) { return std::uint32_t(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    const MeshWall<S> wall(mesh);
    const Ball<> ball(0.5);
    int missed = 0;
    for (int trial = 0; trial < 1000; ++trial) {
      const double x = size * (0.5 + 0.45 * uniform(random)),
                   y = size * (0.5 + 0.45 * uniform(random));
      missed += points_of(Placed<Ball<>>(ball, {{x, y, 0.499}, S::identity()}), wall, 0.01).empty();
    }
    CAPTURE(size);
    CHECK(missed == 0);
  }
}

// Between the normals of two segments a disk touches their common end, however small their angle is.
TEST_CASE("a disk on a finely divided crest has one contact everywhere") {
  using S = Plane;
  constexpr double overlap = 5e-6;
  for (const int n : {200, 2000, 5000}) {
    FacetMesh<S> mesh;
    for (int i = 0; i <= n; ++i) {
      const double x = double(i) / n;
      mesh.vertices.push_back({x, 0.01 * std::cos(2 * std::numbers::pi * x / 0.7)});
      if (i > 0) mesh.facets.push_back({std::uint32_t(i), std::uint32_t(i - 1)});
    }
    const MeshWall<S> wall(mesh);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(0.62, 0.78);
    int missed = 0, several = 0;
    double worst = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const double x = place(random);
      const auto points = points_of_ball<S>(wall, above<S>(wall, {x, 0}, {0, 1}, 0.05 - overlap));
      missed += points.empty();
      several += points.size() > 1;
      if (!points.empty()) worst = std::max(worst, std::abs(points[0].at.gap + overlap));
    }
    CAPTURE(n);
    CHECK(missed == 0);
    CHECK(several == 0);
    CHECK(worst <= wall.flatness() + 1e-9);
  }
}

// Of a plane floor, the facets differ by the rounding of their coordinates.
TEST_CASE("a ball on a tilted floor of rounded coordinates has one contact everywhere") {
  using S = Volume;
  const double angle = std::numbers::pi / 6;
  const auto mesh = squares<S>(100, [&](double x, double y) {
    return S::Vector(float(x * std::cos(angle)), float(y), float(x * std::sin(angle)));
  });
  const MeshWall<S> wall(mesh);
  const S::Vector up(-std::sin(angle), 0, std::cos(angle));
  const auto vertex = [&](int i, int j) { return mesh.vertices[std::size_t(101 * j + i)]; };
  int missed = 0, several = 0;
  double worst = 0;
  for (int j = 20; j < 80; ++j)
    for (int i = 20; i < 80; ++i)
      for (const S::Vector& end :
           {vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)}) {
        const S::Vector x = (vertex(i, j) + end) / 2;
        const auto points = points_of_ball<S>(wall, x + 0.05 * (1 - 1e-4) * up);
        missed += points.empty();
        several += points.size() > 1;
        if (!points.empty()) worst = std::max(worst, std::abs(points[0].at.gap + 5e-6));
      }
  CHECK(missed == 0);
  CHECK(several == 0);
  CHECK(worst <= wall.flatness());
}

// Ridges with small angles, which end at tips.
TEST_CASE("a ball on a finely divided hill has a contact everywhere") {
  using S = Volume;
  const MeshWall<S> wall(squares<S>(100, [](double x, double y) {
    return S::Vector(x, y, -0.02 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)));
  }));
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  int missed = 0, several = 0;
  for (int trial = 0; trial < 200; ++trial) {
    // Over a vertex or the middle of an edge, exactly or by less than the radius times the angle.
    const int i = 30 + int(40 * uniform(random)), j = 30 + int(40 * uniform(random));
    const double x = (i + 0.5 * (trial % 2)) / 100, y = (j + 0.5 * (trial / 2 % 2)) / 100;
    const double aside = trial % 3 == 0 ? 0 : 1e-5;
    const S::Vector up = S::Vector(0.04 * (x - 0.5), 0.04 * (y - 0.5), 1).normalized();
    const S::Vector at(x + aside * (uniform(random) - 0.5), y + aside * (uniform(random) - 0.5),
                       -0.02 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)) - 1e-5);
    const auto points = points_of_ball<S>(wall, above<S>(wall, at, up, 0.05 * (1 - 1e-4)));
    missed += points.empty();
    several += points.size() > 1;
  }
  CHECK(missed == 0);
  CHECK(several == 0);
}

// Where face and ridge meet, one of them gives the contact.
TEST_CASE("a ball that moves over the edge of a table has one contact all the time") {
  using S = Volume;
  FacetMesh<S> table;
  table.vertices = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {0, 0, -1}, {0, 1, -1}};
  table.facets = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    const MeshWall<S> wall(table, sides);
    for (const double x : {-1e-3, -1e-6, -1e-9, 0.0, 5e-10, 1e-9, 1e-8, 4e-8, 5.1e-8, 1e-6, 1e-4}) {
      const auto points = points_of_ball<S>(wall, {x, 0.53, 0.05});
      CAPTURE(x);
      REQUIRE(points.size() == 1);
      const double gap = std::hypot(std::max(x, 0.0), 0.05) - 0.05;
      CHECK(std::abs(points[0].at.gap - gap) < 1e-12);
      CHECK(points[0].normal[2] < -0.99);
    }
  }
}
TEST_CASE("a disk above a corner has one contact") {
  using S = Plane;
  FacetMesh<S> table;
  table.vertices = {{-1, 0}, {0, 0}, {0, -1}};
  table.facets = {{1, 0}, {2, 1}};
  for (const WallSides sides : {WallSides::outside, WallSides::both}) {
    const MeshWall<S> wall(table, sides);
    for (const double x : {-1e-3, -1e-8, -1e-9, 0.0, 5e-10, 1e-9, 1e-8, 5.1e-8, 1e-6, 1e-3}) {
      const auto points = points_of_ball<S>(wall, {x, 0.05});
      CAPTURE(x);
      REQUIRE(points.size() == 1);
      CHECK(std::abs(points[0].at.gap - std::hypot(std::max(x, 0.0), 0.05) + 0.05) < 1e-12);
    }
  }
}

// A vertex in the middle of a straight ridge is no tip: the ridges have it.
TEST_CASE("a ball and a capsule on the ridge of a roof have one contact at each place") {
  using S = Volume;
  const MeshWall<S> wall(roof<S>(1));
  const Capsule<> capsule(0.2, 0.05);
  for (const double y : {1.0, 1 + 4e-16, 1 - 4e-16, 1 + 1e-12, 1.5}) {
    CAPTURE(y);
    const auto points = points_of_ball<S>(wall, {0, y, 0.05});
    REQUIRE(points.size() == 1);
    CHECK(std::abs(points[0].at.gap) < 1e-12);
    CHECK((points[0].normal + S::Vector::UnitZ()).norm() < 1e-9);
    // Across the ridge: its edge touches.
    const Pose<S> pose({0, y, 0.05}, S::identity());
    CHECK(points_of(Placed<Capsule<>>(capsule, pose), wall, 1e-3).size() == 1);
  }
}

TEST_CASE("walls and grains in single precision: one contact over edges and vertices") {
  using S = Space<3, float>;
  const MeshWall<S> wall(roof<S>(0.1F));
  const BallIn<S> ball(0.05F);
  MeshScratch scratch;
  Manifold<S> manifold;
  for (const float y : {1.0F, 1.3F})
    for (const float x : {0.0F, 1e-7F, 1e-6F, 1e-5F, 1e-4F, 1e-3F, 4e-3F, 6e-3F, 0.1F}) {
      // Above the slope, or above the ridge.
      const float slope = 0.1F * x;
      const float z = x > 5e-3F ? 0.05F * std::sqrt(1.01F) - slope : std::sqrt(0.0025F - x * x);
      std::size_t count = 0;
      const Placed<BallIn<S>> placed(ball, {{x, y, z}, S::identity()});
      collide_each(placed, wall, 1e-3F, scratch, manifold,
                   [&](std::uint32_t) { count += manifold.points.size(); });
      CAPTURE(x);
      CAPTURE(y);
      CHECK(count == 1);
    }
}
