// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>
#include <vector>

#include "moreau/detect/collide.hpp"

#include "detect/flush_pairs.hpp"
#include "detect/oracle.hpp"
#include "detect/shapes.hpp"

using namespace moreau;

namespace {

using S = Space<2>;
using Vector = S::Vector;
using Solid = Polygon<double>;

double height_above(const Solid& shape, const Pose<S>& pose, const Vector& x) {
  const Vector body = pose.to_body(x);
  return ((shape.face_normals() * body).array() - shape.face_offsets().array()).maxCoeff();
}

void check_against_oracle(const Solid& shape_a, const Pose<S>& pose_a, const Solid& shape_b,
                          const Pose<S>& pose_b, double margin) {
  const double size = shape_a.circumradius() + shape_b.circumradius(), tiny = 1e-12 * size;
  const auto truth = oracle::signed_gap(shape_a, pose_a, shape_b, pose_b);
  const Placed<Solid> a(shape_a, pose_a), b(shape_b, pose_b);
  const auto found = distance(a, b);
  CHECK(std::abs(found.gap - truth.gap) < tiny);
  if (std::abs(truth.gap) > tiny) CHECK(overlap(a, b) == (truth.gap <= 0));
  if (truth.is_unique) CHECK((found.normal - truth.normal).norm() < 1.7e-4);
  CHECK((found.witness_b - found.witness_a - found.gap * found.normal).norm() < tiny);
  CHECK(std::abs(height_above(shape_a, pose_a, found.witness_a)) < 10 * tiny);
  CHECK(std::abs(height_above(shape_b, pose_b, found.witness_b)) < 10 * tiny);
  Manifold<S> manifold, swapped;
  const bool touch = collide(a, b, margin, manifold);
  if (std::abs(truth.gap - margin) > tiny) CHECK(touch == (truth.gap <= margin));
  CHECK(collide(b, a, margin, swapped) == touch);
  if (!touch) return;
  REQUIRE(!manifold.points.empty());
  CHECK(manifold.points.size() <= 2);
  double deepest = 1e9;
  for (const auto& point : manifold.points) deepest = std::min(deepest, point.gap);
  CHECK(std::abs(deepest - truth.gap) < tiny);
  if (!truth.is_unique) return;
  CHECK(swapped.contact_class == manifold.contact_class);
  CHECK((swapped.normal + manifold.normal).norm() < 1e-6);
  CHECK(swapped.points.size() == manifold.points.size());
}

}  // namespace

TEST_CASE("polygons: gap, normal and points against exhaustive search") {
  std::mt19937_64 random(1);
  std::vector<Solid> shapes;
  for (int i = 0; i < 40; ++i) shapes.push_back(samples::grain(S{}, random));
  for (const Solid& shape : {samples::box(1., 1.), samples::box(1., .01), samples::box(.001, .001)})
    shapes.push_back(shape);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 4000; ++i) {
    const Solid& a = shapes[random() % shapes.size()];
    const Solid& b = shapes[random() % shapes.size()];
    Pose<S> pose_a, pose_b;
    pose_a.rotation = samples::rotation(S{}, random);
    pose_b.rotation = samples::rotation(S{}, random);
    const double size = a.circumradius() + b.circumradius();
    const Vector line = samples::direction<S>(random);
    double inside = 0, outside = size * 1.001;
    for (int k = 0; k < 55; ++k) {
      const double middle = (inside + outside) / 2;
      pose_b.position = middle * line;
      (overlap(Placed<Solid>(a, pose_a), Placed<Solid>(b, pose_b)) ? inside : outside) = middle;
    }
    const double change =
        i % 3 == 0   ? 0.01 * uniform(random)
        : i % 3 == 1 ? std::copysign(std::pow(10., 6 * uniform(random) - 8), uniform(random))
                     : 0.9 * uniform(random);
    pose_b.position *= 1 + change;
    check_against_oracle(a, pose_a, b, pose_b, 0.01 * size);
  }
}

