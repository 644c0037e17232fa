// SPDX-License-Identifier: MIT
#include "moreau/shape/regular_shape.hpp"

#include <cmath>
#include <doctest/doctest.h>
#include <limits>

#include "moreau/shape/polygon.hpp"
#include "moreau/shape/polyhedron.hpp"

#include "shape/message_of.hpp"
#include "types.hpp"

namespace {

using moreau::cuboid;
using moreau::Polygon;
using moreau::Polyhedron;
using moreau::regular_shape;

TEST_CASE_TEMPLATE("cuboid and rectangle: centre, volume, inertia", Shape,
                   MOREAU_TYPES((Polyhedron<double>, Polygon<double>),
                                (Polyhedron<float>, Polygon<float>))) {
  using S = moreau::SpaceOf<Shape>;
  using T = typename S::Scalar;
  typename S::Vector half;
  for (int axis = 0; axis < S::dim; ++axis) half[axis] = T(axis + 1) / 4;

  const Shape shape = cuboid<Shape>(half);
  CHECK(shape.vertex_count() == std::size_t{1} << S::dim);
  CHECK(shape.vertices().cwiseAbs().isApprox(half.transpose().replicate(1 << S::dim, 1), T(1e-6)));
  const auto mass = shape.mass_properties(2);
  const T volume = (2 * half).prod();
  CHECK(shape.volume() == doctest::Approx(volume).epsilon(1e-6));
  CHECK(mass.mass == doctest::Approx(2 * volume).epsilon(1e-6));
  CHECK(mass.center.norm() < T(1e-6));
  if constexpr (S::dim == 2)
    CHECK(mass.inertia(0, 0) == doctest::Approx(mass.mass * half.squaredNorm() / 3).epsilon(1e-5));
  else
    for (int axis = 0; axis < 3; ++axis)
      CHECK(mass.inertia(axis, axis) ==
            doctest::Approx(mass.mass * (half.squaredNorm() - half[axis] * half[axis]) / 3)
                .epsilon(1e-5));
}

TEST_CASE("cuboid: numbers in braces") {
  CHECK(cuboid<Polyhedron<double>>({1, 2, 3}).volume() == doctest::Approx(48));
  CHECK(cuboid<Polygon<double>>({1, 2}).volume() == doctest::Approx(8));
}

TEST_CASE("regular shapes: cube, square, ball and disk of this size") {
  CHECK(regular_shape<Polyhedron<double>>(2).volume() == doctest::Approx(8));
  CHECK(regular_shape<Polygon<double>>(2).volume() == doctest::Approx(4));
  CHECK(regular_shape<moreau::Ball<double>>(2).radius() == 1);
  CHECK(regular_shape<moreau::Disk<double>>(2).radius() == 1);
}

TEST_CASE("bad arguments are named") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(message_of([] {
          cuboid<Polygon<double>>({1, 0});
        }) == "cuboid: half length = 0 must be finite and > 0");
  CHECK(message_of([=] {
          cuboid<Polyhedron<double>>({1, inf, 1});
        }) == "cuboid: half length = inf must be finite and > 0");
  CHECK(message_of([] { regular_shape<moreau::Ball<double>>(-1); }) ==
        "regular_shape: size = -1 must be finite and > 0");
}

}  // namespace
