// SPDX-License-Identifier: MIT
// Tests the queries overlap, distance and collide for a pair of shapes, in both orders, with and
// without a cache.
//
// The distance is checked with the support functions only. The separation along its normal is a
// lower bound of the gap. If the shapes are apart and the witness points lie in the shapes, the
// distance of the witness points is an upper bound. If the shapes overlap, no other direction may
// have a larger separation.
#pragma once

#include <cmath>
#include <doctest/doctest.h>
#include <random>
#include <type_traits>

#include "moreau/detect/collide.hpp"
#include "moreau/shape/capsule.hpp"

#include "detect/shapes.hpp"
#include "sanitized.hpp"

namespace queries {

using namespace moreau;

/// 1e-12 times the smallest diameter of the shapes in these tests [m].
constexpr double tiny = 1.6e-12;

/// A shape of which all functions but support, mass and bounding box are hidden.
template <class ShapeT>
struct Opaque {
  using Space = SpaceOf<ShapeT>;
  using Vector = typename Space::Vector;
  ShapeT inside;
  MassProperties<Space> mass_properties(typename Space::Scalar density) const {
    return inside.mass_properties(density);
  }
  Aabb<Space> bounding_box(const Pose<Space>& pose) const { return inside.bounding_box(pose); }
  Vector support(const Vector& direction) const { return inside.support(direction); }
};
/// An ellipsoid, or in the plane an ellipse.
template <class S>
struct Ellipsoid {
  using Space = S;
  using Vector = typename S::Vector;
  Vector axes;
  MassProperties<S> mass_properties(typename S::Scalar) const { return {}; }
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    const auto most = axes.maxCoeff();
    return {pose.position.array() - most, pose.position.array() + most};
  }
  Vector support(const Vector& direction) const {
    const Vector stretched = axes.cwiseProduct(direction);
    return axes.cwiseProduct(stretched.normalized());
  }
};

/// Draws a random shape of this type.
template <class ShapeT>
struct Draw {
  static ShapeT from(std::mt19937_64& random) { return samples::grain(SpaceOf<ShapeT>{}, random); }
};
template <class S>
struct Draw<BallIn<S>> {
  static BallIn<S> from(std::mt19937_64&) { return BallIn<S>(typename S::Scalar(0.8)); }
};
template <class S>
struct Draw<HalfSpace<S>> {
  static HalfSpace<S> from(std::mt19937_64& random) {
    return HalfSpace<S>(samples::direction<S>(random));
  }
};
template <class ShapeT>
struct Draw<Opaque<ShapeT>> {
  static Opaque<ShapeT> from(std::mt19937_64& random) { return {Draw<ShapeT>::from(random)}; }
};
template <class S>
struct Draw<Ellipsoid<S>> {
  using T = typename S::Scalar;
  static Ellipsoid<S> from(std::mt19937_64&) {
    return {S::Vector::LinSpaced(T(1), S::dim == 3 ? T(0.6) : T(0.7))};
  }
};
template <class S>
struct Draw<Segment<S>> {
  static Segment<S> from(std::mt19937_64& random) {
    return Segment<S>(
        static_cast<typename S::Scalar>(std::uniform_real_distribution(0.2, 1.)(random)));
  }
};
template <class Core>
struct Draw<Rounded<Core>> {
  static Rounded<Core> from(std::mt19937_64& random) {
    const double radius = std::uniform_real_distribution(0.05, 0.4)(random);
    return {Draw<Core>::from(random), static_cast<typename SpaceOf<Core>::Scalar>(radius)};
  }
};
template <class... Shapes>
struct Draw<OneOf<Shapes...>> {
  static OneOf<Shapes...> from(std::mt19937_64& random) {
    using From = OneOf<Shapes...> (*)(std::mt19937_64&);
    constexpr From all[] = {
        [](std::mt19937_64& r) -> OneOf<Shapes...> { return Draw<Shapes>::from(r); }...};
    return all[random() % sizeof...(Shapes)](random);
  }
};

template <class ShapeT>
inline constexpr bool is_curved = false;
template <class S>
inline constexpr bool is_curved<Ellipsoid<S>> = true;

/// Accuracy of a gap [m]. For a curved surface with a support function only, rounding errors of the
/// support points limit it.
template <class A, class B>
constexpr double exactness = std::is_same_v<typename SpaceOf<A>::Scalar, float> ? 2e-3
                             : is_curved<A> || is_curved<B>                     ? 1e-8
                                                                                : tiny;
/// Accuracy of a normal [rad]: about the square root of the accuracy of the gap.
template <class A, class B>
constexpr double turned = std::is_same_v<typename SpaceOf<A>::Scalar, float> ? 0.1 : 1.7e-4;