TEST_CASE("polygons: sides and corners exactly on each other") {
  std::mt19937_64 random(2);
  const std::vector<Solid> shapes = {samples::box(1., 1.), samples::box(2., .5)};
  for (const Solid& a : shapes)
    for (const Solid& b : shapes)
      for (int k = 0; k < 200; ++k) {
        Pose<S> pose;
        for (auto& x : pose.position) x = 0.25 * (static_cast<int>(random() % 17) - 8);
        pose.rotation.angle() = std::numbers::pi / 4 * static_cast<double>(random() % 8);
        check_against_oracle(a, Pose<S>{}, b, pose, 1e-3);
      }
}

TEST_CASE("polygons: classes and keys") {
  const Solid box = samples::box(1., 1.);
  Manifold<S> manifold;
  Pose<S> above{Vector(0.25, 1.001), S::exp(S::Angular(0.))};
  REQUIRE(collide(Placed<Solid>(box), Placed<Solid>(box, above), 0.01, manifold));
  CHECK(manifold.contact_class == ContactClass::edge_edge);
  REQUIRE(manifold.points.size() == 2);
  CHECK(manifold.points[0].feature.kind() == FeatureKey::Kind::vertex_edge);
  CHECK(manifold.points[1].feature.kind() == FeatureKey::Kind::edge_vertex);
  for (const auto& point : manifold.points) {
    CHECK(point.gap == doctest::Approx(0.001).epsilon(1e-9));
    CHECK(point.position.y() == doctest::Approx(0.5005).epsilon(1e-12));
  }
  CHECK((manifold.normal - Vector(0, 1)).norm() < 1e-15);

  above = {Vector(0.25, 0.5 + std::sqrt(0.5) + 0.001), S::exp(S::Angular(std::numbers::pi / 4))};
  REQUIRE(collide(Placed<Solid>(box), Placed<Solid>(box, above), 0.01, manifold));
  CHECK(manifold.contact_class == ContactClass::vertex_edge);
  CHECK(manifold.points.size() == 1);

  above = {Vector(1.003, 1.004), S::exp(S::Angular(0.))};
  REQUIRE(collide(Placed<Solid>(box), Placed<Solid>(box, above), 0.01, manifold));
  CHECK(manifold.contact_class == ContactClass::vertex_vertex);
  REQUIRE(manifold.points.size() == 1);
  CHECK(manifold.gap == doctest::Approx(0.005).epsilon(1e-12));
  CHECK((manifold.normal - Vector(0.6, 0.8)).norm() < 1e-12);
}

TEST_CASE_TEMPLATE("polygons: flush to within roundings, no point is deeper than the pair", T,
                   double, float) {
  flush::check_pairs<T, 2>(4000, 4);
}

TEST_CASE("polygons: two stones of an arch at rest, in float") {
  // The ends of the joint are farther apart than its sides, by more than the search leaves in doubt.
  using Plane = Space<2, float>;
  std::vector<Polygon<float>> shapes;
  for (const int k : {16, 17}) {
    std::vector<Plane::Vector> corners;
    for (const int side : {k, k + 1})
      for (const double radius : {0.9375, 1.0625}) {
        const double angle = std::numbers::pi * side / 27;
        corners.emplace_back(float(radius * std::cos(angle)), float(radius * std::sin(angle)));
      }
    shapes.emplace_back(std::span<const Plane::Vector>(corners));
  }
  const Pose<Plane> first{{-0.341885835F, 0.939323485F}, Eigen::Rotation2Df(-3.14187637e-05F)};
  const Pose<Plane> second{{-0.44862321F, 0.893281996F}, Eigen::Rotation2Df(-3.14485005e-05F)};
  const Placed a(shapes[0], first), b(shapes[1], second);
  Manifold<Plane> manifold;
  REQUIRE(collide(a, b, 0.002F, manifold));
  CHECK(manifold.normal.dot(Plane::Vector(-0.918F, -0.396F)) > 0.999F);
  for (const auto& point : manifold.points) CHECK(std::abs(point.gap) < 1e-5F);
}
