// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>
#include <random>

#include "moreau/detect/collide.hpp"

#include "detect/shapes.hpp"

using namespace moreau;

namespace {

/// A shape above an inclined wall far from the origin, at a given gap.
template <class S, class ShapeT>
void check_above_wall(const ShapeT& shape, std::mt19937_64& random) {
  using Vector = typename S::Vector;
  const Vector up = samples::direction<S>(random);
  const HalfSpace<S> wall(up);
  const Vector origin = 1e3 * samples::direction<S>(random);
  const Placed<HalfSpace<S>> plane(wall, Pose<S>{origin, S::identity()});
  Pose<S> pose{Vector::Zero(), samples::rotation(S{}, random)};
  const double reach = -up.dot(Placed<ShapeT>(shape, pose).support(-up));
  for (const double gap : {-0.1, -1e-6, 0.0, 1e-6, 0.1}) {
    pose.position = origin + (reach + gap) * up;
    const Placed<ShapeT> a(shape, pose);
    const auto found = distance(a, plane);
    CHECK(std::abs(found.gap - gap) < 1e-12);
    CHECK((found.normal + up).norm() < 1e-14);
    CHECK(std::abs(up.dot(found.witness_b - origin)) < 1e-12);
    const auto back = distance(plane, a);
    CHECK((back.normal - up).norm() < 1e-14);
    CHECK(back.witness_a == found.witness_b);
    Manifold<S> manifold, other;
    CHECK(collide(a, plane, 0.05, manifold) == (gap <= 0.05));
    CHECK(collide(plane, a, 0.05, other) == (gap <= 0.05));
    if (gap > 0.05) continue;
    CHECK(other.normal == -manifold.normal);
    REQUIRE(other.points.size() == manifold.points.size());
    double deepest = 1;
    for (const auto& point : manifold.points) {
      deepest = std::min(deepest, point.gap);
      CHECK(point.gap <= 0.05 + 1e-12);
      // The contact point lies midway between the plane and the surface.
      CHECK(std::abs(up.dot(point.position - origin) - point.gap / 2) < 1e-12);
    }
    CHECK(std::abs(deepest - gap) < 1e-12);
  }
}

}  // namespace

TEST_CASE("walls under polytopes, balls and disks") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100; ++i) {
    check_above_wall<Space<2>>(samples::grain(Space<2>{}, random), random);
    check_above_wall<Space<3>>(samples::grain(Space<3>{}, random), random);
    check_above_wall<Space<2>>(moreau::Disk<>(0.7), random);
    check_above_wall<Space<3>>(moreau::Ball<>(0.7), random);
  }
}

TEST_CASE("walls: the class counts the vertices") {
  const HalfSpace<Space<3>> floor(Space<3>::Vector::UnitZ());
  const auto box = samples::box(1., 1., 1.);
  Manifold<Space<3>> manifold;
  const auto class_at = [&](const Eigen::Quaterniond& q) {
    Pose<Space<3>> pose{Space<3>::Vector::Zero(), q};
    pose.position.z() =
        1e-4 - Placed<Polyhedron<double>>(box, pose).support(-Space<3>::Vector::UnitZ()).z();
    REQUIRE(collide(Placed<Polyhedron<double>>(box, pose), Placed<HalfSpace<Space<3>>>(floor), 1e-3,
                    manifold));
    return manifold.contact_class;
  };
  CHECK(class_at(Eigen::Quaterniond::Identity()) == ContactClass::face_face);
  CHECK(manifold.points.size() == 4);
  CHECK(class_at(Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()))) ==
        ContactClass::edge_face);
  CHECK(class_at(Eigen::Quaterniond(Eigen::AngleAxisd(
            0.5, Eigen::Vector3d(1, 1, 0).normalized()))) == ContactClass::vertex_face);

  const HalfSpace<Space<2>> line(Space<2>::Vector::UnitY());
  Manifold<Space<2>> flat;
  Pose<Space<2>> pose{Space<2>::Vector(0, 0.5), Space<2>::identity()};
  const Polygon<double> square = samples::box(1., 1.);
  REQUIRE(collide(Placed<Polygon<double>>(square, pose), Placed<HalfSpace<Space<2>>>(line), 1e-3,
                  flat));
  CHECK(flat.contact_class == ContactClass::edge_edge);
  CHECK(flat.points.size() == 2);
}
