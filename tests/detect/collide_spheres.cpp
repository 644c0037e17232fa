// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <vector>

#include "moreau/detect/collide.hpp"

#include "detect/oracle.hpp"
#include "detect/shapes.hpp"

using namespace moreau;

namespace {

/// The signed distance of a point from a polytope, by brute force.
template <class ShapeT>
double point_gap(const ShapeT& shape, const typename ShapeT::Vector& x) {
  const auto heights = ((shape.face_normals() * x).array() - shape.face_offsets().array()).eval();
  if (heights.maxCoeff() <= 0) return heights.maxCoeff();
  using S = typename ShapeT::Space;
  // The point is replaced by a tiny polytope around it.
  double best = 1e9;
  const oracle::World<ShapeT> world(shape, Pose<S>{}, S::Vector::Zero());
  if constexpr (requires { shape.edges(); }) {
    for (const auto& e : shape.edges())
      best = std::min(best, (x - oracle::nearest_on_segment(world.vertices[e.vertex[0]],
                                                            world.vertices[e.vertex[1]], x))
                                .norm());
    typename S::Vector difference;
    for (std::size_t f = 0; f < shape.face_count(); ++f)
      if (oracle::face_to_point(shape, world, f, x, difference) && heights[static_cast<int>(f)] > 0)
        best = std::min(best, difference.norm());
  } else {
    const std::size_t n = world.vertices.size();
    for (std::size_t i = 0; i < n; ++i)
      best = std::min(
          best, (x - oracle::nearest_on_segment(world.vertices[i], world.vertices[(i + 1) % n], x))
                    .norm());
  }
  return best;
}

template <class S>
void check_sphere_and_grain(std::mt19937_64& random) {
  using ShapeT = decltype(samples::grain(S{}, random));
  const ShapeT shape = samples::grain(S{}, random);
  const BallIn<S> sphere(0.3);
  std::uniform_real_distribution<double> distance_of(0, 2);
  const typename S::Vector origin = 100 * samples::direction<S>(random);
  const Pose<S> pose{origin, samples::rotation(S{}, random)};
  const Pose<S> at{origin + distance_of(random) * samples::direction<S>(random), S::identity()};
  const Placed<BallIn<S>> a(sphere, at);
  const Placed<ShapeT> b(shape, pose);
  const double truth = point_gap(shape, pose.to_body(at.position)) - sphere.radius();
  const auto found = distance(a, b);
  CHECK(std::abs(found.gap - truth) < 1e-12);
  CHECK((found.witness_b - found.witness_a - found.gap * found.normal).norm() < 1e-12);
  CHECK(std::abs((found.witness_a - at.position).norm() - sphere.radius()) < 1e-12);
  const auto back = distance(b, a);
  CHECK(back.gap == found.gap);
  CHECK(back.normal == -found.normal);
  Manifold<S> manifold, other;
  CHECK(collide(a, b, 0.1, manifold) == (found.gap <= 0.1));
  if (!collide(b, a, 0.1, other)) return;
  CHECK(other.normal == -manifold.normal);
  REQUIRE(manifold.points.size() == 1);
  CHECK(manifold.points[0].gap == doctest::Approx(truth).epsilon(1e-9));
  CHECK(other.points[0].feature.swapped() == manifold.points[0].feature);
  CHECK((manifold.points[0].position - (found.witness_a + found.witness_b) / 2).norm() < 1e-12);
}

template <class S>
void check_two_spheres() {
  using Vector = typename S::Vector;
  const BallIn<S> small(0.5), large(2);
  Pose<S> pose;
  pose.position = 2.6 * Vector::Unit(1);
  Manifold<S> manifold;
  const Placed<BallIn<S>> a(small), b(large, pose);
  REQUIRE(collide(a, b, 0.2, manifold));
  CHECK(manifold.gap == doctest::Approx(0.1));
  CHECK(manifold.normal == Vector::Unit(1));
  REQUIRE(manifold.points.size() == 1);
  CHECK((manifold.points[0].position - 0.55 * Vector::Unit(1)).norm() < 1e-15);
  CHECK_FALSE(collide(a, b, 0.05, manifold));
  CHECK_FALSE(overlap(a, b));
  const Placed<BallIn<S>> same(large);
  CHECK(overlap(a, same));
  const auto concentric = distance(a, same);
  CHECK(concentric.gap == -2.5);
  CHECK(concentric.normal.norm() == 1);
}

}  // namespace

TEST_CASE("two balls, two disks") {
  check_two_spheres<Space<2>>();
  check_two_spheres<Space<3>>();
}

TEST_CASE("ball and polyhedron, disk and polygon against exhaustive search") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    check_sphere_and_grain<Space<2>>(random);
    check_sphere_and_grain<Space<3>>(random);
  }
}

TEST_CASE("ball and box: the class names the feature") {
  using S = Space<3>;
  const auto box = samples::box(2., 2., 2.);
  const BallIn<S> ball(0.5);
  Manifold<S> manifold;
  const auto class_at = [&](const S::Vector& x) {
    REQUIRE(collide(Placed<BallIn<S>>(ball, Pose<S>{x, S::identity()}),
                    Placed<Polyhedron<double>>(box), 0.01, manifold));
    return manifold.contact_class;
  };
  CHECK(class_at({1.5, 0.2, 0.1}) == ContactClass::vertex_face);
  CHECK(class_at({1.3, 1.4, 0.1}) == ContactClass::vertex_edge);
  CHECK(manifold.gap == doctest::Approx(0).epsilon(1e-12));
  CHECK((manifold.normal - S::Vector(-0.6, -0.8, 0)).norm() < 1e-12);
  CHECK(class_at({1.2, 1.2, 1.3}) == ContactClass::vertex_vertex);
  CHECK(class_at({0.2, 0.1, 0.3}) == ContactClass::vertex_face);
  CHECK(manifold.gap == doctest::Approx(-1.2));
}
