// SPDX-License-Identifier: MIT
#include "moreau/detect/pairs/collide_cylinder_wall.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <vector>

#include "moreau/shape/capsule.hpp"
#include "moreau/shape/one_of.hpp"
#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "types.hpp"

using moreau::BallIn;
using moreau::Polygon;
using moreau::Polyhedron;
using moreau::Pose;
using moreau::Space;

namespace {

/// The direction perpendicular to x and to the last axis.
template <class S>
typename S::Angular across() {
  return S::Angular::Unit(S::angular_dim / 2);
}

/// All points within a radius of a segment along x, as a shape with a support function only.
template <class S>
struct Stadium {
  using Space = S;
  using Scalar = double;
  using Vector = typename S::Vector;
  double half, radius;

  Vector support(const Vector& direction) const {
    return std::copysign(half, direction[0]) * Vector::UnitX() + radius * direction.normalized();
  }
  moreau::MassProperties<S> mass_properties(double) const { return {}; }
  moreau::Aabb<S> bounding_box(const Pose<S>& pose) const {
    const Vector reach = (pose.rotation * Vector(half * Vector::UnitX())).cwiseAbs();
    return {(pose.position - reach).array() - radius, (pose.position + reach).array() + radius};
  }
};

template <class S>
struct Point {
  typename S::Vector position, normal;
  double gap;
  moreau::FeatureKey feature;
};

template <class ShapeT>
auto points_of(const ShapeT& shape, const Pose<moreau::SpaceOf<ShapeT>>& pose, double radius,
               double margin) {
  using S = moreau::SpaceOf<ShapeT>;
  const moreau::CylinderWall<S> wall(across<S>(), radius);
  moreau::Manifold<S> manifold;
  std::vector<Point<S>> points;
  const bool touch = moreau::collide_each(
      moreau::Placed<ShapeT>(shape, pose), moreau::Placed<moreau::CylinderWall<S>>(wall), margin,
      manifold, [&] {
        const auto& point = manifold.points.at(0);
        points.push_back({point.position, manifold.normal, point.gap, point.feature});
      });
  CHECK(touch == !points.empty());
  return points;
}

}  // namespace

TEST_CASE_TEMPLATE("a ball's gap and normal, on the axis too", S,
                   MOREAU_TYPES((Space<3>), (Space<2>))) {
  using Vector = typename S::Vector;
  const BallIn<S> ball(0.25);
  Pose<S> pose;
  pose.position = Vector::Constant(0.3);
  const Vector outward = (0.3 * (Vector::UnitX() + Vector::Unit(S::dim - 1))).eval();
  const auto points = points_of(ball, pose, 1, 1);
  REQUIRE(points.size() == 1);
  CHECK(points[0].gap == doctest::Approx(1 - 0.25 - outward.norm()));
  CHECK((points[0].normal - outward.normalized()).norm() < 1e-15);
  // The contact point lies midway between the surfaces.
  const Vector expected =
      pose.position - outward + (outward.norm() + 0.25 + points[0].gap / 2) * outward.normalized();
  CHECK((points[0].position - expected).norm() < 1e-15);
  CHECK(points_of(ball, pose, 1, 0.3).empty());
  pose.position.setZero();
  const auto central = points_of(ball, pose, 0.25, 0.01);
  REQUIRE(central.size() == 1);
  CHECK(central[0].gap == doctest::Approx(0));
  CHECK(central[0].normal.norm() == doctest::Approx(1));
  CHECK(S::spin(across<S>(), central[0].normal).norm() == doctest::Approx(1));
}

TEST_CASE_TEMPLATE("every corner of a polytope has its own normal", ShapeT,
                   MOREAU_TYPES((Polyhedron<>), (Polygon<>))) {
  using S = moreau::SpaceOf<ShapeT>;
  using Vector = typename S::Vector;
  std::vector<Vector> corners;
  for (int corner = 0; corner < (1 << S::dim); ++corner) {
    Vector x = Vector::Constant(0.3);
    for (int axis = 0; axis < S::dim; ++axis)
      if ((corner >> axis & 1) != 0) x[axis] = -x[axis];
    corners.push_back(x);
  }
  const ShapeT box(corners);
  Pose<S> pose;
  pose.position[S::dim - 1] = -0.5;
  const auto points = points_of(box, pose, std::sqrt(0.09 + 0.64), 0.1);
  REQUIRE(points.size() == (1u << (S::dim - 1)));
  for (std::size_t k = 0; k < points.size(); ++k) {
    CHECK(std::abs(points[k].gap) < 1e-15);
    CHECK(points[k].normal[0] == doctest::Approx(points[k].position[0] / std::sqrt(0.73)));
    if (k > 0) CHECK(points[k - 1].feature < points[k].feature);
  }
}

TEST_CASE_TEMPLATE("a shape with nothing but its support touches at both its ends", S,
                   MOREAU_TYPES((Space<3>), (Space<2>))) {
  Pose<S> pose;
  pose.position[S::dim - 1] = -0.5;
  const auto both = points_of(Stadium<S>{0.4, 0.1}, pose, 1, 1);
  REQUIRE(both.size() == 2);
  for (const auto& point : both)
    CHECK(point.gap == doctest::Approx(1 - 0.1 - std::hypot(0.4, 0.5)));
  CHECK(both[0].position[0] * both[1].position[0] < 0);
  CHECK(both[0].feature < both[1].feature);
  // If the shape is upright, it touches at one point.
  pose.rotation = S::exp(std::numbers::pi / 2 * across<S>());
  pose.position[0] = 0.1;
  const auto one = points_of(Stadium<S>{0.3, 0.1}, pose, 1, 1);
  REQUIRE(one.size() == 1);
  CHECK(one[0].gap == doctest::Approx(1 - 0.1 - std::hypot(0.1, 0.8)));
}

TEST_CASE_TEMPLATE("capsules and shapes of several kinds are seen as what they are", S,
                   MOREAU_TYPES((Space<3>), (Space<2>))) {
  using Grain = moreau::OneOf<BallIn<S>, moreau::CapsuleIn<S>>;
  Pose<S> pose;
  pose.position[S::dim - 1] = -0.5;
  const auto rod = points_of(Grain(moreau::CapsuleIn<S>(0.4, 0.1)), pose, 1, 1);
  REQUIRE(rod.size() == 2);
  for (const auto& point : rod) CHECK(point.gap == doctest::Approx(1 - 0.1 - std::hypot(0.4, 0.5)));
  const auto ball = points_of(Grain(BallIn<S>(0.2)), pose, 1, 1);
  REQUIRE(ball.size() == 1);
  CHECK(ball[0].gap == doctest::Approx(0.3));
}
