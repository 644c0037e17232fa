// SPDX-License-Identifier: MIT
#include "moreau/shape/cylinder.hpp"

#include <doctest/doctest.h>
#include <numbers>
#include <random>

#include "moreau/detect/collide.hpp"
#include "moreau/sample/random_rotation.hpp"

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using namespace moreau;
using S = Space<3>;
using Vector = S::Vector;

static_assert(ConvexShape<Cylinder<>> && ConvexShape<Cylinder<float>> && GrainShape<Cylinder<>>);

TEST_CASE_TEMPLATE("a cylinder in closed form", T, MOREAU_TYPES((double), (float))) {
  const Cylinder<T> cylinder(T(1.5), T(0.5));
  const auto mass = cylinder.mass_properties(2);
  const double volume = std::numbers::pi * 0.25 * 3;
  CHECK(cylinder.volume() == doctest::Approx(volume).epsilon(1e-6));
  CHECK(mass.mass == doctest::Approx(2 * volume).epsilon(1e-6));
  CHECK(mass.center.norm() == 0);
  CHECK(mass.inertia(0, 0) == doctest::Approx(2 * volume * 0.25 / 2).epsilon(1e-6));
  CHECK(mass.inertia(1, 1) == doctest::Approx(2 * volume * (3 * 0.25 + 9) / 12).epsilon(1e-6));
  CHECK(mass.inertia(2, 2) == mass.inertia(1, 1));
  CHECK(mass.inertia(0, 1) == 0);
  CHECK(cylinder.circumradius() == doctest::Approx(std::sqrt(2.5)).epsilon(1e-6));
  CHECK(cylinder.inradius() == T(0.5));
  CHECK(cylinder.scaled(2).half_length() == 3);
  CHECK(cylinder.scaled(2).radius() == 1);
}

TEST_CASE("support and box of a cylinder are those of its surface") {
  const Cylinder<> cylinder(0.7, 0.4);
  std::mt19937_64 random(1);
  for (int k = 0; k < 20; ++k) {
    const Pose<S> pose{{1, 2, 3}, random_rotation<S>(random)};
    const Vector direction = random_rotation<S>(random) * Vector(Vector::UnitX());
    double most = -10;
    Vector upper = Vector::Constant(-10);
    for (int i = 0; i < 2000; ++i) {
      const double angle = 2 * std::numbers::pi * i / 1000;
      const Vector rim(i % 2 ? 0.7 : -0.7, 0.4 * std::cos(angle), 0.4 * std::sin(angle));
      most = std::max(most, rim.dot(direction));
      upper = upper.cwiseMax(pose.position + pose.rotation * rim);
    }
    CHECK(cylinder.support(direction).dot(direction) == doctest::Approx(most).epsilon(1e-4));
    const Aabb<S> box = cylinder.bounding_box(pose);
    CHECK((box.upper - upper).norm() < 1e-4);
    CHECK((box.lower + box.upper - 2 * pose.position).norm() < 1e-12);
  }
  CHECK(cylinder.support({1, 0, 0}) == Vector(0.7, 0, 0));
}

TEST_CASE("contacts of cylinders") {
  const Cylinder<> cylinder(0.7, 0.4);
  // Side by side.
  const Placed<Cylinder<>> a(cylinder), b(cylinder, {{0.1, 0.9, 0}});
  const auto found = distance(a, b);
  CHECK(found.gap == doctest::Approx(0.1).epsilon(1e-9));
  CHECK((found.normal - Vector(0, 1, 0)).norm() < 1e-6);
  // End to end.
  const Placed<Cylinder<>> c(cylinder, {{1.3, 0.1, 0}});
  CHECK(distance(a, c).gap == doctest::Approx(-0.1).epsilon(1e-6));
  // On a floor: standing, it has several points that surround its axis; lying, both ends.
  const HalfSpace<S> half({0, 0, 1});
  const Placed<HalfSpace<S>> floor(half);
  const S::Rotation upright(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitY()));
  const Placed<Cylinder<>> standing(cylinder, {{0, 0, 0.699}, upright}),
      lying(cylinder, {{0, 0, 0.399}});
  Manifold<S> manifold;
  for (const auto* placed : {&standing, &lying}) {
    REQUIRE(collide(*placed, floor, 0.01, manifold));
    Vector lower = Vector::Constant(10), upper = -lower;
    for (const auto& point : manifold.points) {
      CHECK(point.gap == doctest::Approx(-0.001).epsilon(1e-3));
      lower = lower.cwiseMin(point.position);
      upper = upper.cwiseMax(point.position);
    }
    CHECK(manifold.points.size() >= 2);
    if (placed == &standing)
      CHECK((lower.x() < -0.1 && upper.x() > 0.1 && lower.y() < -0.1 && upper.y() > 0.1));
    else
      CHECK((lower.x() < -0.69 && upper.x() > 0.69));
  }
}

TEST_CASE_TEMPLATE("a lying cylinder touches a floor along its lowest line", T,
                   MOREAU_TYPES((double), (float))) {
  using S3 = Space<3, T>;
  using V3 = typename S3::Vector;
  const HalfSpace<S3> half({0, 0, 1});
  const Placed<HalfSpace<S3>> floor(half);
  for (const T half_length : {T(0.002), T(0.05), T(0.3)})
    for (int k = 0; k < 40; ++k) {
      const Cylinder<T> cylinder(half_length, T(0.05));
      const T turned = T(0.17 * k);
      const Pose<S3> pose{V3(0, 0, T(0.05)),
                          S3::exp(V3(0, 0, turned)) * S3::exp(V3(T(0.31 * k), 0, 0))};
      Manifold<S3> manifold;
      REQUIRE(collide(Placed<Cylinder<T>>(cylinder, pose), floor, T(1e-3), manifold));
      CHECK(manifold.points.size() == 2);
      const V3 across(-std::sin(turned), std::cos(turned), 0);
      for (const auto& point : manifold.points)
        CHECK(std::abs(point.position.dot(across)) < (std::same_as<T, float> ? T(1e-6) : T(1e-9)));
    }
}

TEST_CASE("cylinders that are refused") {
  CHECK(message_of([] { Cylinder<>(0, 1); }) == "Cylinder: half_length = 0 must be finite and > 0");
  CHECK(message_of([] { Cylinder<>(1, -1); }) == "Cylinder: radius = -1 must be finite and > 0");
}

}  // namespace
