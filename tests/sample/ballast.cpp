// SPDX-License-Identifier: MIT
#include "moreau/sample/ballast.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <doctest/doctest.h>
#include <numbers>
#include <set>

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using moreau::ballast_shapes;
using moreau::Polygon;
using moreau::Polyhedron;

/// A shape defined by a user.
struct Pebble {
  int number = 0;
};

}  // namespace

template <>
struct moreau::Ballast<Pebble> {
  static Pebble draw(std::mt19937_64& random) { return {static_cast<int>(random() % 100)}; }
};

namespace {

TEST_CASE_TEMPLATE("polyhedra: 8 to 37 vertices, 12 to 70 triangles, circumradius 1", T,
                   MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(1);
  const auto shapes = ballast_shapes<Polyhedron<T>>(60, random);
  REQUIRE(shapes.size() == 60);
  std::set<std::size_t> counts;
  std::set<T> volumes;
  double filled = 0, roundness = 0;
  for (const auto& shape : shapes) {
    counts.insert(shape.vertex_count());
    volumes.insert(shape.volume());
    REQUIRE(shape.vertex_count() >= 8);
    REQUIRE(shape.vertex_count() <= 37);
    REQUIRE(shape.face_count() == 2 * shape.vertex_count() - 4);
    REQUIRE(shape.circumradius() == doctest::Approx(1).epsilon(1e-6));
    REQUIRE(shape.inradius() > 0.349);
    // The ellipsoid with the same inertia has the semi-axes a_i^2 = 5 (tr I / 2 - I_i) / m.
    const Eigen::Matrix3d inertia = shape.mass_properties(1).inertia.template cast<double>();
    const Eigen::Vector3d moments =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
    const Eigen::Vector3d axes = (moments.sum() / 2 - moments.array()).sqrt();
    const double elongation = axes[1] / axes[0], flatness = axes[2] / axes[1];
    REQUIRE(std::min(elongation, flatness) > 0.5);
    roundness += elongation * flatness / 60;
    filled += static_cast<double>(shape.volume()) / (4 * std::numbers::pi / 3) / 60;
  }
  CHECK(volumes.size() == 60);
  CHECK(counts.size() > 15);
  CHECK(*counts.begin() <= 10);
  CHECK(*counts.rbegin() >= 35);
  CHECK(filled > 0.3);
  CHECK(filled < 0.45);
  CHECK(roundness > 0.6);
  CHECK(roundness < 0.8);
}

TEST_CASE_TEMPLATE("polygons: 5 to 7 sides, circumradius 1", T, MOREAU_TYPES((double), (float))) {
  std::mt19937_64 random(2);
  std::set<std::size_t> counts;
  std::set<T> areas;
  for (const auto& shape : ballast_shapes<Polygon<T>>(60, random)) {
    counts.insert(shape.vertex_count());
    areas.insert(shape.area());
    REQUIRE(shape.circumradius() == doctest::Approx(1).epsilon(1e-6));
    REQUIRE(shape.inradius() > 0.349);
  }
  CHECK(counts == std::set<std::size_t>{5, 6, 7});
  CHECK(areas.size() == 60);
}

TEST_CASE("spheres and disks have radius 1") {
  std::mt19937_64 random(3);
  for (const auto& ball : ballast_shapes<moreau::Ball<>>(5, random)) CHECK(ball.radius() == 1);
  for (const auto& disk : ballast_shapes<moreau::Disk<float>>(5, random)) CHECK(disk.radius() == 1);
}

TEST_CASE("a shape of one's own joins by specialisation") {
  static_assert(moreau::BallastShape<Pebble>);
  static_assert(!moreau::BallastShape<int>);
  std::mt19937_64 random(4);
  CHECK(ballast_shapes<Pebble>(7, random).size() == 7);
}

TEST_CASE("the seed decides") {
  std::mt19937_64 a(5), b(5), c(6);
  const auto first = ballast_shapes<Polyhedron<>>(3, a),
             second = ballast_shapes<Polyhedron<>>(3, b),
             third = ballast_shapes<Polyhedron<>>(3, c);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(first[i].vertices() == second[i].vertices());
    CHECK(first[i].volume() != third[i].volume());
  }
}

TEST_CASE("no shapes are an error") {
  std::mt19937_64 random;
  CHECK(message_of([&] { ballast_shapes<Polyhedron<>>(0, random); }) ==
        "ballast_shapes: count = 0 must be at least 1");
}

}  // namespace
