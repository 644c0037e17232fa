// SPDX-License-Identifier: MIT
// overlap, distance and collide for every pair of shapes, in either order, with and without a
// cache.
//
// The distance proves itself, by the support function alone: the separation along its normal is a
// lower bound of the gap; its witnesses, if they lie in the shapes, make an upper one where the
// shapes are apart; where they overlap no other direction may separate better.
#include <cmath>
#include <doctest/doctest.h>
#include <random>

#include "moreau/detect/collide.hpp"

#include "detect/shapes.hpp"
#include "sanitized.hpp"

using namespace moreau;

namespace {

/// 1e-12 of the smallest diameter here.
constexpr double tiny = 1.6e-12;

/// A shape that shows no more than its support.
template <class ShapeT>
struct Opaque {
  using Space = SpaceOf<ShapeT>;
  using Vector = typename Space::Vector;
  ShapeT inside;
  MassProperties<Space> mass_properties(double density) const {
    return inside.mass_properties(density);
  }
  Aabb<Space> bounding_box(const Pose<Space>& pose) const { return inside.bounding_box(pose); }
  Vector support(const Vector& direction) const { return inside.support(direction); }
};
/// An ellipsoid, in the plane an ellipse.
template <class S>
struct Ellipsoid {
  using Space = S;
  using Vector = typename S::Vector;
  Vector axes;
  MassProperties<S> mass_properties(double) const { return {}; }
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    const double most = axes.maxCoeff();
    return {pose.position.array() - most, pose.position.array() + most};
  }
  Vector support(const Vector& direction) const {
    const Vector stretched = axes.cwiseProduct(direction);
    return axes.cwiseProduct(stretched.normalized());
  }
};

template <class ShapeT>
ShapeT draw(std::mt19937_64& random) {
  return samples::grain(SpaceOf<ShapeT>{}, random);
}
template <>
Ball<double> draw(std::mt19937_64&) {
  return Ball<double>(0.8);
}
template <>
Disk<double> draw(std::mt19937_64&) {
  return Disk<double>(0.8);
}
template <>
HalfSpace<Space<3>> draw(std::mt19937_64& random) {
  return HalfSpace<Space<3>>(samples::direction<Space<3>>(random));
}
template <>
HalfSpace<Space<2>> draw(std::mt19937_64& random) {
  return HalfSpace<Space<2>>(samples::direction<Space<2>>(random));
}

template <>
Opaque<Polyhedron<double>> draw(std::mt19937_64& random) {
  return {samples::grain(Space<3>{}, random)};
}
template <>
Opaque<Polygon<double>> draw(std::mt19937_64& random) {
  return {samples::grain(Space<2>{}, random)};
}
template <>
Ellipsoid<Space<3>> draw(std::mt19937_64&) {
  return {{1, 0.8, 0.6}};
}
template <>
Ellipsoid<Space<2>> draw(std::mt19937_64&) {
  return {{1, 0.7}};
}

template <class Shape>
inline constexpr bool is_wall = false;
template <class S>
inline constexpr bool is_wall<HalfSpace<S>> = true;

/// min over b of n . x - max over a of n . x
template <class A, class B, class Vector>
double separation(const Placed<A>& a, const Placed<B>& b, const Vector& n) {
  const auto top = [](const auto& body, const Vector& direction) {
    return direction.dot(body.support(direction));
  };
  return n.dot(b.center() - a.center()) - top(b, Vector(-n)) - top(a, n);
}

template <class A, class B>
void check_best(const Placed<A>& a, const Placed<B>& b, const SignedDistance<SpaceOf<A>>& found,
                std::mt19937_64& random) {
  using S = SpaceOf<A>;
  CHECK(std::abs(separation(a, b, found.normal) - found.gap) < tiny);
  for (int i = 0; i < 50; ++i) {
    const auto anywhere = samples::direction<S>(random);
    const auto nearby = (found.normal + std::pow(10., -i % 6) * anywhere).eval();
    CHECK(separation(a, b, anywhere) <= found.gap + tiny);
    if (nearby.norm() > 1e-3)
      CHECK(separation(a, b, nearby.normalized().eval()) <= found.gap + tiny);
  }
}

