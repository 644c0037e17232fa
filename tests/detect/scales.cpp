// SPDX-License-Identifier: MIT
// Contacts in single precision do not depend on the size of the shapes, from 1e-7 m to 1e7 m: squares
// and higher powers of lengths must neither underflow nor overflow.
#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <random>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "moreau/detect/collide.hpp"
#include "moreau/shape/ball.hpp"
#include "moreau/shape/capsule.hpp"
#include "moreau/shape/half_space.hpp"
#include "moreau/shape/rounded.hpp"

#include "detect/shapes.hpp"
#include "types.hpp"

using namespace moreau;

namespace {

using Plane = Space<2, float>;
using Volume = Space<3, float>;

/// Shapes of about the size `scale` [m].
template <class S>
auto shapes_of(float scale, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto grain = samples::grain<float>(S{}, random).scaled(scale);
  using Grain = std::decay_t<decltype(grain)>;
  return std::tuple(BallIn<S>(0.5f * scale), CapsuleIn<S>(Segment<S>(0.6f * scale), 0.25f * scale),
                    grain, Rounded<Grain>(grain, 0.1f * scale));
}

/// Poses of a pair: from deep overlap to a gap, at random angles and along one another.
template <class S>
Pose<S> pose_of(float scale, int trial, std::mt19937_64& random) {
  Pose<S> pose;
  pose.rotation = trial % 3 == 0 ? S::identity() : samples::rotation(S{}, random);
  pose.position =
      scale * (0.4f + 0.1f * float(trial % 16)) *
      (trial % 3 == 0 ? S::Vector::Unit(trial / 3 % S::dim).eval() : samples::direction<S>(random));
  return pose;
}

template <class A, class B>
void check_pair(const A& a, const B& b, const A& large_a, const B& large_b, float scale, int trial,
                unsigned seed) {
  using S = SpaceOf<A>;
  std::mt19937_64 random(seed), again(seed);
  const Pose<S> pose = pose_of<S>(1, trial, random), large = pose_of<S>(scale, trial, again);
  const Placed<A> first(a, Pose<S>{}), large_first(large_a, Pose<S>{});
  const Placed<B> second(b, pose), large_second(large_b, large);
  const float margin = 0.05f;
  // Both are computed in float. Where a nearly parallel pair has two answers, either is right.
  const auto expected = distance(first, second);
  const auto found = distance(large_first, large_second);
  const float near = 2e-4f;
  CHECK(std::abs(found.gap / scale - expected.gap) < near);
  CHECK(std::abs(found.normal.norm() - 1) < 1e-5f);
  const auto along = [&](const auto& normal) { return normal.dot(pose.position); };
  if (std::abs(expected.gap) > 0.01f && expected.gap > 0)
    CHECK(std::abs(along(found.normal) - along(expected.normal)) < 0.02f);
  Manifold<S> manifold;
  if (std::abs(expected.gap - margin) < near) return;
  CHECK(collide(large_first, large_second, margin * scale, manifold) == (expected.gap < margin));
  if (!(expected.gap < margin)) return;
  CHECK(!manifold.points.empty());
  float deepest = 1;
  for (const auto& point : manifold.points) {
    CHECK(point.position.allFinite());
    deepest = std::min(deepest, point.gap / scale);
  }
  CHECK(std::abs(deepest - expected.gap) < 10 * near);
}

template <class A>
void check_half_space(const A& a, const A& large_a, float scale, int trial, unsigned seed) {
  using S = SpaceOf<A>;
  std::mt19937_64 random(seed), again(seed);
  const HalfSpace<S> wall(S::Vector::Unit(S::dim - 1));
  const Placed<HalfSpace<S>> ground(wall, Pose<S>{}), large_ground(wall, Pose<S>{});
  const Placed<A> first(a, pose_of<S>(1, trial, random)),
      large_first(large_a, pose_of<S>(scale, trial, again));
  Manifold<S> expected, found;
  const bool touches = collide(first, ground, 0.05f, expected);
  CHECK(collide(large_first, large_ground, 0.05f * scale, found) == touches);
  if (!touches) return;
  CHECK(found.points.size() == expected.points.size());
  CHECK(std::abs(found.gap / scale - expected.gap) < 1e-4f);
}

template <class S>
void check_scale(float scale) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto shapes = shapes_of<S>(1, seed), large = shapes_of<S>(scale, seed);
    for (int trial = 0; trial < 48; ++trial) {
      CAPTURE(scale);
      CAPTURE(seed);
      CAPTURE(trial);
      const unsigned of_pose = 100 * seed + unsigned(trial);
      std::apply(
          [&](const auto&... a) {
            std::apply(
                [&](const auto&... large_a) {
                  (check_half_space(a, large_a, scale, trial, of_pose), ...);
                },
                large);
          },
          shapes);
      const auto with = [&]<std::size_t I, std::size_t... Js>(std::index_sequence<Js...>) {
        (check_pair(std::get<I>(shapes), std::get<Js>(shapes), std::get<I>(large),
                    std::get<Js>(large), scale, trial, of_pose),
         ...);
      };
      [&]<std::size_t... Is>(std::index_sequence<Is...> all) {
        (with.template operator()<Is>(all), ...);
      }
      (std::make_index_sequence<4>());
    }
  }
}

}  // namespace