template <class Shape>
inline constexpr bool is_wall = false;
template <class S>
inline constexpr bool is_wall<HalfSpace<S>> = true;

/// The separation along n: min over b of n . x - max over a of n . x.
template <class A, class B, class Vector>
auto separation(const Placed<A>& a, const Placed<B>& b, const Vector& n) {
  const auto top = [](const auto& body, const Vector& direction) {
    return direction.dot(body.support(direction));
  };
  return n.dot(b.center() - a.center()) - top(b, Vector(-n)) - top(a, n);
}

template <class A, class B>
void check_best(const Placed<A>& a, const Placed<B>& b, const SignedDistance<SpaceOf<A>>& found,
                std::mt19937_64& random) {
  using S = SpaceOf<A>;
  using T = typename S::Scalar;
  constexpr T close = static_cast<T>(exactness<A, B>);
  CHECK(std::abs(separation(a, b, found.normal) - found.gap) < close);
  for (int i = 0; i < 50; ++i) {
    const auto anywhere = samples::direction<S>(random);
    const auto nearby = (found.normal + static_cast<T>(std::pow(10., -i % 6)) * anywhere).eval();
    CHECK(separation(a, b, anywhere) <= found.gap + close);
    if (nearby.norm() > 1e-3)
      CHECK(separation(a, b, nearby.normalized().eval()) <= found.gap + close);
  }
}

template <class A, class B>
void check_queries(const Placed<A>& a, const Placed<B>& b, typename SpaceOf<A>::Scalar margin,
                   std::mt19937_64& random) {
  using S = SpaceOf<A>;
  constexpr double close = exactness<A, B>;
  const auto found = distance(a, b);
  CHECK(std::abs(found.normal.norm() - 1) < 1e-2 * exactness<A, A>);
  CHECK((found.witness_b - found.witness_a - found.gap * found.normal).norm() < exactness<A, A>);
  if constexpr (!is_wall<A> && !is_wall<B>) check_best(a, b, found, random);

  const auto swapped = distance(b, a);
  CHECK(std::abs(swapped.gap - found.gap) < close);
  if (std::abs(found.gap) > 1e3 * close)
    CHECK((swapped.normal + found.normal).norm() < turned<A, B>);

  // The same function computes the result, but for pairs with a OneOf the compiler may make another
  // copy of it, with other rounding errors.
  constexpr bool is_visited = is_one_of<A> || is_one_of<B>;
  const auto same = [](double x, double y) {
    return is_visited ? std::abs(x - y) <= 1e-2 * exactness<A, A> : x == y;
  };
  // Of smooth shapes the cache holds the start of an iteration: another start ends within its
  // accuracy (detect/convex/smooth_axis.hpp).
  constexpr bool is_general = GeneralPair<A, B> || GeneralPair<B, A>;
  const auto alike = [&](double x, double y, double tolerance) {
    return is_general ? std::abs(x - y) < tolerance : same(x, y);
  };
  Manifold<S> manifold, other;
  PairCache<S> first, second, third;
  const bool touch = collide(a, b, margin, manifold);
  CHECK(touch == (found.gap <= margin));
  CHECK(collide(b, a, margin, other) == touch);
  CHECK(overlap(a, b) == (found.gap <= 0));
  CHECK(overlap(b, a) == (found.gap <= 0));
  for (int again = 0; again < 3; ++again) {
    CHECK(overlap(a, b, first) == (found.gap <= 0));
    CHECK(same(distance(a, b, second).gap, found.gap));
    CHECK(collide(a, b, margin, other, third) == touch);
    if (!touch) continue;
    CHECK(alike(other.gap, manifold.gap, close));
    CHECK(alike((other.normal - manifold.normal).norm(), 0, turned<A, B>));
    CHECK(other.contact_class == manifold.contact_class);
  }
  if (touch) CHECK(std::abs(manifold.gap - found.gap) < close);
}

template <class A, class B>
void check_pair(std::mt19937_64& random, int count = 300) {
  using S = SpaceOf<A>;
  using T = typename S::Scalar;
  for (int i = 0; i < rounds(count); ++i) {
    const A shape_a = Draw<A>::from(random);
    const B shape_b = Draw<B>::from(random);
    const auto center = (10 * samples::direction<S>(random)).eval();
    std::uniform_real_distribution<double> apart(0, 2.2);
    const Pose<S> pose_a{center, samples::rotation(S{}, random)};
    const Pose<S> pose_b{center + static_cast<T>(apart(random)) * samples::direction<S>(random),
                         samples::rotation(S{}, random)};
    check_queries(Placed<A>(shape_a, pose_a), Placed<B>(shape_b, pose_b), T(0.1), random);
  }
}

}  // namespace queries