template <class A, class B>
void check_queries(const Placed<A>& a, const Placed<B>& b, double margin, std::mt19937_64& random) {
  using S = SpaceOf<A>;
  const auto found = distance(a, b);
  CHECK(found.normal.norm() == doctest::Approx(1).epsilon(1e-14));
  CHECK((found.witness_b - found.witness_a - found.gap * found.normal).norm() < tiny);
  if constexpr (!is_wall<A> && !is_wall<B>) check_best(a, b, found, random);

  const auto swapped = distance(b, a);
  CHECK(std::abs(swapped.gap - found.gap) < tiny);
  // 0.01 degrees: on curved surfaces a gap to tiny says the normal to 1e-6.
  if (std::abs(found.gap) > 1e-9) CHECK((swapped.normal + found.normal).norm() < 1.7e-4);

  Manifold<S> manifold, other;
  PairCache<S> first, second, third;
  const bool touch = collide(a, b, margin, manifold);
  CHECK(touch == (found.gap <= margin));
  CHECK(collide(b, a, margin, other) == touch);
  CHECK(overlap(a, b) == (found.gap <= 0));
  CHECK(overlap(b, a) == (found.gap <= 0));
  for (int again = 0; again < 3; ++again) {
    CHECK(overlap(a, b, first) == (found.gap <= 0));
    CHECK(distance(a, b, second).gap == found.gap);
    CHECK(collide(a, b, margin, other, third) == touch);
    if (!touch) continue;
    CHECK(other.gap == manifold.gap);
    CHECK(other.normal == manifold.normal);
    CHECK(other.contact_class == manifold.contact_class);
  }
  if (touch) CHECK(std::abs(manifold.gap - found.gap) < tiny);
}

template <class A, class B>
void check_pair(std::mt19937_64& random) {
  using S = SpaceOf<A>;
  for (int i = 0; i < rounds(300); ++i) {
    const A shape_a = draw<A>(random);
    const B shape_b = draw<B>(random);
    const auto center = (10 * samples::direction<S>(random)).eval();
    std::uniform_real_distribution<double> apart(0, 2.2);
    const Pose<S> pose_a{center, samples::rotation(S{}, random)};
    const Pose<S> pose_b{center + apart(random) * samples::direction<S>(random),
                         samples::rotation(S{}, random)};
    check_queries(Placed<A>(shape_a, pose_a), Placed<B>(shape_b, pose_b), 0.1, random);
  }
}

}  // namespace

TEST_CASE("every query for every pair in space") {
  using Solid = Polyhedron<double>;
  using Wall = HalfSpace<Space<3>>;
  std::mt19937_64 random(1);
  check_pair<Ball<double>, Ball<double>>(random);
  check_pair<Ball<double>, Solid>(random);
  check_pair<Solid, Solid>(random);
  check_pair<Ball<double>, Wall>(random);
  check_pair<Solid, Wall>(random);
}

TEST_CASE("every query for every pair in the plane") {
  using Wall = HalfSpace<Space<2>>;
  std::mt19937_64 random(2);
  check_pair<Disk<double>, Disk<double>>(random);
  check_pair<Disk<double>, Polygon<double>>(random);
  check_pair<Polygon<double>, Polygon<double>>(random);
  check_pair<Disk<double>, Wall>(random);
  check_pair<Polygon<double>, Wall>(random);
}

TEST_CASE("shapes known by their support alone, against all others") {
  using Solid = Opaque<Polyhedron<double>>;
  using Flat = Opaque<Polygon<double>>;
  std::mt19937_64 random(3);
  check_pair<Solid, Solid>(random);
  check_pair<Solid, Polyhedron<double>>(random);
  check_pair<Polyhedron<double>, Solid>(random);
  check_pair<Ball<double>, Solid>(random);
  check_pair<Solid, HalfSpace<Space<3>>>(random);
  check_pair<Flat, Flat>(random);
  check_pair<Polygon<double>, Flat>(random);
  check_pair<Disk<double>, Flat>(random);
  check_pair<Flat, HalfSpace<Space<2>>>(random);
}

TEST_CASE("ellipsoids and ellipses") {
  std::mt19937_64 random(4);
  check_pair<Ellipsoid<Space<3>>, Ellipsoid<Space<3>>>(random);
  check_pair<Ellipsoid<Space<3>>, Polyhedron<double>>(random);
  check_pair<Ball<double>, Ellipsoid<Space<3>>>(random);
  check_pair<Ellipsoid<Space<2>>, Ellipsoid<Space<2>>>(random);
  check_pair<Ellipsoid<Space<2>>, Polygon<double>>(random);
}

TEST_CASE("what a polytope shows of its support gives the gap of its faces and edges") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> apart(0, 2.2);
  for (int i = 0; i < rounds(500); ++i) {
    const auto a = draw<Opaque<Polyhedron<double>>>(random);
    const auto b = draw<Opaque<Polyhedron<double>>>(random);
    const Pose<Space<3>> pose{apart(random) * samples::direction<Space<3>>(random),
                              samples::rotation(Space<3>{}, random)};
    const auto exact = distance(Placed(a.inside), Placed(b.inside, pose));
    CHECK(std::abs(distance(Placed(a), Placed(b, pose)).gap - exact.gap) < tiny);
  }
}
