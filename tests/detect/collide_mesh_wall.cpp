// SPDX-License-Identifier: MIT
// Contacts of shapes with mesh walls, against the narrow phase of convex shapes: a wall that is the
// surface of a convex body must have the same distance as the body.
#include "moreau/detect/pairs/collide_mesh_wall.hpp"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/sample/concave_mesh.hpp"
#include "moreau/sample/random_rotation.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/convex_of_mesh.hpp"
#include "moreau/shape/regular_shape.hpp"

#include "conformance/random_direction.hpp"
#include "types.hpp"

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
      collide_each(placed, wall, margin, near, scratch, manifold, [&](std::uint32_t) {
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
