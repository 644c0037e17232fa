// SPDX-License-Identifier: MIT
#include "moreau/shape/ball.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>
#include <numbers>

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using moreau::Ball;
using moreau::Disk;

TEST_CASE_TEMPLATE("ball and disk: volume, inertia, box, support, for every space", Shape,
                   MOREAU_TYPES((Ball<double>, Disk<float>), (Ball<float>, Disk<double>))) {
  using S = typename Shape::Space;
  using T = typename S::Scalar;
  using Vector = typename S::Vector;
  static_assert(moreau::ConvexShape<Shape>);

  const Shape sphere(2);
  CHECK(sphere.radius() == 2);
  CHECK(sphere.circumradius() == 2);
  CHECK(sphere.inradius() == 2);
  const double pi = std::numbers::pi, volume = S::dim == 3 ? 32 * pi / 3 : 4 * pi;
  CHECK(sphere.volume() == doctest::Approx(volume).epsilon(1e-6));
  const auto mass = sphere.mass_properties(3);
  CHECK(mass.mass == doctest::Approx(3 * volume).epsilon(1e-6));
  CHECK(mass.center == Vector::Zero());
  const double inertia = (S::dim == 3 ? 0.4 : 0.5) * 3 * volume * 4;
  for (int i = 0; i < S::angular_dim; ++i)
    for (int j = 0; j < S::angular_dim; ++j)
      CHECK(std::abs(double(mass.inertia(i, j)) - (i == j ? inertia : 0)) <= 1e-6 * inertia);

  moreau::Pose<S> pose;
  for (int k = 0; k < S::dim; ++k) pose.position[k] = T(k + 1);
  const auto box = sphere.bounding_box(pose);
  const Vector corner = sphere.support(Vector::Constant(T(1e-3)));
  for (int k = 0; k < S::dim; ++k) {
    CHECK(box.lower[k] == pose.position[k] - 2);
    CHECK(box.upper[k] == pose.position[k] + 2);
    CHECK(corner[k] == doctest::Approx(2 / std::sqrt(double(S::dim))).epsilon(1e-6));
  }
  CHECK(sphere.scaled(T(0.5)).radius() == 1);
}

TEST_CASE_TEMPLATE("bad arguments are named", Shape, Ball<double>, Disk<float>) {
  using T = typename Shape::Scalar;
  const T inf = std::numeric_limits<T>::infinity();
  CHECK(message_of([] { Shape{0}; }) == "Ball: radius = 0 must be finite and > 0");
  CHECK(message_of([] { Shape{-1}; }) == "Ball: radius = -1 must be finite and > 0");
  CHECK(message_of([=] { Shape{inf}; }) == "Ball: radius = inf must be finite and > 0");
  const Shape sphere(1);
  CHECK(message_of([&] { sphere.mass_properties(-3); }) ==
        "Ball::mass_properties: density = -3 must be finite and > 0");
  CHECK(message_of([&] { return sphere.scaled(0); }) ==
        "Ball::scaled: factor = 0 must be finite and > 0");
}

}  // namespace
