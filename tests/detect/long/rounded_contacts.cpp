// SPDX-License-Identifier: MIT
// Contact points of capsules, rounded shapes and shapes with a support function only, in cases that
// can be computed by hand.
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <random>

#include "moreau/detect/collide.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/support_box.hpp"

#include "detect/shapes.hpp"

using namespace moreau;

namespace {

using S3 = Space<3>;
using S2 = Space<2>;
using V3 = S3::Vector;
using V2 = S2::Vector;
using Rod = CapsuleIn<S3>;
constexpr double pi = std::numbers::pi;

template <class A, class B>
Manifold<SpaceOf<A>> contact(const A& a, const Pose<SpaceOf<A>>& pose_a, const B& b,
                             const Pose<SpaceOf<A>>& pose_b, double margin = 0.01) {
  Manifold<SpaceOf<A>> found;
  CHECK(collide(Placed<A>(a, pose_a), Placed<B>(b, pose_b), margin, found));
  return found;
}
Pose<S3> at(const V3& position, const V3& turn = V3::Zero()) {
  return {position, S3::exp(turn)};
}
Pose<S2> at(const V2& position, double turn = 0) {
  return {position, S2::Rotation(turn)};
}

template <class M>
void check_points(const M& found, std::vector<typename std::decay_t<decltype(found.normal)>> truth,
                  double gap) {
  CHECK(found.points.size() == truth.size());
  for (const auto& x : truth) {
    double nearest = 1e9;
    for (const auto& point : found.points) nearest = std::min(nearest, (point.position - x).norm());
    CHECK(nearest < 1e-12);
  }
  for (const auto& point : found.points) CHECK(std::abs(point.gap - gap) < 1e-12);
}

TEST_CASE("a rod lying on a wall, on a face, along a rod: two points") {
  const Rod rod(1, 0.2);
  const auto on_wall =
      contact(rod, at(V3(0, 0, 0.195)), HalfSpace<S3>(V3(0, 0, 1)), at(V3(0, 0, 0)));
  check_points(on_wall, {V3(-1, 0, -0.0025), V3(1, 0, -0.0025)}, -0.005);
  CHECK(on_wall.contact_class == ContactClass::edge_face);
  CHECK(on_wall.normal == V3(0, 0, -1));

  // The rod lies across the rim of a box with the half sides (0.5, 1, 0.5) and overlaps it a
  // little.
  const auto on_box = contact(rod, at(V3(0.3, 0, 0.69)), samples::box(1., 2., 1.), at(V3(0, 0, 0)));
  check_points(on_box, {V3(-0.5, 0, 0.495), V3(0.5, 0, 0.495)}, -0.01);
  CHECK(on_box.contact_class == ContactClass::edge_face);
  CHECK((on_box.normal - V3(0, 0, -1)).norm() < 1e-12);

  const auto side = contact(rod, at(V3(0, 0, 0)), Rod(0.5, 0.3), at(V3(0.8, 0.5, 0), V3(0, 0, pi)));
  check_points(side, {V3(0.3, 0.2, 0), V3(1, 0.2, 0)}, 0);
  CHECK(side.contact_class == ContactClass::edge_edge);
}

TEST_CASE("a stadium on a wall, on an edge, along a stadium: two points") {
  const CapsuleIn<S2> rod(1, 0.2);
  const auto on_wall = contact(rod, at(V2(0, 0.2)), HalfSpace<S2>(V2(0, 1)), at(V2(0, 0)));
  check_points(on_wall, {V2(-1, 0), V2(1, 0)}, 0);
  CHECK(on_wall.contact_class == ContactClass::edge_edge);
  const auto on_box = contact(rod, at(V2(0.3, 0.69)), samples::box(1., 1.), at(V2(0, 0)));
  check_points(on_box, {V2(-0.5, 0.495), V2(0.5, 0.495)}, -0.01);
  CHECK(on_box.contact_class == ContactClass::edge_edge);
  const auto side = contact(rod, at(V2(0, 0)), rod, at(V2(0.8, 0.4), pi));
  check_points(side, {V2(-0.2, 0.2), V2(1, 0.2)}, 0);
}

TEST_CASE("crossing rods touch in one point, however deep") {
  const Rod rod(1, 0.2);
  for (const double height : {0.405, 0.4, 0.1, 1e-7, 0.0}) {
    const auto found = contact(rod, at(V3(0, 0, 0)), rod, at(V3(0.1, 0, height), V3(0, 0, 1)));
    CHECK(std::abs(found.gap - (height - 0.4)) < 1e-13);
    CHECK(std::abs(found.normal.z()) == doctest::Approx(1).epsilon(1e-13));
    REQUIRE(found.points.size() == 1);
    CHECK((found.points[0].position - V3(0.1, 0, height / 2)).norm() < 1e-12);
    CHECK(found.contact_class == ContactClass::edge_edge);
  }
  // In the plane, segments that cross overlap. The axis is the direction of the shorter
  // displacement that separates them.
  const CapsuleIn<S2> flat(1, 0.2);
  const auto found = contact(flat, at(V2(0, 0)), flat, at(V2(0.2, 0.7), pi / 2));
  CHECK(found.gap == doctest::Approx(-0.3 - 0.4));
  CHECK((found.normal - V2(0, 1)).norm() < 1e-12);
}

TEST_CASE("rods in line, end to end, and one inside the other") {
  const Rod rod(1, 0.2);
  const auto apart = distance(Placed<Rod>(rod), Placed<Rod>(rod, at(V3(2.5, 0, 0))));
  CHECK(apart.gap == doctest::Approx(0.1));
  CHECK((apart.normal - V3(1, 0, 0)).norm() < 1e-12);
  const auto inside = distance(Placed<Rod>(rod), Placed<Rod>(rod, at(V3(0.5, 0, 0))));
  CHECK(inside.gap == doctest::Approx(-0.4));
  CHECK(std::abs(inside.normal.x()) < 1e-12);
  using Flat = CapsuleIn<S2>;
  const Flat flat(1, 0.2);
  const auto row = distance(Placed<Flat>(flat), Placed<Flat>(flat, at(V2(2.5, 0))));
  CHECK(row.gap == doctest::Approx(0.1));
  const Ball<double> round(0.5);
  const Placed<Ball<double>> ball(round, at(V3(0.3, 0, 0)));
  CHECK(distance(ball, Placed<Rod>(rod)).gap == doctest::Approx(-0.7));
  CHECK(distance(Placed<Rod>(rod), ball).gap == doctest::Approx(-0.7));
}

TEST_CASE("rounded boxes keep the points, keys and class of their cores") {
  const auto box = samples::box(1., 1., 1.);
  const Rounded<Polyhedron<double>> rounded(box, 0.1);
  const Pose<S3> below = at(V3(0, 0, 0)), above = at(V3(0.2, 0.1, 1.195), V3(0, 0, 0.2));
  const auto cores = contact(box, below, box, above, 0.3);
  const auto found = contact(rounded, below, rounded, above, 0.1);
  CHECK(found.contact_class == ContactClass::face_face);
  CHECK(found.gap == doctest::Approx(-0.005));
  REQUIRE(found.points.size() == cores.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    CHECK(found.points[i].feature == cores.points[i].feature);
    CHECK(found.points[i].gap == doctest::Approx(cores.points[i].gap - 0.2));
    CHECK((found.points[i].position - cores.points[i].position).norm() < 1e-12);
  }
  // If only one of the shapes is rounded, the contact points are shifted towards the shape that is
  // not rounded, by half of the radius.
  const auto mixed = contact(rounded, below, box, at(V3(0, 0, 1.1)), 0.01);
  for (const auto& point : mixed.points) CHECK(point.position.z() == doctest::Approx(0.6));
}

/// The cube max |x_i| <= 1, with a support function only.
struct Cube {
  using Space = S3;
  using Vector = V3;
  MassProperties<S3> mass_properties(double) const { return {}; }
  Aabb<S3> bounding_box(const Pose<S3>& pose) const { return support_box(*this, pose); }
  Vector support(const Vector& d) const {
    return d.unaryExpr([](double x) { return x < 0 ? -1. : 1.; });
  }
};

TEST_CASE("a flat spot of a shape known by its support rests on its corners") {
  const HalfSpace<S3> floor(V3(0, 0, 1));
  for (const double turn : {0.0, 0.1, 0.5, 0.8}) {
    const auto found = contact(Cube{}, at(V3(0, 0, 1), V3(0, 0, turn)), floor, at(V3(0, 0, 0)));
    CHECK(found.points.size() == 4);
    CHECK(found.contact_class == ContactClass::face_face);
    for (const auto& point : found.points) {
      CHECK(std::abs(point.gap) < 1e-12);
      CHECK(point.position.norm() == doctest::Approx(std::sqrt(2)));
    }
  }
  const auto on_edge =
      contact(Cube{}, at(V3(0, 0, std::sqrt(2)), V3(pi / 4, 0, 0)), floor, at(V3(0, 0, 0)));
  CHECK(on_edge.points.size() == 2);
  CHECK(on_edge.contact_class == ContactClass::edge_face);
  const auto on_corner =
      contact(Cube{}, at(V3(0, 0, 1.5), V3(0.5, 0.6, 0)), floor, at(V3(0, 0, 0)), 1.);
  CHECK(on_corner.points.size() == 1);
}

TEST_CASE("rigid motion of a pair moves its contact along") {
  std::mt19937_64 random(31);
  for (int i = 0; i < 50; ++i) {
    const Rounded<Polyhedron<double>> grain(samples::grain(S3{}, random), 0.2);
    const Rod rod(0.7, 0.3);
    const Pose<S3> pose = at(1.2 * samples::direction<S3>(random), samples::direction<S3>(random));
    const Pose<S3> motion = at(5 * samples::direction<S3>(random), samples::direction<S3>(random));
    const Pose<S3> moved{motion(pose.position), motion.rotation * pose.rotation};
    const auto found = contact(grain, at(V3(0, 0, 0)), rod, pose, 2);
    const auto again = contact(grain, motion, rod, moved, 2);
    CHECK(std::abs(found.gap - again.gap) < 1e-11);
    if (found.gap < -0.5) continue;  // the cores overlap, so two axes may be equally good
    CHECK((motion.rotation * found.normal - again.normal).norm() < 1e-6);
  }
}

}  // namespace
