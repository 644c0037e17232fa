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
  CHECK(std::abs(separation(a, b, found.normal) - found.gap) < 1e-12);
  for (int i = 0; i < 50; ++i) {
    const auto anywhere = samples::direction<S>(random);
    const auto nearby = (found.normal + std::pow(10., -i % 6) * anywhere).eval();
    CHECK(separation(a, b, anywhere) <= found.gap + 1e-12);
    if (nearby.norm() > 1e-3)
      CHECK(separation(a, b, nearby.normalized().eval()) <= found.gap + 1e-12);
  }
}

template <class A, class B>
void check_queries(const Placed<A>& a, const Placed<B>& b, double margin, std::mt19937_64& random) {
  using S = SpaceOf<A>;
  const auto found = distance(a, b);
  CHECK(found.normal.norm() == doctest::Approx(1).epsilon(1e-14));
  CHECK((found.witness_b - found.witness_a - found.gap * found.normal).norm() < 1e-12);
  if constexpr (!is_wall<A> && !is_wall<B>) check_best(a, b, found, random);

  const auto swapped = distance(b, a);
  CHECK(std::abs(swapped.gap - found.gap) < 1e-12);
  if (std::abs(found.gap) > 1e-9) CHECK((swapped.normal + found.normal).norm() < 1e-6);

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
  if (touch) CHECK(std::abs(manifold.gap - found.gap) < 1e-12);
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
