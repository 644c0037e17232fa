// SPDX-License-Identifier: MIT
// Newton's method for smooth shapes of which only the support function is known, against GJK and EPA.
#include <array>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <string>

#include "moreau/detect/collide.hpp"

#include "detect/shapes.hpp"

using namespace moreau;

namespace {

/// The body sum |x_i / axes_i|^p <= 1; counts the calls of its support function.
template <class S>
struct Superellipsoid {
  using Space = S;
  using Vector = typename S::Vector;
  Vector axes;
  double p;
  static inline long calls = 0;

  Vector support(const Vector& direction) const {
    ++calls;
    const Vector d = axes.cwiseProduct(direction).normalized();
    const Vector x = d.cwiseAbs().array().pow(1 / (p - 1));
    return axes.cwiseProduct(x.cwiseProduct(d.cwiseSign())) /
           std::pow(x.array().pow(p).sum(), 1 / p);
  }
  Aabb<S> bounding_box(const Pose<S>& pose) const {
    const double most = axes.norm();
    return {pose.position.array() - most, pose.position.array() + most};
  }
  MassProperties<S> mass_properties(double) const { return {}; }
};

/// Two shapes that move slowly near contact.
template <class S>
class Couple {
 public:
  using Shape = Superellipsoid<S>;
  using Vector = typename S::Vector;
  using Pair = detail::ConvexPair<Shape, Shape>;
  static constexpr double size = 0.02;

  Couple(double p, std::mt19937_64& random)
      : shape_a_(draw(p, random)), shape_b_(draw(p, random)), a_(shape_a_), b_(shape_b_) {
    a_.update(shape_a_, {Vector::Zero(), samples::rotation(S{}, random)});
  }
  /// Puts b where the signed gap along a random line is about `gap` [m].
  void put_at(double gap, std::mt19937_64& random) {
    pose_.rotation = samples::rotation(S{}, random);
    const Vector line = samples::direction<S>(random);
    double inside = 0, outside = 4 * size;
    for (int k = 0; k < 30; ++k) {
      pose_.position = (inside + outside) / 2 * line;
      b_.update(shape_b_, pose_);
      (exact() > gap ? outside : inside) = (inside + outside) / 2;
    }
  }
  void move(std::mt19937_64& random) {
    pose_.position += 1e-4 * size * samples::direction<S>(random);
    typename S::Angular turn;
    for (auto& w : turn) w = 1e-4 * samples::direction<S>(random)[0];
    pose_.rotation = S::normalized(S::exp(turn) * pose_.rotation);
    b_.update(shape_b_, pose_);
  }
  double exact() const { return Pair(a_, b_).distance(infinity).gap; }
  /// @param axis in: first guess; out: the axis found
  SignedDistance<S> quick(Vector& axis) const { return Pair(a_, b_).distance(infinity, axis); }
  const Placed<Shape>& a() const { return a_; }
  const Placed<Shape>& b() const { return b_; }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static Shape draw(double p, std::mt19937_64& random) {
    std::uniform_real_distribution<double> axis(0.3 * size, 0.7 * size);
    Vector axes;
    for (double& x : axes) x = axis(random);
    return {axes, p};
  }

  Shape shape_a_, shape_b_;
  Placed<Shape> a_, b_;
  Pose<S> pose_;
};

/// Largest errors relative to the size, and calls of the support function per query.
struct Errors {
  double cold = 0, warm = 0, separation = 0, calls = 0;
};

template <class S>
Errors follow(double p, double gap) {
  std::mt19937_64 random(7);
  Errors errors;
  long warm_calls = 0, queries = 0;
  for (int pair = 0; pair < 20; ++pair) {
    Couple<S> couple(p, random);
    couple.put_at(gap * Couple<S>::size, random);
    typename S::Vector axis = S::Vector::Zero();
    static_cast<void>(couple.quick(axis));
    for (int step = 0; step < 10; ++step) {
      couple.move(random);
      const double exact = couple.exact();
      typename S::Vector none = S::Vector::Zero();
      const SignedDistance<S> cold = couple.quick(none);
      const long before = Superellipsoid<S>::calls;
      const SignedDistance<S> warm = couple.quick(axis);
      warm_calls += Superellipsoid<S>::calls - before;
      ++queries;
      const double along = warm.normal.dot(couple.b().center() + couple.b().support(-warm.normal) -
                                           couple.a().center() - couple.a().support(warm.normal));
      errors.cold = std::max(errors.cold, std::abs(cold.gap - exact) / Couple<S>::size);
      errors.warm = std::max(errors.warm, std::abs(warm.gap - exact) / Couple<S>::size);
      errors.separation = std::max(errors.separation, std::abs(warm.gap - along) / Couple<S>::size);
    }
  }
  errors.calls = double(warm_calls) / double(queries);
  return errors;
}

template <class S>
void check_gaps(double p) {
  for (const double gap : {1e-2, 1e-3, 1e-6, -1e-6, -1e-4, -1e-3, -1e-2, -0.1}) {
    INFO("exponent " << p << ", gap / size " << gap << ", dimension " << int(S::dim));
    const Errors errors = follow<S>(p, gap);
    CHECK(errors.cold <= 1e-9);
    CHECK(errors.warm <= 1e-9);
    CHECK(errors.separation <= 1e-12);
  }
}

}  // namespace

TEST_CASE("gaps and depths of smooth shapes are those of GJK and EPA") {
  for (const double p : {2.0, 3.0, 6.0}) {
    check_gaps<Space<2>>(p);
    check_gaps<Space<3>>(p);
  }
}

TEST_CASE("a query of ellipsoids that move slowly takes few calls of the support function") {
  CHECK(follow<Space<3>>(2, 1e-3).calls <= 16);
  CHECK(follow<Space<3>>(2, -1e-4).calls <= 20);
  CHECK(follow<Space<2>>(2, 1e-3).calls <= 14);
}

TEST_CASE("a wrong guess of the axis does not change the gap") {
  using S = Space<3>;
  std::mt19937_64 random(3);
  for (int pair = 0; pair < 50; ++pair) {
    Couple<S> couple(2.5, random);
    couple.put_at((pair % 2 == 0 ? 1e-3 : -1e-3) * Couple<S>::size, random);
    const double exact = couple.exact();
    for (int guess = 0; guess < 20; ++guess) {
      S::Vector axis = samples::direction<S>(random);
      const SignedDistance<S> found = couple.quick(axis);
      CHECK(std::abs(found.gap - exact) <= 1e-9 * Couple<S>::size);
    }
  }
}