TEST_CASE_TEMPLATE("float: contacts of shapes from 1e-7 m to 1e7 m", S,
                   MOREAU_TYPES((Volume), (Plane))) {
  for (const float scale : {1e-7f, 1e-6f, 3e-5f, 1e-3f, 1e3f, 4e5f, 1e6f, 1e7f})
    check_scale<S>(scale);
}

TEST_CASE_TEMPLATE("float: hulls and moments of shapes from 1e-6 m to 1e6 m", S, Plane, Volume) {
  for (const float scale : {1e-7f, 1e-6f, 1e-5f, 1e-4f, 1e-3f, 1e-2f, 1e2f, 1e4f, 1e6f})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      CAPTURE(scale);
      CAPTURE(seed);
      std::mt19937_64 random(seed);
      const auto grain = samples::grain<float>(S{}, random);
      using Grain = std::decay_t<decltype(grain)>;
      std::vector<typename S::Vector> points;
      for (Eigen::Index i = 0; i < grain.vertices().rows(); ++i)
        points.push_back(scale * grain.vertices().row(i).transpose());
      const Grain large{std::span<const typename S::Vector>(points)};
      CHECK(large.vertex_count() == grain.vertex_count());
      CHECK(large.face_count() == grain.face_count());
      const float length = std::pow(scale, float(S::dim));
      CHECK(large.volume() / length == doctest::Approx(grain.volume()).epsilon(1e-4));
      const auto mass = large.mass_properties(1000), expected = grain.mass_properties(1000);
      for (int k = 0; k < S::angular_dim; ++k)
        CHECK(mass.inertia(k, k) / length / scale / scale ==
              doctest::Approx(expected.inertia(k, k)).epsilon(1e-3));
      CHECK(large.inradius() / scale == doctest::Approx(grain.inradius()).epsilon(1e-4));
    }
}

TEST_CASE_TEMPLATE("float: no contact point of a capsule is deeper than the pair", S, Plane,
                   Volume) {
  // An end of the capsule beside a vertex: nearer than `coincident` it counts as above the steep face beside it.
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(1, 8);
  const auto grain = samples::grain<float>(S{}, random);
  using Vector = typename S::Vector;
  const CapsuleIn<S> capsule(Segment<S>(0.5f), 0.02f);
  float worst = 0;
  for (int i = 0; i < 20000; ++i) {
    Pose<S> pose_a, pose_b;
    pose_a.rotation = samples::rotation(S{}, random);
    pose_b.rotation = samples::rotation(S{}, random);
    const auto corner = Eigen::Index(random() % grain.vertex_count());
    const Vector end = pose_a.rotation * Vector(0.5f * Vector::UnitX());
    const float beside = float(std::pow(10, -uniform(random)));
    pose_a.position = pose_b.rotation * Vector(grain.vertices().row(corner).transpose()) - end +
                      0.05f * samples::direction<S>(random) +
                      beside * samples::direction<S>(random);
    const Placed a(capsule, pose_a);
    const Placed b(grain, pose_b);
    Manifold<S> manifold;
    if (!collide(a, b, 0.1f, manifold) || manifold.gap < -0.015f) continue;
    for (const auto& point : manifold.points)
      worst = std::max(worst, (manifold.gap - point.gap) / (0.5f + b.radius()));
  }
  CHECK(worst < 128 * std::numeric_limits<float>::epsilon());
}
